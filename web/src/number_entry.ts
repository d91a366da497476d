// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { typedNumber } from './numbers';

type Attributes = Parameters<typeof element>[1];

/**
 * A field for a number. It is no input of type number, since browsers drop a comma in those, by which 50,5 becomes 505.
 * What is no number is not taken: the value before comes back, and the field's title says why.
 */
export interface NumberEntry {
  root: HTMLInputElement;
  /** The last number typed; undefined while it is empty. */
  get(): number | undefined;
  set(value: number | undefined): void;
}

/** Calls `change` after a number was typed, or the field was emptied, and `complain` with what is wrong, else ''. */
export function numberEntry(
  attributes: Attributes,
  change: () => void = () => undefined,
  complain: (trouble: string) => void = () => undefined,
): NumberEntry {
  let value: number | undefined;
  const show = () => (root.value = value === undefined ? '' : String(value));
  const root = element('input', {
    ...attributes,
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    class: 'number',
    onchange: () => {
      const typed = root.value.trim() === '' ? { value: undefined } : typedNumber(root.value);
      const trouble = 'trouble' in typed ? typed.trouble : '';
      root.setCustomValidity(trouble);
      if (!('trouble' in typed)) value = typed.value;
      show();
      complain(trouble);
      if (trouble === '') change();
    },
  });
  return {
    root,
    get: () => value,
    set: (to) => {
      value = to;
      show();
    },
  };
}
