// SPDX-License-Identifier: Apache-2.0
import { words } from './numbers';
import type { Issue } from './protocol';

/** Issues by the field at which they are shown, and those that belong to none. */
export interface Routed {
  at: Map<string, string>;
  loose: Issue[];
}

/**
 * Finds the field of each issue: that of one of its keys, else the nearest that was asked for, else the `type` of its
 * group. An issue without keys is about the change if only one was `asked`.
 */
export function routed(issues: Issue[], fields: string[], asked: string[]): Routed {
  const known = new Set(fields);
  const at = new Map<string, string>();
  const loose: Issue[] = [];
  for (const issue of issues) {
    const keys = issue.keys.length > 0 ? issue.keys : asked.length === 1 ? asked : [];
    const place = keys.map((key) => fieldFor(key, known, asked)).find((one) => one !== undefined);
    if (place === undefined) loose.push(issue);
    else at.set(place, at.has(place) ? `${at.get(place)} ${named(issue.text, place)}` : named(issue.text, place));
  }
  return { at, loose };
}

/** A text with the label of a field in place of its key. */
function named(text: string, key: string): string {
  const name = key.slice(key.lastIndexOf('.') + 1);
  return text.replace(
    new RegExp(`(^|\\s)(${key.replaceAll('.', '\\.')}|${name})(?=\\s)`, 'g'),
    `$1${words(name).label}`,
  );
}

function fieldFor(key: string, fields: Set<string>, asked: string[]): string | undefined {
  const near = asked.filter((one) => one.startsWith(`${key}.`) || key.startsWith(`${one}.`));
  const places = [key, ...near.flatMap((one) => [one, `${one}.type`]), `${key}.type`];
  return places.find((one) => fields.has(one));
}
