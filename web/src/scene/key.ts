// SPDX-License-Identifier: Apache-2.0

/** Look of a mark in the legend. */
export type Shape =
  'disc' | 'line' | 'dashed' | 'ring' | 'target' | 'area' | 'band' | 'arrow' | 'cross' | 'diamond' | 'tree';

/** One entry of the legend. */
export interface Entry {
  text: string;
  shape: Shape;
  colour: number; // 0xrrggbb
  alpha?: number;
}

/** Words on something in the picture: a title, and its numbers, a line each. */
export interface Said {
  title: string;
  lines: string[];
}

/** Merges the entries of a run so far with those of now: what was seen once stays, in the order of the layers. */
export function kept(before: Map<string, Entry>, now: Entry[][]): Map<string, Entry> {
  const all = new Map<string, Entry>();
  now.forEach((entries, layer) => {
    const key = (one: Entry) => `${layer} ${one.text}`;
    for (const [name, entry] of before) if (name.startsWith(`${layer} `)) all.set(name, entry);
    for (const entry of entries) all.set(key(entry), entry);
  });
  return all;
}

/** Whether the legend is unfolded at first: on narrow screens not. */
export function isUnfolded(stored: string | null, width: number): boolean {
  return stored === null ? width >= 700 : stored === 'open';
}
