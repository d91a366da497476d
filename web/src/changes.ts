// SPDX-License-Identifier: Apache-2.0
import type { Json, Scenario } from './protocol';
import { at, isSame, text } from './settings';

/** Changes of a scenario by key that it does not have yet: they wait for a restart, or for an answer. */
export class Changes {
  private readonly waiting = new Map<string, Json>();
  private readonly asked = new Map<string, Json>();

  /** Number of changes that wait for a restart. */
  get count(): number {
    return this.waiting.size;
  }

  /** Adds a change that waits for a restart, unless the scenario has the value; it replaces those within its key. */
  wait(key: string, value: Json, scenario: Scenario | undefined): void {
    for (const one of [...this.waiting.keys()]) if (one.startsWith(`${key}.`)) this.waiting.delete(one);
    if (isSame(at(scenario, key), value)) this.waiting.delete(key);
    else this.waiting.set(key, value);
  }

  /** Notes a change that was sent; the returned function notes its answer. */
  ask(key: string, value: Json): () => void {
    this.asked.set(key, value);
    return () => {
      if (this.asked.get(key) === value) this.asked.delete(key);
    };
  }

  /** Drops what the scenario has by now. */
  take(scenario: Scenario): void {
    for (const [key, value] of this.waiting) if (isSame(at(scenario, key), value)) this.waiting.delete(key);
  }

  clear(): void {
    this.waiting.clear();
  }

  /** Those that wait, as KEY=VALUE. */
  settings(): string[] {
    return [...this.waiting].map(([key, value]) => `${key}=${text(value)}`);
  }

  /** Whether the value at a key, or what contains it, waits for a restart. */
  waits(key: string): boolean {
    return [...this.waiting.keys()].some((one) => key === one || key.startsWith(`${one}.`));
  }

  /** The scenario with all changes. */
  wanted(scenario: Scenario | undefined): Scenario {
    const wanted = structuredClone(scenario ?? {});
    for (const [key, value] of [...this.waiting, ...this.asked]) {
      const names = key.split('.');
      const name = names.pop() as string;
      const parent = names.length > 0 ? at(wanted, names.join('.')) : wanted;
      if (parent && typeof parent === 'object') (parent as { [key: string]: Json })[name] = value;
    }
    return wanted;
  }
}
