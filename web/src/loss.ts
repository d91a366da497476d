// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';

/** Whether a run may be discarded. Asks if it was changed or steered, so that its settings alone do not repeat it. */
export function mayBeginAnew(live: Live): Promise<boolean> {
  if (!live.isTouched || live.hello?.live || live.hello?.playback) return Promise.resolve(true);
  return new Promise((resolve) => {
    const button = (label: string, name: string, answer: string) =>
      element('button', { type: 'button', class: name, onclick: () => dialog.close(answer) }, label);
    const dialog = element(
      'dialog',
      { class: 'loss' },
      element('h2', {}, 'Restart?'),
      element('p', {}, 'The run was changed or steered while it ran. Only its record can repeat it, and a restart discards the record.'),
      element(
        'div',
        { class: 'row' },
        element('a', { href: `/api/sessions/${live.session}/record.h5`, download: 'record.h5', class: 'button' }, 'Download record.h5'),
        button('Keep the run', 'keep', ''),
        button('Restart', 'primary anew', 'anew'),
      ),
    );
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'anew');
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
