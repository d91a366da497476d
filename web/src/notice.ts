// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

const noteShown = 6000; // [ms]

/** Says something in a line: a trouble stays, a note fades. */
export type Say = (text: string, isTrouble?: boolean) => void;

export function notice(): { root: HTMLElement; say: Say } {
  const root = element('p', { class: 'trouble', role: 'alert' });
  let fades: number | undefined;
  const say: Say = (text, isTrouble = true) => {
    root.replaceChildren(text);
    root.title = text;
    root.classList.toggle('note', !isTrouble);
    window.clearTimeout(fades);
    if (!isTrouble) fades = window.setTimeout(() => say(''), noteShown);
  };
  return { root, say };
}
