// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Live } from './live';

const period = 1000; // ms between two pings
const kept = 5; // round trips of which the median counts

/** The middle one of some numbers; undefined of none. */
export function median(values: number[]): number | undefined {
  return [...values].sort((a, b) => a - b)[(values.length - 1) >> 1];
}

/**
 * Age of the picture and delay of the connection, in words, and whether they are a reason to be careful. Times in ms;
 * `taken` is the age of a frame when it was processed, `arrived` the time since the newest picture came; `runs`: whether there are
 * pictures.
 */
export function linkText(
  roundTrip: number | undefined,
  arrived: number | undefined,
  taken: number,
  runs = true,
): { text: string; isSlow: boolean } {
  const link = roundTrip === undefined ? 'Link –' : `Link ${milliseconds(roundTrip)} there and back`;
  if (!runs) return { text: link, isSlow: false }; // no picture is to come
  const age = arrived === undefined ? undefined : arrived + taken + (roundTrip ?? 0) / 2;
  const isSlow = (roundTrip ?? 0) > 300 || (age ?? 0) > 700;
  return {
    text: [
      age === undefined ? 'No picture yet' : `Picture ${milliseconds(age)} old`,
      link,
      ...(isSlow ? ['SLOW: what you see is past'] : []),
    ].join(' · '),
    isSlow,
  };
}

function milliseconds(ms: number): string {
  return ms < 1000 ? `${Math.round(ms)} ms` : `${(ms / 1000).toFixed(1)} s`;
}

/** Shows how old the camera's picture is, and how long the connection takes. */
export function rigLink(live: Live): { root: HTMLElement; destroy: () => void } {
  const root = element('span', {
    class: 'link',
    title: 'Age of the camera picture, and delay of the connection to the lab',
  });
  let trips: number[] = [];
  let came: number | undefined;
  let isOpen = false;
  const show = () => {
    const { text, isSlow } = linkText(
      median(trips),
      came === undefined ? undefined : performance.now() - came,
      live.rig?.latency_ms?.frame_age[0] ?? 0,
      live.rig?.state === 'dry' || live.rig?.state === 'armed',
    );
    root.textContent = isOpen ? text : '';
    root.classList.toggle('slow', isSlow);
  };
  const ping = async () => {
    const sent = performance.now();
    if (isOpen) {
      const answer = await live.ask({ do: 'ping' });
      if (isOpen && answer.issues.length === 0) trips = [...trips.slice(1 - kept), performance.now() - sent];
    }
    show();
  };
  let waits = false;
  const timer = window.setInterval(() => {
    show();
    if (waits) return; // for the answer: the delay is at least that
    waits = true;
    void ping().finally(() => (waits = false));
  }, period);
  live.listen((message) => {
    if (message.type === 'picture') came = performance.now();
  });
  live.onState((state) => {
    isOpen = state === 'open';
    trips = [];
    show();
  });
  return { root, destroy: () => window.clearInterval(timer) };
}
