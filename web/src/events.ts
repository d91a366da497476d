// SPDX-License-Identifier: Apache-2.0
import type { RunEvent } from './protocol';

type Happened = Pick<RunEvent, 'kind'> & Partial<RunEvent>;

/** An event in words: the touched obstacle, or the number of robots that are not seen. */
export function eventText({ kind, body }: Happened): string {
  if (kind === 'contact_wall') return 'contact with a wall';
  if (kind === 'contact_obstacle') return `contact with ${body === undefined ? 'an obstacle' : `obstacle ${body}`}`;
  if (kind === 'robots_unseen' && body !== undefined) return `${body} robots unseen`;
  return kind.replaceAll('_', ' ');
}

export function isContact({ kind }: Happened): boolean {
  return kind.startsWith('contact');
}

/** Events at most `within` seconds from a time, in words; equal ones are counted. */
export function eventsNear(events: RunEvent[], time: number, within: number): string[] {
  const counts = new Map<string, number>();
  for (const event of events) {
    const text = eventText(event);
    if (Math.abs(event.t_s - time) <= within) counts.set(text, (counts.get(text) ?? 0) + 1);
  }
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
