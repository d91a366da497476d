// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Key } from './keys';
import type { Live } from './live';
import type { Standing } from './protocol';
import { timeline } from './timeline';

export const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 0];

/** The speed `by` steps above `speed`; 0 is as fast as possible. */
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
  seekTime(time: number): void;
}

/** Keyboard shortcuts of every page with a time bar. */
export function timeKeys(time: TimeBar): Key[] {
  return [
    { keys: [' '], shown: 'space', does: 'play or pause', act: time.play },
    { keys: ['.'], shown: '.', does: 'single tick', act: time.step },
    { keys: ['Home'], shown: 'Home', does: 'first frame', act: () => time.seek(0) },
    { keys: ['End'], shown: 'End', does: 'newest frame', act: time.live },
    { keys: ['+', '='], shown: '+', does: 'faster', act: () => time.speed(1) },
    { keys: ['-'], shown: '−', does: 'slower', act: () => time.speed(-1) },
  ];
}

/** Play, pause, tick, speed and time line of one session, or of several in step. `again` restarts them. */
export function timeBar(sessions: Live[], again?: () => Promise<unknown>): TimeBar {
  const first = sessions[0] as Live;
  const all = (request: Parameters<Live['ask']>[0]) => {
    for (const one of sessions) void one.ask(request);
  };
  const anyPlays = () => sessions.some((one) => one.standing?.plays);
  const isOver = () =>
    again !== undefined && !first.hello?.playback && !anyPlays() && sessions.every((one) => one.standing?.ended);
  const play = () => void (isOver() ? playAgain() : anyPlays() ? pause() : all({ do: 'play' }));
  const playAgain = async () => {
    await again?.();
    if (!sessions.some((one) => one.standing?.ended)) all({ do: 'play' });
  };
  /** Advances the sessions that are behind to the time of the first. */
  const pause = async () => {
    await Promise.all(sessions.map((one) => one.ask({ do: 'pause' })));
    if (sessions.length < 2) return;
    const newest = sessions.map((one) => one.history.times.at(-1) ?? 0);
    const until = Math.max(...newest);
    sessions.forEach((one, i) => {
      if ((newest[i] as number) < until && !one.standing?.ended) void one.ask({ do: 'play', number: until });
    });
  };
  const step = () => all({ do: 'step' });
  const live = () => all({ do: 'live' });
  /** The session with the most frames; the others show the same time. */
  const lead = () =>
    sessions.reduce((a, b) => (b.history.times.length > a.history.times.length ? b : a), first);
  const seek = (frame: number) => {
    const { times } = lead().history;
    const time = times[Math.max(0, Math.min(times.length - 1, frame))];
    if (time !== undefined) seekTime(time);
  };
  const seekTime = (time: number) => {
    for (const one of sessions) one.seek(one.history.nearest(time));
  };
  const seekBy = (frames: number) => {
    if (!anyPlays()) seek((lead().standing?.frame ?? 0) + frames);
  };
  const setSpeed = (speed: number) => all({ do: 'speed', number: speed });
  const speed = (by: number) => setSpeed(fasterSpeed(first.standing?.speed ?? 1, by));

  const playButton = element('button', { class: 'play primary', type: 'button', onclick: play }, '▶ Play');
  const stepButton = element(
    'button',
    { class: 'step', type: 'button', title: 'Single tick (.)', onclick: step },
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
  const line = timeline(sessions, lead, seek);

  const take = (standing: Standing) => {
    const plays = anyPlays();
    const over = isOver();
    playButton.textContent = plays ? '❚❚ Pause' : over ? '↻ Restart' : '▶ Play';
    playButton.title = plays ? 'Pause (space)' : over ? 'Restart (space)' : 'Play (space)';
    const ended = sessions.every((one) => one.standing?.ended);
    const record = first.hello?.playback ?? false;
    playButton.disabled = ended && !plays && !record && !over;
    stepButton.disabled = ended;
    const looksBack = sessions.some((one) => one.standing?.looks_back);
    const isNewest = !looksBack && (!record || standing.frame + 1 >= standing.frames);
    liveButton.disabled = isNewest;
    liveButton.classList.toggle('on', isNewest);
    liveButton.hidden = record && !standing.growing;
    const known = speeds.includes(standing.speed);
    if (document.activeElement !== menu) menu.value = String(known ? standing.speed : 1);
  };
  for (const one of sessions)
    one.listen((message) => {
      if (message.type === 'standing' && first.standing) take(first.standing);
      if (message.type === 'frame' && one === lead()) clock.textContent = `${one.shown.toFixed(1)} s`;
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
  for (const one of sessions) one.onState((state) => (root.inert = state !== 'open'));
  return { root, play, step, live, speed, seekBy, seek, seekTime };
}
