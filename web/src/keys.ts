// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';

export interface Key {
  keys: string[];
  shown: string;
  does: string;
  act: (event: KeyboardEvent) => void;
}

const writable = 'input:not([type=checkbox], [type=range]), textarea';
const pressable = 'button, a, summary, input[type=checkbox], select';
const movable = 'input[type=range], select';

/** Whether the focused element needs the key itself. */
function isTaken(target: HTMLElement, key: string): boolean {
  if (target.matches(writable)) return true;
  if (target.matches(pressable) && (key === ' ' || key === 'Enter')) return true;
  if (target.matches(movable) && (key.startsWith('Arrow') || key === 'Home' || key === 'End')) return true;
  return target.matches('select') && /^\w$/.test(key);
}

/** Keyboard shortcuts of a page and the dialog that lists them. Fields and buttons keep their own keys. */
export class Keys {
  private readonly dialog: HTMLDialogElement;
  private readonly down = (event: KeyboardEvent) => this.press(event);
  /** Removes the focus from a clicked button, so that the space bar works again. */
  private readonly click = (event: MouseEvent) => {
    const at = (event.target as Element).closest<HTMLElement>('button, summary, input[type=checkbox]');
    if (event.detail > 0 && !this.dialog.open) at?.blur();
  };

  /** The dialog is not modal if the rest of the page must stay usable; no key acts but ? unless `mayAct`. */
  constructor(
    private readonly list: Key[],
    private readonly isModal = true,
    private readonly mayAct: () => boolean = () => true,
  ) {
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
    window.addEventListener('click', this.click);
  }

  help(): void {
    if (this.dialog.open) return;
    if (this.isModal) this.dialog.showModal();
    else this.dialog.show();
  }

  destroy(): void {
    window.removeEventListener('keydown', this.down);
    window.removeEventListener('click', this.click);
    this.dialog.remove();
  }

  private press(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (document.querySelector('dialog:modal')) return; // it has its own keys
    if (this.dialog.open || event.ctrlKey || event.altKey || event.metaKey) return;
    if (target.matches(writable) && event.key === 'Escape') target.blur();
    if (isTaken(target, event.key)) return;
    const found = this.list.find((one) => one.keys.includes(event.key));
    if (!found || !(this.mayAct() || found.keys.includes('?'))) return;
    event.preventDefault();
    found.act(event);
  }
}
