// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { eventList } from './event_list';
import { exportPanel } from './export_panel';
import { robotsAtGoal } from './gathering';
import type { Live } from './live';
import { headingAt, metricsTable, numbersAt } from './metrics';
import { downloads, fileLink, shareButtons } from './place';
import type { Json } from './protocol';
import type { Scene } from './scene/scene';
import { metricsHeading, repeatOf } from './repeat';

/** Metrics so far, changes, the command that repeats them, and what a server gives: downloads, and copies to `compare`. */
export function recordTab(
  live: Live,
  scene: Scene,
  seek: (time: number) => void,
  compare: (() => void) | undefined,
): HTMLElement {
  const metrics = element('div', { class: 'table' });
  const heading = element('h2', {});
  const moment = element('div', { class: 'table moment' });
  const momentHeading = element('h2', {});
  const changesHeading = element('h2', {});
  const note = element('p', { class: 'doc' });
  const changes = element('ol', { class: 'changes' });
  const command = element('code', { class: 'command', tabindex: '0' });
  const copied = element('output', { class: 'doc' });
  const copy = element(
    'button',
    {
      type: 'button',
      class: 'copy',
      onclick: () =>
        void navigator.clipboard.writeText(command.textContent ?? '').then(
          () => (copied.value = 'Copied.'),
          () => select(command),
        ),
    },
    'Copy command',
  );
  const links = downloads.map((name) => fileLink(live.session, name));
  const driven = element(
    'p',
    { class: 'doc', hidden: true },
    'While the coils are driven nothing can be downloaded: stop the rig first.',
  );
  const files = element('div', { class: 'row' }, ...links);
  live.listen((message) => {
    if (message.type !== 'rig') return;
    files.inert = message.state === 'armed';
    files.classList.toggle('off', files.inert);
    driven.hidden = !files.inert;
  });
  let last: { [key: string]: Json } = {};
  const show = () => {
    if (!live.hello) return;
    const playback = live.hello.playback;
    const repeat = repeatOf(live.hello, live.standing ?? { changes: [], steered: false });
    changes.replaceChildren(...repeat.changes.map((one) => element('li', {}, element('code', {}, one))));
    if (repeat.changes.length === 0) changes.replaceChildren(element('li', { class: 'doc' }, repeat.none));
    heading.textContent = metricsHeading(playback, live.standing);
    changesHeading.textContent = playback ? 'Changes in the record' : 'Changes since the start';
    note.textContent = repeat.note;
    if (command.textContent !== repeat.command) {
      command.textContent = repeat.command;
      copied.value = '';
    }
  };
  let drawn = 0;
  let there: { [key: string]: Json } = {};
  live.listen((message) => {
    if (message.type === 'hello') show();
    if (message.type === 'frame' && !live.standing?.looks_back) there = robotsAtGoal(message, live.hello?.scenario);
    if (message.type !== 'standing') return;
    last = { ...message.metrics, ...there };
    show();
    if (message.plays && performance.now() - drawn < 250) return;
    drawn = performance.now();
    metrics.replaceChildren(metricsTable([''], [last]));
    momentHeading.textContent = headingAt(live.history, message.frame, live.hello?.states ?? []);
    moment.replaceChildren(metricsTable([''], [numbersAt(live.history, message.frame)]));
  });
  return element(
    'div',
    { class: 'record' },
    heading,
    metrics,
    momentHeading,
    moment,
    changesHeading,
    changes,
    element('h2', {}, 'Command line'),
    command,
    note,
    element('div', { class: 'row' }, copy, copied, ...(live.isServed ? shareButtons(live) : [])),
    ...eventList(live, seek),
    ...(live.isServed ? [element('h2', {}, 'Download'), driven, files] : []),
    element('h2', {}, 'Export the view'),
    exportPanel(live, scene),
    ...(compare
      ? [
          element('h2', {}, 'Compare'),
          element(
            'div',
            { class: 'row' },
            element('button', { type: 'button', class: 'compare', onclick: compare }, 'Compare with a copy'),
          ),
        ]
      : []),
  );
}

function select(node: HTMLElement): void {
  window.getSelection()?.selectAllChildren(node);
}
