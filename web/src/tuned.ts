// SPDX-License-Identifier: Apache-2.0
import type { Json, Scenario } from './protocol';
import { at, isSame } from './settings';

/** Objects as they were left when their type was changed, by key and type. Those in a list move with their entry. */
export class Tuned {
  private kept: { key: string; type: string; value: Json }[] = [];

  keep(key: string, value: Json | undefined): void {
    if (!value || typeof value !== 'object' || Array.isArray(value)) return;
    const type = String(value['type']);
    this.kept = this.kept.filter((one) => one.key !== key || one.type !== type);
    this.kept.push({ key, type, value });
  }

  of(key: string, type: string): Json | undefined {
    return this.kept.find((one) => one.key === key && one.type === type)?.value;
  }

  /** Takes a change of the scenario: entries of its lists may have moved or gone. */
  follow(before: Scenario, after: Scenario): void {
    this.kept = this.kept.flatMap((one) => {
      const key = moved(one.key, before, after);
      return key === undefined ? [] : [{ ...one, key }];
    });
  }
}

/** The key of the same object after a change; undefined if its entry is gone. */
export function moved(key: string, before: Scenario, after: Scenario): string | undefined {
  const names = key.split('.');
  for (let i = 1; i < names.length; ++i) {
    const list = names.slice(0, i).join('.');
    const [from, to] = [at(before, list), at(after, list)];
    if (!Array.isArray(from) || !Array.isArray(to) || from.length === to.length) continue;
    const index = placeOf(Number(names[i]), from, to);
    if (index === undefined) return undefined;
    names[i] = String(index);
  }
  return names.join('.');
}

/** The place in `to` of an entry of `from`, from which entries were removed or to which some were added. */
function placeOf(index: number, from: Json[], to: Json[]): number | undefined {
  const entry = from[index] as Json;
  const equalBefore = from.slice(0, index).filter((one) => isSame(one, entry)).length;
  const places = to.flatMap((one, i) => (isSame(one, entry) ? [i] : []));
  return places[Math.min(equalBefore, places.length - 1)];
}
