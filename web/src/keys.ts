// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

export interface Key {
  keys: string[];
  shown: string;
  does: string;
  act: (event: KeyboardEvent) => void;
}

const editable = 'input:not([type=checkbox]), select, textarea';
const pressable = 'button, a, summary, input[type=checkbox]';

/** Keys of a page, with the dialog that lists them. Fields and buttons keep their own keys. */
export class Keys {
  private readonly dialog: HTMLDialogElement;
  private readonly down = (event: KeyboardEvent) => this.press(event);

  constructor(private readonly list: Key[]) {
    list.push({ keys: ['?'], shown: '?', does: 'show the keys', act: () => this.help() });
    const rows = list.map((one) =>
      element('tr', {}, element('td', {}, element('kbd', {}, one.shown)), element('td', {}, one.does)),
    );
    this.dialog = element(
      'dialog',
      { class: 'keys', 'aria-label': 'Keys' },
      element('h2', {}, 'Keys'),
      element('table', {}, ...rows),
      element('button', { type: 'button', onclick: () => this.dialog.close() }, 'Close'),
    );
    document.body.append(this.dialog);
    window.addEventListener('keydown', this.down);
  }

  help(): void {
    if (!this.dialog.open) this.dialog.showModal();
  }

  destroy(): void {
    window.removeEventListener('keydown', this.down);
    this.dialog.remove();
  }

  private press(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (this.dialog.open || event.ctrlKey || event.altKey || event.metaKey) return;
    if (target.matches(editable)) {
      if (event.key === 'Escape') target.blur();
      return;
    }
    if (target.matches(pressable) && (event.key === ' ' || event.key === 'Enter')) return;
    const found = this.list.find((one) => one.keys.includes(event.key));
    if (!found) return;
    event.preventDefault();
    found.act(event);
  }
}
