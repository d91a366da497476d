// SPDX-License-Identifier: Apache-2.0
import type { Json } from './protocol';

/** A value for `--set KEY=VALUE`: plain words are unquoted, everything else is JSON. */
export function text(value: Json): string {
  if (typeof value === 'string' && /^[a-z][a-z_]*$/.test(value)) {
    const isWord = !['true', 'false', 'null', 'yes', 'no', 'on', 'off'].includes(value);
    return isWord ? value : JSON.stringify(value);
  }
  return JSON.stringify(value);
}

export function keyOf(setting: string): string {
  return setting.slice(0, setting.indexOf('='));
}

/** Joins lists of settings; a later one replaces those of its key and of keys within it. */
export function combine(...lists: string[][]): string[] {
  let all: string[] = [];
  for (const setting of lists.flat()) {
    const key = keyOf(setting);
    all = all.filter((one) => keyOf(one) !== key && !keyOf(one).startsWith(`${key}.`));
    all.push(setting);
  }
  return all;
}

export function isSame(a: Json | undefined, b: Json | undefined): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

/** Quotes a word for a POSIX shell. */
export function shellWord(word: string): string {
  return /^[\w\-./=,:+@%]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/** The value at a key such as obstacles.3.motion. */
export function at(value: Json | undefined, key: string): Json | undefined {
  let here: Json | undefined = value;
  for (const name of key.split('.')) {
    if (Array.isArray(here)) here = here[Number(name)];
    else if (here && typeof here === 'object') here = here[name];
    else return undefined;
  }
  return here;
}
