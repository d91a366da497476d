// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';
import { downloads, fileLink, keptNote, makesBranches } from './place';

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

/** Whether a run that no page shows may be closed, although only its record can repeat it. */
export function mayClose(name: string, session: number): Promise<boolean> {
  return goes([{ session, isServed: true }], {
    title: `Close ${name}?`,
    text: 'The run was changed or steered while it ran. Only its record can repeat it, and closing discards the record.',
    keep: 'Keep the run',
    go: 'Close it',
  });
}

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

/** Place at which a change acts that was made while an earlier time is shown: `now`, in a `branch`, which is a copy of the run up to that time, or nowhere. */
export async function askWhen(live: Live): Promise<'now' | 'branch' | ''> {
  const shown = live.shown.toFixed(1);
  const newest = (live.history.times.at(-1) ?? 0).toFixed(1);
  const hasEnded = live.standing?.ended;
  const canBranch = makesBranches && live.isServed && !live.hello?.rig;
  const places = [
    ...(canBranch ? [`in a branch, which is a copy of the run up to ${shown} s that goes on with it`] : []),
    ...(hasEnded ? [] : ['now']),
  ];
  const text = `The picture is of ${shown} s, and the run ${hasEnded ? 'ended' : 'stands'} at ${newest} s. The past cannot be changed${places.length > 0 ? `: the change can act ${places.join(', or ')}.` : '.'}`;
  const answer = await asks('Change the past?', text, [
    ['Cancel', 'keep', ''],
    ...(hasEnded ? [] : [[`Now, at ${newest} s`, 'now', 'now'] as [string, string, string]]),
    ...(canBranch ? [[`Branch at ${shown} s`, 'primary branch', 'branch'] as [string, string, string]] : []),
  ]);
  return answer as 'now' | 'branch' | '';
}

async function goes(lives: { session: number; isServed: boolean }[], words: Words): Promise<boolean> {
  const name = downloads[0] ?? '';
  const links = lives.filter((live) => live.isServed).map(({ session }) => fileLink(session, name, `Download ${name}`));
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
