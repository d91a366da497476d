// SPDX-License-Identifier: Apache-2.0
import { Digest } from './digest';
import type { RunEvent } from './protocol';

/** Numbers of all ticks so far, a list for each column, and events. */
export class History {
  readonly columns = new Map<string, number[]>();
  events: RunEvent[] = [];
  private readonly digests = new Map<string, Digest>();

  /** The column in few points, for a plot. */
  digest(name: string): Digest {
    const digest = this.digests.get(name) ?? new Digest(this.column(name));
    if (this.columns.has(name)) this.digests.set(name, digest);
    return digest;
  }

  column(name: string): number[] {
    return this.columns.get(name) ?? [];
  }

  get times(): number[] {
    return this.column('t_s');
  }

  take(names: string[], numbers: Float64Array, events: RunEvent[], anew: boolean): void {
    if (anew) {
      this.columns.clear();
      this.digests.clear();
      this.events = [];
    }
    names.forEach((name, at) => {
      const list = this.columns.get(name) ?? [];
      this.columns.set(name, list);
      for (let i = at; i < numbers.length; i += names.length) list.push(numbers[i] as number);
    });
    this.events.push(...events);
  }

  /** Index of the frame nearest to a time. */
  nearest(time: number): number {
    const times = this.times;
    let lo = 0;
    let hi = times.length - 1;
    while (lo < hi) {
      const middle = (lo + hi) >> 1;
      if ((times[middle] as number) < time) lo = middle + 1;
      else hi = middle;
    }
    const before = times[lo - 1];
    return before !== undefined && time - before < (times[lo] as number) - time ? lo - 1 : lo;
  }
}
