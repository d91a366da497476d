// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Field } from './field';
import type { Issue, Json } from './protocol';
import type { Schema } from './schema';

type Values = { [key: string]: Json };

/** Those values of an object that differ from its schema's defaults. */
export function differing(schema: Schema | undefined, value: Values): Values {
  const kept: Values = {};
  for (const [name, one] of Object.entries(schema?.properties ?? {})) {
    const own = value[name];
    if (own === undefined || name === 'type') continue;
    if (one.properties && own && typeof own === 'object' && !Array.isArray(own)) {
      const inner = differing(one, own);
      if (Object.keys(inner).length > 0) kept[name] = inner;
    } else if (JSON.stringify(own) !== JSON.stringify(one.default)) kept[name] = own;
  }
  return kept;
}

/** An object at `key` without the values that these issues name. */
export function without(key: string, value: Values, issues: Issue[]): Values {
  const left = structuredClone(value);
  for (const name of issues.flatMap((one) => one.keys)) {
    const path = name.startsWith(`${key}.`) ? name.slice(key.length + 1).split('.') : [];
    let at: Json | undefined = left;
    for (const part of path.slice(0, -1))
      at = at && typeof at === 'object' && !Array.isArray(at) ? at[part] : undefined;
    const last = path.at(-1);
    if (last && last !== 'as_published' && at && typeof at === 'object' && !Array.isArray(at)) delete at[last];
  }
  return left;
}

/** Buttons for a navigator as its paper has it, and with the program's additions. */
export function presets(key: string, set: (isPublished: boolean) => void): Field {
  const button = (label: string, title: string, on: boolean) =>
    element('button', { type: 'button', title, 'aria-pressed': 'false', onclick: () => set(on) }, label);
  const published = button('As published', "The paper's method, without the program's additions", true);
  const ours = button('Ours', "The paper's method with the program's additions", false);
  const root = element('div', { class: 'field presets', role: 'group', 'aria-label': 'Presets' }, published, ours);
  return {
    key: `${key}.as_published`,
    root,
    text: `${key} preset as published ours`,
    show: (value) => {
      published.setAttribute('aria-pressed', String(value === true));
      ours.setAttribute('aria-pressed', String(value === false));
    },
    setIssue: () => undefined, // the field itself says it
    restore: () => undefined, // nothing is entered
    setWaiting: (waits) => root.classList.toggle('waits', waits),
    setEnabled: (enabled) => root.querySelectorAll('button').forEach((one) => (one.disabled = !enabled)),
  };
}
