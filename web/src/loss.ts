// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import { downloads, fileLink, keptNote } from './place';

/** Whether only its record can repeat a run, since it was changed or steered; never one that is gone. */
export function isAtRisk(live: Live): boolean {
  return live.isTouched && !live.isClosed && !live.hello?.live && !live.hello?.playback;
}

interface Words {
  title: string;
  text: string;
  keep: string;
  go: string;
}

const anew: Words = {
  title: 'Restart?',
  text: 'The run was changed or steered while it ran. Only its record can repeat it, and a restart discards the record.',
  keep: 'Keep the run',
  go: 'Restart',
};
const away: Words = {
  title: 'Leave this run?',
  text: `The run was changed or steered while it ran. ${keptNote}`,
  keep: 'Stay here',
  go: 'Leave',
};

/** Whether a run may be discarded; asks if it is at risk. `name`: of the run, if there are several. */
export function mayBeginAnew(live: Live, name = ''): Promise<boolean> {
  const hasBegun = (live.standing?.frames ?? 0) > 0; // before that, its settings repeat its changes
  return hasBegun && isAtRisk(live)
    ? goes([live], name ? { ...anew, title: `Restart ${name}?` } : anew)
    : Promise.resolve(true);
}

/** Whether a page of these runs may be left; asks if one is at risk. */
export function mayLeave(lives: Live[]): Promise<boolean> {
  const risky = lives.filter(isAtRisk);
  return risky.length > 0 ? goes(risky, away) : Promise.resolve(true);
}

/** Time at which a change acts that was made while an earlier time is shown: `now`, in a `copy` from the start, or not at all. */
export async function askWhen(shown: number, newest: number): Promise<'now' | 'copy' | ''> {
  const text = `The picture is of ${shown.toFixed(1)} s, and the run stands at ${newest.toFixed(1)} s. The past cannot be changed: the change can act now, or in a copy of the run from its start.`;
  const answer = await asks('Change the past?', text, [
    ['Cancel', 'keep', ''],
    ['In a copy from 0 s', 'copy', 'copy'],
    [`Now, at ${newest.toFixed(1)} s`, 'primary now', 'now'],
  ]);
  return answer as 'now' | 'copy' | '';
}

async function goes(lives: Live[], words: Words): Promise<boolean> {
  const name = downloads[0] ?? '';
  const links = lives.map(({ session }) => fileLink(session, name, `Download ${name}`));
  return (
    (await asks(
      words.title,
      words.text,
      [
        [words.keep, 'keep', ''],
        [words.go, 'primary anew', 'go'],
      ],
      links,
    )) === 'go'
  );
}

/** Asks in a dialog; answers are label, class and value of each button. */
function asks(
  title: string,
  text: string,
  answers: [string, string, string][],
  more: HTMLElement[] = [],
): Promise<string> {
  return new Promise((resolve) => {
    const buttons = answers.map(([label, name, value]) =>
      element('button', { type: 'button', class: name, onclick: () => dialog.close(value) }, label),
    );
    const dialog = element(
      'dialog',
      { class: 'loss', 'aria-label': title },
      element('h2', {}, title),
      element('p', {}, text),
      element('div', { class: 'row' }, ...more, ...buttons),
    );
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
