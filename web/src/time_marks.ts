// SPDX-License-Identifier: Apache-2.0
import { isContact } from './events';
import type { History } from './history';

/** Kind of a mark on the time line. */
export type MarkKind = 'plan' | 'contact' | 'goal' | 'other';
const kinds: MarkKind[] = ['plan', 'contact', 'goal', 'other']; // from bottom to top

/** Frames in ascending order. */
class Frames {
  private readonly list: number[] = [];

  add(frame: number): void {
    const last = this.list.at(-1);
    if (last === undefined || frame > last) this.list.push(frame);
    else if (this.list[this.find(frame)] !== frame) this.list.splice(this.find(frame), 0, frame);
  }

  /** The first frame in a range, if there is one. */
  within(from: number, to: number): number | undefined {
    const frame = this.list[this.find(from)];
    return frame !== undefined && frame < to ? frame : undefined;
  }

  /** Index of the first frame that is not before this one. */
  private find(frame: number): number {
    let [lo, hi] = [0, this.list.length];
    while (lo < hi) {
      const middle = (lo + hi) >> 1;
      if ((this.list[middle] as number) < frame) lo = middle + 1;
      else hi = middle;
    }
    return lo;
  }
}

/** Marks of a run that grows. New rows cost what they are, a drawing what its width is. */
export class TimeMarks {
  private frames = new Map<MarkKind, Frames>();
  private rows = 0;
  private events = 0;
  private times: number[] | undefined; // of the run that was taken

  /** At most one mark of each kind for each of `places` places, by the first frame there; all of a run with fewer frames. */
  of(history: History, places: number): [MarkKind, number][] {
    this.take(history);
    const count = history.times.length;
    const bins = Math.min(count, Math.max(1, places));
    const marks: [MarkKind, number][] = [];
    for (const kind of kinds) {
      const frames = this.frames.get(kind);
      for (let bin = 0; frames && bin < bins; ++bin) {
        const from = Math.ceil((bin * count) / bins);
        const frame = frames.within(from, Math.ceil(((bin + 1) * count) / bins));
        if (frame !== undefined) marks.push([kind, frame]);
      }
    }
    return marks;
  }

  private take(history: History): void {
    const { times, events } = history;
    if (times !== this.times || times.length < this.rows || events.length < this.events) {
      [this.frames, this.rows, this.events, this.times] = [new Map(), 0, 0, times];
    }
    const planned = history.column('planned');
    for (; this.rows < times.length; ++this.rows) if (planned[this.rows]) this.add('plan', this.rows);
    for (; this.events < events.length; ++this.events) {
      const event = events[this.events]!;
      const mark = isContact(event) ? 'contact' : event.kind === 'goal_reached' ? 'goal' : 'other';
      this.add(mark, history.nearest(event.t_s));
    }
  }

  private add(kind: MarkKind, frame: number): void {
    const frames = this.frames.get(kind) ?? new Frames();
    this.frames.set(kind, frames);
    frames.add(frame);
  }
}
