// SPDX-License-Identifier: Apache-2.0
import { call } from './connection';
import { element } from './dom';
import { mayClose } from './loss';

export interface OpenRun {
  session: number;
  name: string;
  t_s: number;
  watched: boolean;
  changed: boolean;
  live: boolean;
}

/** Text of a link to an open run. */
export function runText({ name, t_s, watched, changed }: OpenRun): string {
  const file = name.slice(name.lastIndexOf('/') + 1);
  return [file, `${t_s.toFixed(1)} s`, ...(changed ? ['changed'] : []), ...(watched ? ['shown by a page'] : [])].join(
    ' · ',
  );
}

/** Runs that are open, to come back to or to close. A rig's run is ended from its console. */
export function openRuns(runs: OpenRun[], say: (text: string) => void): HTMLElement {
  const list = element('ul', { class: 'row' });
  const root = element('section', { class: 'open-runs' }, element('h2', {}, 'Open runs'), list);
  for (const run of runs) {
    const link = element(
      'a',
      { href: `#/${run.live ? 'rig' : 'session'}/${run.session}`, class: 'button' },
      runText(run),
    );
    const close = element(
      'button',
      {
        type: 'button',
        class: 'quiet close',
        title: `Close ${runText(run)}`,
        'aria-label': `Close ${runText(run)}`,
        onclick: () => void end(),
      },
      '×',
    );
    const item = element('li', {}, link, ...(run.live ? [] : [close]));
    const end = async () => {
      if (run.changed && !(await mayClose(run.name.slice(run.name.lastIndexOf('/') + 1), run.session))) return;
      close.disabled = true;
      try {
        await call('DELETE', `/api/sessions/${run.session}`);
      } catch (error) {
        say((error as Error).message); // it is closed already, or cannot be reached
      }
      const next = (item.nextElementSibling ?? item.previousElementSibling)?.querySelector<HTMLElement>('a');
      item.remove();
      root.hidden = list.children.length === 0;
      next?.focus();
    };
    list.append(item);
  }
  return root;
}
