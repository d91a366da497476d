// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { eventsNear, ticksOf } from './events';
import type { Live } from './live';
import { onTheme } from './theme';
import { TimeMarks } from './time_marks';

const thumb = 14; // px, as in app.css
const colours = { plan: '--plan', contact: '--bad', goal: '--good', other: '--accent' };

/** A slider over all frames with marks above it: contacts, other events, and planning events. */
export function timeline(
  sessions: Live[],
  lead: () => Live,
  seek: (frame: number) => void,
): { root: HTMLElement; destroy: () => void } {
  const canvas = element('canvas', { class: 'marks', 'aria-hidden': 'true' });
  const slider = element('input', {
    type: 'range',
    class: 'scrub',
    min: '0',
    max: '0',
    step: '1',
    value: '0',
    'aria-label': 'Frame',
    oninput: () => seek(Number(slider.value)),
  });
  const tip = element('output', { class: 'tip', 'aria-live': 'off', hidden: true });
  const root = element('div', { class: 'timeline' }, canvas, slider, tip);
  const marks = new TimeMarks();
  let due = false;

  const timeAt = (event: MouseEvent) => {
    const box = slider.getBoundingClientRect();
    const share = (event.clientX - box.left - thumb / 2) / (box.width - thumb);
    const { times } = lead().history;
    return times[Math.round(Math.max(0, Math.min(1, share)) * (times.length - 1))];
  };
  const point = (time: number | undefined) => sessions.forEach((one) => one.point(time));
  root.addEventListener('pointermove', (event) => point(timeAt(event)));
  root.addEventListener('pointerleave', () => point(undefined));
  slider.addEventListener('focus', () => point(lead().shown));
  slider.addEventListener('blur', () => point(undefined));
  canvas.addEventListener('click', (event) => {
    const time = timeAt(event);
    if (time !== undefined) seek(lead().history.nearest(time));
  });

  const draw = () => {
    due = false;
    const live = lead();
    const { clientWidth: width, clientHeight: height } = canvas;
    const scale = window.devicePixelRatio;
    canvas.width = width * scale;
    canvas.height = height * scale;
    const to = canvas.getContext('2d');
    const frames = live.history.times.length;
    if (!to || frames < 2) return;
    to.scale(scale, scale);
    const style = getComputedStyle(root);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const x = (frame: number) => thumb / 2 + (frame / (frames - 1)) * (width - thumb);
    const mark = (frame: number, name: string, from: number, to2: number) => {
      to.fillStyle = colour(name);
      to.fillRect(Math.round(x(frame)) - 0.5, from, 1.5, to2 - from);
    };
    const { times } = live.history;
    for (const time of ticksOf(times[0] as number, times.at(-1) as number, Math.floor(width / 60)))
      mark(live.history.nearest(time), '--faint', height - 3, height);
    for (const [kind, frame] of marks.of(live.history, width)) {
      if (kind === 'plan') mark(frame, colours.plan, height - 8, height - 3);
      else mark(frame, colours[kind], 0, height - 9);
    }
    if (live.pointed !== undefined) mark(live.history.nearest(live.pointed), '--ink', 0, height);
  };
  const redraw = () => {
    if (!due) requestAnimationFrame(draw);
    due = true;
  };
  const observer = new ResizeObserver(redraw);
  observer.observe(root);
  const stopTheme = onTheme(redraw);
  const showTip = () => {
    redraw();
    const live = lead();
    const time = live.pointed;
    tip.hidden = time === undefined;
    if (time === undefined) return;
    const share = live.history.nearest(time) / Math.max(1, live.history.times.length - 1);
    tip.style.left = `${100 * share}%`;
    tip.style.translate = `${-100 * share}%`; // within the bar
    tip.value = [`${time.toFixed(1)} s`, ...eventsNear(live.history.events, time, span(live) / 100)].join(' · ');
  };
  for (const one of sessions) {
    one.onPoint(showTip);
    one.listen((message) => {
      if (message.type === 'rows') redraw();
      if (one !== lead() || (message.type !== 'standing' && message.type !== 'rows')) return;
      slider.max = String(Math.max(0, one.history.times.length - 1)); // rows may follow their standing
      slider.value = String(one.standing?.frame ?? 0);
      const near = eventsNear(one.history.events, one.shown, span(one) / 200);
      slider.setAttribute('aria-valuetext', [`${one.shown.toFixed(1)} seconds`, ...near].join(', '));
      if (document.activeElement === slider) point(one.shown); // by keys the tip is at the time shown
    });
  }
  return {
    root,
    destroy: () => {
      observer.disconnect();
      stopTheme();
    },
  };
}

function span(live: Live): number {
  const times = live.history.times;
  return (times[times.length - 1] ?? 0) - (times[0] ?? 0);
}
