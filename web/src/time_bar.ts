// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import type { Standing } from './protocol';
import { timeline } from './timeline';

export const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 0];

/** The speed that is `by` steps faster than `speed`; 0 is as fast as possible. */
export function fasterSpeed(speed: number, by: number): number {
  let here = speeds.indexOf(speed);
  if (here < 0) here = speeds.findIndex((one) => one === 0 || one >= speed);
  return speeds[Math.max(0, Math.min(speeds.length - 1, here + by))] as number;
}

export interface TimeBar {
  root: HTMLElement;
  play(): void;
  step(): void;
  live(): void;
  speed(by: number): void;
  seekBy(frames: number): void;
  seek(frame: number): void;
}

/** Play, pause, tick, speed and the time line of one session, or of several in step. */
export function timeBar(sessions: Live[]): TimeBar {
  const first = sessions[0] as Live;
  const all = (request: Parameters<Live['ask']>[0]) => {
    for (const one of sessions) void one.ask(request);
  };
  const anyPlays = () => sessions.some((one) => one.standing?.plays);
  const play = () => all({ do: anyPlays() ? 'pause' : 'play' });
  const step = () => all({ do: 'step' });
  const live = () => all({ do: 'live' });
  const seek = (frame: number) => {
    for (const one of sessions) one.seek(frame);
  };
  const seekBy = (frames: number) => {
    if (!anyPlays()) seek((first.standing?.frame ?? 0) + frames);
  };
  const setSpeed = (speed: number) => all({ do: 'speed', number: speed });
  const speed = (by: number) => setSpeed(fasterSpeed(first.standing?.speed ?? 1, by));

  const playButton = element('button', { class: 'play primary', type: 'button', onclick: play }, '▶ Play');
  const stepButton = element(
    'button',
    { class: 'step', type: 'button', title: 'A single tick (.)', onclick: step },
    'Tick',
  );
  const menu = element('select', {
    class: 'speed',
    'aria-label': 'Speed',
    title: 'Simulated seconds a second (+ −)',
    onchange: () => setSpeed(Number(menu.value)),
  });
  for (const one of speeds)
    menu.append(element('option', { value: String(one) }, one === 0 ? 'fastest' : `×${one}`));
  const clock = element('output', { class: 'clock' }, '0.0 s');
  const liveButton = element(
    'button',
    { class: 'live', type: 'button', title: 'The newest frame (End)', onclick: live },
    'Live',
  );
  const line = timeline(first, seek);

  const take = (standing: Standing) => {
    const plays = anyPlays();
    playButton.textContent = plays ? '❚❚ Pause' : '▶ Play';
    playButton.title = plays ? 'Pause (space)' : 'Play (space)';
    const ended = sessions.every((one) => one.standing?.ended);
    const record = first.hello?.playback ?? false;
    playButton.disabled = ended && !plays && !record;
    stepButton.disabled = ended;
    liveButton.disabled = !standing.looks_back;
    liveButton.classList.toggle('on', !standing.looks_back && !record);
    liveButton.hidden = record;
    const known = speeds.includes(standing.speed);
    if (document.activeElement !== menu) menu.value = String(known ? standing.speed : 1);
  };
  for (const one of sessions)
    one.listen((message) => {
      if (message.type === 'standing' && first.standing) take(first.standing);
      if (message.type === 'frame' && one === first) clock.textContent = `${first.shown.toFixed(1)} s`;
    });
  const root = element(
    'section',
    { class: 'timebar', 'aria-label': 'Time' },
    playButton,
    stepButton,
    menu,
    clock,
    line.root,
    liveButton,
  );
  return { root, play, step, live, speed, seekBy, seek };
}
