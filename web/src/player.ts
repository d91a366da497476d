// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { FilePlayer } from './file_player';
import { Live } from './live';
import type { Page } from './page';
import { type RunFile, readRun } from './run_file';
import { pageOf } from './session_page';
import { at } from './settings';

/** Page that plays the run within itself, in base64. */
export async function playerPage(text: string): Promise<Page> {
  const run = await readRun(text).catch(() => {
    throw new Error('The run in this file cannot be read: the file is damaged, or the browser is too old.');
  });
  const live = new Live(0, 'The run', (onState) => new FilePlayer(run, onState));
  return pageOf(live, { rig: false, changes: false, about: about(live, run) });
}

/** The title, what ended the run, and how it is repeated. */
function about(live: Live, run: RunFile): HTMLElement {
  const root = element('div', { class: 'about' });
  live.listen((message) => {
    if (message.type !== 'hello') return;
    const { scenario, name, command } = message;
    const hasDecisions = at(scenario, 'record.diagnostics') === true;
    const notes = [
      ...(run.every > 1 ? [`It has one frame in ${run.every} of the record, which is too large for a page.`] : []),
      ...(hasDecisions
        ? []
        : ['The record keeps no decisions, such as radar scans or regions: record.diagnostics was off.']),
      ...(scenario['robots'] ? ['Positions of single robots are those kept by the record, at 64 to 128 times.'] : []),
    ];
    root.replaceChildren(
      element('h2', {}, String(scenario['name'] || name)),
      element('p', {}, String(scenario['description'] ?? '')),
      element(
        'p',
        {},
        'A run of a magnetic microrobot swarm. This file plays it by itself: it needs no server and no network.',
      ),
      ...notes.map((note) => element('p', { class: 'doc' }, note)),
      element('h2', {}, 'Repeat it'),
      element('code', { class: 'command', tabindex: '0' }, command),
      element(
        'p',
        { class: 'doc' },
        `This command runs ${name} again and compares it. The record is ${run.hash}, made by microswarm ${run.version}.`,
      ),
    );
  });
  return root;
}
