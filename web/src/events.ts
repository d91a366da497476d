// SPDX-License-Identifier: Apache-2.0
import type { RunEvent } from './protocol';

/** Name of an event for people. */
export function eventName(kind: string): string {
  return kind.replaceAll('_', ' ');
}

/** Events at most `within` seconds from a time, in words; equal ones are counted. */
export function eventsNear(events: RunEvent[], time: number, within: number): string[] {
  const counts = new Map<string, number>();
  for (const { kind, t_s } of events)
    if (Math.abs(t_s - time) <= within) counts.set(eventName(kind), (counts.get(eventName(kind)) ?? 0) + 1);
  return [...counts].map(([name, count]) => (count > 1 ? `${count} × ${name}` : name));
}

/** The event after a time, or before it if `by` is negative. */
export function nextEvent(events: RunEvent[], time: number, by: number): RunEvent | undefined {
  const tolerance = 1e-6;
  if (by > 0) return events.find(({ t_s }) => t_s > time + tolerance);
  return events.filter(({ t_s }) => t_s < time - tolerance).at(-1);
}

/** Times of at most `most` ticks in a range: multiples of 1, 2 or 5 times a power of ten [s]. */
export function ticksOf(lo: number, hi: number, most: number): number[] {
  if (!(hi > lo) || most < 1) return [];
  const least = (hi - lo) / most;
  const decade = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((one) => one * decade).find((one) => one >= least * (1 - 1e-9)) as number;
  const ticks: number[] = [];
  for (let i = Math.ceil(lo / step - 1e-9) || 0; i * step <= hi + 1e-9 * step; ++i) ticks.push(i * step);
  return ticks;
}
