// SPDX-License-Identifier: Apache-2.0
import { barView } from './bar_view';
import { element } from './dom';
import type { Key } from './keys';
import type { Live } from './live';
import type { Standing } from './protocol';
import { speeds } from './speeds';
import { Streams } from './streams';
import { timeline } from './timeline';
import { Transport } from './transport';

export interface TimeBar {
  root: HTMLElement;
  transport: Transport;
  destroy(): void;
}

/** Keyboard shortcuts of every page with a time bar. */
export function timeKeys({ transport: time }: TimeBar): Key[] {
  return [
    { keys: [' '], shown: 'space', does: 'play or pause', act: time.play },
    { keys: ['.'], shown: '.', does: 'single tick', act: time.step },
    { keys: ['Home'], shown: 'Home', does: 'first frame', act: () => time.seek(0) },
    { keys: ['End'], shown: 'End', does: 'newest frame', act: time.live },
    {
      keys: ['n', 'N'],
      shown: 'n, N',
      does: 'next event, event before',
      act: (event) => time.seekEvent(event.key === 'n' ? 1 : -1),
    },
    {
      keys: ['c', 'C'],
      shown: 'c, C',
      does: 'next contact, contact before',
      act: (event) => time.seekContact(event.key === 'c' ? 1 : -1),
    },
    { keys: ['+', '='], shown: '+', does: 'faster', act: () => time.speed(1) },
    { keys: ['-'], shown: '−', does: 'slower', act: () => time.speed(-1) },
  ];
}

/** Play, pause, tick, speed and time line of one session, or of several in step. `again` restarts them. */
export function timeBar(sessions: Live[], again?: () => Promise<unknown>): TimeBar {
  const time = new Transport(sessions, again);
  const button = (label: string, name: string, title: string, act: () => void) =>
    element('button', { class: name, type: 'button', title, onclick: act }, label);
  const playButton = button('▶ Play', 'play primary', '', time.play);
  const stepButton = button('Tick', 'step', 'Single tick (.)', time.step);
  const liveButton = button('Live', 'live', 'The newest frame (End)', time.live);
  const menu = element('select', {
    class: 'speed',
    'aria-label': 'Speed',
    title: 'Simulated seconds a second (+ −)',
    onchange: () => time.setSpeed(Number(menu.value)),
  });
  for (const one of speeds) menu.append(element('option', { value: String(one) }, one === 0 ? 'fastest' : `×${one}`));
  const clock = element('output', { class: 'clock', 'aria-live': 'off' }, '0.0 s'); // not said ten times a second
  const total = element('span', { class: 'total', title: 'Time of the newest frame' });
  const line = timeline(sessions, () => time.lead, time.seek);

  const take = (standing: Standing) => {
    const view = barView(
      time,
      standing,
      time.first.hello?.playback ?? false,
      sessions.some((one) => one.standing?.looks_back),
    );
    playButton.textContent = view.play;
    playButton.title = view.playTitle;
    playButton.disabled = !view.canPlay;
    stepButton.disabled = !view.canStep;
    liveButton.disabled = view.isNewest;
    liveButton.classList.toggle('on', view.isNewest);
    liveButton.hidden = !view.hasLive;
    if (document.activeElement !== menu) menu.value = view.speed;
  };
  const showTotal = () => {
    const newest = time.lead.history.times.at(-1);
    total.textContent = newest === undefined ? '' : `of ${newest.toFixed(1)} s`;
  };
  for (const one of sessions) {
    one.listen((message) => {
      if (message.type === 'standing' && time.first.standing) take(time.first.standing);
      if (message.type === 'rows') showTotal();
      if (message.type === 'frame' && one === time.lead) clock.textContent = `${one.shown.toFixed(1)} s`;
    });
  }
  const streams = new Streams();
  sessions.forEach((one, i) =>
    one.onState((state, text) => {
      streams.take(i, state, text);
      root.inert = !streams.isOpen;
    }),
  );
  const root = element(
    'section',
    { class: 'timebar', 'aria-label': 'Time' },
    playButton,
    stepButton,
    menu,
    clock,
    total,
    line.root,
    liveButton,
  );
  return { root, transport: time, destroy: line.destroy };
}
