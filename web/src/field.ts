// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import { numberEntry } from './number_entry';
import { number, words } from './numbers';
import type { Json } from './protocol';
import { type Schema, allowsNull, described, rangeOf, withoutNull } from './schema';

/** One parameter of the form. */
export interface Field {
  key: string;
  root: HTMLElement;
  /** Text for the search. */
  text: string;
  show(value: Json | undefined): void;
  setIssue(text: string): void;
  /** Shows the value again in place of what was entered. */
  restore(): void;
  setWaiting(waits: boolean): void;
  setEnabled(enabled: boolean): void;
}

/** `drags`: the value is one within a drag. */
export type Change = (key: string, value: Json, drags?: boolean) => void;

/** Callbacks of a control for typed values. */
interface Typed {
  change(value: Json, drags?: boolean): void;
  /** Shows at the field why the text is no value, and restores the previous value. */
  complain(text: string): void;
}

interface Control {
  nodes: HTMLElement[];
  show(value: Json | undefined): void;
}

/** A field of a form; `form` is the form's name, of which a page may have one only. `reach` is the largest length that makes sense [µm]. */
export function field(key: string, schema: Schema, change: Change, form = 'field', reach = Infinity): Field {
  const name = key.slice(key.lastIndexOf('.') + 1);
  const inner = withoutNull(schema);
  const { doc, unit } = described(schema);
  const { label, unit: keyUnit } = words(name);
  const shownUnit = unit || keyUnit;
  const most = shownUnit === 'µm' || shownUnit === 'µm/s' ? reach : Infinity; // a map crossed in a second is fast
  const slider = { name: label, unit: shownUnit, most };
  const id = `${form}-${key}`;
  const control = controlOf(id, inner, allowsNull(schema), slider, {
    change: (value, drags) => change(key, value, drags),
    complain: (text) => setIssue(text),
  });
  const standard = schema.default;
  let shown: Json | undefined;
  const reset = element(
    'button',
    {
      type: 'button',
      class: 'quiet reset',
      title: `Back to the default: ${brief(standard)}`,
      'aria-label': `Reset ${label}`,
      hidden: true,
      onclick: () => change(key, standard ?? null),
    },
    '↺',
  );
  const issue = element('p', { class: 'issue', role: 'alert', hidden: true });
  const setIssue = (text: string) => {
    issue.hidden = text === '';
    issue.textContent = text;
    root.classList.toggle('wrong', text !== '');
    if (text !== '') control.show(shown);
  };
  const facts = [doc, range(inner), standard === undefined ? '' : `Default ${brief(standard)}.`];
  const root = element(
    'div',
    { class: 'field', 'data-key': key },
    element('label', { for: id }, label),
    element('span', { class: 'unit' }, shownUnit),
    reset,
    element('div', { class: 'control' }, ...control.nodes),
    element('p', { class: 'doc' }, facts.filter((one) => one !== '').join(' ')),
    issue,
  );
  return {
    key,
    root,
    text: `${key} ${label} ${doc}`.toLowerCase(),
    show: (value) => {
      if (JSON.stringify(value) !== JSON.stringify(shown) || value === undefined) control.show(value);
      shown = value;
      reset.hidden = standard === undefined || JSON.stringify(value) === JSON.stringify(standard);
    },
    setIssue,
    restore: () => control.show(shown),
    setWaiting: (waits) => root.classList.toggle('waits', waits),
    setEnabled: (enabled) => {
      for (const one of root.querySelectorAll('input, select, textarea, button'))
        (one as HTMLInputElement).disabled = !enabled;
    },
  };
}

function brief(value: Json | undefined): string {
  if (value === undefined) return '';
  if (value === null) return 'none';
  if (value === '') return 'empty';
  return typeof value === 'number' ? number(value) : JSON.stringify(value);
}

function range(schema: Schema): string {
  const { minimum: lo, maximum: hi } = schema;
  if (lo === undefined) return '';
  return hi === undefined ? `At least ${number(lo)}.` : `${number(lo)} to ${number(hi)}.`;
}

/** Name, unit and largest value of a slider. */
interface Sliding {
  name: string;
  unit: string;
  most: number;
}

