// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';

/** Whether only its record can repeat a run, since it was changed or steered. */
export function isAtRisk(live: Live): boolean {
  return live.isTouched && !live.hello?.live && !live.hello?.playback;
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
  text: 'The run was changed or steered while it ran. It pauses and is kept for 30 minutes under "Open runs" of the gallery; only its record keeps it for good.',
  keep: 'Stay here',
  go: 'Leave',
};

/** Whether a run may be discarded; asks if it is at risk. `name`: of the run, if there are several. */
export function mayBeginAnew(live: Live, name = ''): Promise<boolean> {
  return isAtRisk(live) ? asks([live], name ? { ...anew, title: `Restart ${name}?` } : anew) : Promise.resolve(true);
}

/** Whether a page of these runs may be left; asks if one is at risk. */
export function mayLeave(lives: Live[]): Promise<boolean> {
  const risky = lives.filter(isAtRisk);
  return risky.length > 0 ? asks(risky, away) : Promise.resolve(true);
}

function asks(lives: Live[], words: Words): Promise<boolean> {
  return new Promise((resolve) => {
    const button = (label: string, name: string, answer: string) =>
      element('button', { type: 'button', class: name, onclick: () => dialog.close(answer) }, label);
    const links = lives.map(({ session }) =>
      element('a', { href: `/api/sessions/${session}/record.h5`, download: 'record.h5', class: 'button' }, 'Download record.h5'),
    );
    const dialog = element(
      'dialog',
      { class: 'loss' },
      element('h2', {}, words.title),
      element('p', {}, words.text),
      element('div', { class: 'row' }, ...links, button(words.keep, 'keep', ''), button(words.go, 'primary anew', 'go')),
    );
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'go');
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
