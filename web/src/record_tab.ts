// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { eventList } from './event_list';
import { exportPanel } from './export_panel';
import type { Live } from './live';
import { metricsTable } from './metrics';
import { downloads, fileLink, shareButtons } from './place';
import type { Json } from './protocol';
import type { Scene } from './scene/scene';
import { metricsHeading, repeatOf } from './repeat';

/** Metrics so far, changes, the command that repeats them, and downloads. */
export function recordTab(live: Live, scene: Scene, compare: () => void, seek: (time: number) => void): HTMLElement {
  const metrics = element('div', { class: 'table' });
  const heading = element('h2', {});
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
    heading.textContent = metricsHeading(playback, live.standing, live.history.times.at(-1) ?? 0);
    changesHeading.textContent = playback ? 'Changes in the record' : 'Changes since the start';
    note.textContent = repeat.note;
    if (command.textContent !== repeat.command) {
      command.textContent = repeat.command;
      copied.value = '';
    }
  };
  let drawn = 0;
  live.listen((message) => {
    if (message.type === 'hello') show();
    if (message.type !== 'standing') return;
    last = message.metrics;
    show();
    if (message.plays && performance.now() - drawn < 250) return;
    drawn = performance.now();
    metrics.replaceChildren(metricsTable([''], [last]));
  });
  return element(
    'div',
    { class: 'record' },
    heading,
    metrics,
    changesHeading,
    changes,
    element('h2', {}, 'Command line'),
    command,
    note,
    element('div', { class: 'row' }, copy, copied, ...shareButtons(live)),
    ...eventList(live, seek),
    element('h2', {}, 'Download'),
    driven,
    files,
    element('h2', {}, 'Export the view'),
    exportPanel(live, scene),
    element('h2', {}, 'Compare'),
    element(
      'div',
      { class: 'row' },
      element('button', { type: 'button', class: 'compare', onclick: compare }, 'Compare with a copy'),
    ),
  );
}

function select(node: HTMLElement): void {
  window.getSelection()?.selectAllChildren(node);
}