function controlOf(id: string, schema: Schema, nullable: boolean, sliding: Sliding, typed: Typed): Control {
  if (schema.type === 'boolean') return toggle(id, typed.change);
  if (schema.enum) return menu(id, schema.enum, typed.change);
  if (schema.type === 'number' || schema.type === 'integer') return numeric(id, schema, nullable, sliding, typed);
  if (schema.type === 'string') return line(id, typed.change);
  return list(id, nullable, typed);
}

function toggle(id: string, change: (value: Json) => void): Control {
  const box = element('input', {
    id,
    type: 'checkbox',
    role: 'switch',
    class: 'switch',
    onchange: () => change(box.checked),
  });
  return { nodes: [box], show: (value) => (box.checked = value === true) };
}

export function menu(id: string, options: string[], change: (value: Json) => void): Control {
  const select = element(
    'select',
    { id, onchange: () => change(select.value) },
    ...options.map((one) => element('option', { value: one }, one.replaceAll('_', ' '))),
  );
  return { nodes: [select], show: (value) => (select.value = String(value)) };
}

function numeric(id: string, schema: Schema, nullable: boolean, sliding: Sliding, typed: Typed): Control {
  const change = () => {
    const value = entry.get();
    if (value !== undefined || nullable) typed.change(value ?? null);
    else typed.complain('This needs a number.');
  };
  const entry = numberEntry({ id, ...(nullable ? { placeholder: 'none' } : {}) }, change, typed.complain);
  const span = rangeOf(schema, sliding.most);
  const show = (value: Json | undefined) => entry.set(typeof value === 'number' ? value : undefined);
  if (!span) return { nodes: [entry.root], show };
  let drags = false; // the answers to a drag come later than its values
  const say = () => {
    const value = entry.get();
    slider.setAttribute('aria-valuetext', value === undefined ? 'none' : `${value} ${sliding.unit}`.trim());
  };
  const slider = element('input', {
    type: 'range',
    class: 'slider',
    min: '0',
    max: '1',
    step: '0.002',
    'aria-label': `${sliding.name}, slider`,
    oninput: () => {
      drags = true;
      entry.set(span.toValue(Number(slider.value)));
      say();
      typed.change(entry.get() ?? null, true);
    },
    onchange: () => end(),
    // A slider that is released where it began has no change.
    onpointerup: () => void window.setTimeout(() => drags && end(), 100),
    onblur: () => drags && end(),
  });
  const end = () => {
    drags = false;
    typed.change(entry.get() ?? null);
  };
  return {
    nodes: [slider, entry.root],
    show: (value) => {
      if (drags) return;
      show(value);
      slider.value = String(typeof value === 'number' ? span.toShare(value) : 0);
      say();
    },
  };
}

function line(id: string, change: (value: Json) => void): Control {
  const entry = element('input', { id, type: 'text', spellcheck: 'false', onchange: () => change(entry.value) });
  return { nodes: [entry], show: (value) => (entry.value = String(value ?? '')) };
}

/** Parses JSON; undefined if the text is invalid or has an infinite number. */
function parsed(text: string): Json | undefined {
  const isFinite = (value: Json): boolean =>
    Array.isArray(value) ? value.every(isFinite) : typeof value !== 'number' || Number.isFinite(value);
  try {
    const value = JSON.parse(text) as Json;
    return isFinite(value) ? value : undefined;
  } catch {
    return undefined;
  }
}

/** Control for lists of numbers or points, as JSON. */
function list(id: string, nullable: boolean, typed: Typed): Control {
  const entry = element('input', {
    id,
    type: 'text',
    spellcheck: 'false',
    ...(nullable ? { placeholder: 'none' } : {}),
    onchange: () => {
      const value = entry.value.trim() === '' && nullable ? null : parsed(entry.value);
      if (value === undefined || (value === null && !nullable))
        typed.complain(`${entry.value.trim() === '' ? 'This' : entry.value} is not a list such as [1, 2].`);
      else typed.change(value);
    },
  });
  return {
    nodes: [entry],
    show: (value) => {
      entry.value = value == null ? '' : JSON.stringify(value).replaceAll(',', ', ');
    },
  };
}
