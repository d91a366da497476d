// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

/** The bar that says how many changes wait for a restart; hidden without any. */
export function waitingBar(restart: () => void, discard: () => void): { root: HTMLElement; show(count: number): void } {
  const text = element('span', {});
  const button = (label: string, name: string, act: () => void) =>
    element('button', { type: 'button', class: name, onclick: act }, label);
  const root = element(
    'div',
    { class: 'waiting', role: 'status', hidden: true },
    text,
    button('Restart', 'primary restart', restart),
    button('Discard', 'discard', discard),
  );
  return {
    root,
    show: (count) => {
      root.hidden = count === 0;
      const words = waitingWords(count);
      if (text.textContent !== words) text.textContent = words;
    },
  };
}

export function waitingWords(count: number): string {
  return count === 1 ? 'One change takes effect after a restart.' : `${count} changes take effect after a restart.`;
}
