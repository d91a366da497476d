// SPDX-License-Identifier: Apache-2.0
import type { RigInfo, RigStanding } from './protocol';
import { nearness } from './rig_limits';

const states = {
  dry: 'Dry run',
  opening: 'The devices are being opened',
  armed: 'ARMED: the coils are driven',
  ended: 'The run has ended',
};

/** Sight of the swarm in words. */
export const sights: { [trouble: string]: string } = {
  '': 'seen',
  none: 'not seen',
  several: 'several are seen',
  far: 'too far from its last position',
  size: 'of a different size',
  split: 'split into parts',
  merged: 'merged with another',
  robots: 'robots are missing',
};

type Known = RigStanding | undefined;

/** News of a rig since its last message, a sentence each. */
export function newsOf(before: Known, now: RigStanding, info?: RigInfo): string[] {
  return [
    ...stateNews(before, now),
    ...(before?.state === now.state
      ? [...sightNews(before, now), ...countNews(before, now), ...limitNews(before, now, info)]
      : []),
  ];
}

function stateNews(before: Known, now: RigStanding): string[] {
  const why = now.state === 'ended' && now.why !== '' ? `: ${now.why.replaceAll('_', ' ')}` : '';
  const zero = (one: Known) => one?.zero_confirmed ?? null;
  return [
    ...(before?.state === now.state ? [] : [`${states[now.state]}${why}.`]),
    ...(zero(before) === zero(now) || zero(now) === null
      ? []
      : [
          zero(now)
            ? 'The device confirmed that its coils are at zero.'
            : 'The device has NOT confirmed that its coils are at zero.',
        ]),
  ];
}

function sightNews(before: Known, now: RigStanding): string[] {
  const [was, is] = [before?.sight ?? '', now.sight ?? ''];
  if (was === is) return [];
  return [`The swarm: ${is === '' ? 'seen again' : (sights[is] ?? is.replaceAll('_', ' '))}.`];
}

/** Counters that grew, each with the words for one and for more. */
function countNews(before: Known, now: RigStanding): string[] {
  const grew = (key: 'missed_deadlines' | 'late_currents' | 'resumed', one: string, more: string) => {
    const by = (now[key] ?? 0) - (before?.[key] ?? 0);
    return by <= 0 ? [] : [by === 1 ? `${one}.` : `${by} ${more}.`];
  };
  return [
    ...grew('missed_deadlines', 'A tick missed its deadline', 'ticks missed their deadlines'),
    ...grew('late_currents', 'Currents came late once', 'times currents came late'),
    ...((now.frame_gaps ?? 0) > (before?.frame_gaps ?? 0) ? ['Frames of the camera are lost or late.'] : []),
    ...grew('resumed', 'The device switched itself off and was resumed', 'times the device switched itself off'),
  ];
}

function limitNews(before: Known, now: RigStanding, info: RigInfo | undefined): string[] {
  const scales = (one: Known) => Math.min(one?.scale ?? 1, one?.device_scale ?? 1);
  const [was, is] = [scales(before) < 0.999, scales(now) < 0.999];
  const weakened = is
    ? [`The limits leave ${Math.round(100 * scales(now))} % of the field.`]
    : ['The limits leave the whole field again.'];
  const of = (what: string, key: 'currents_a' | 'temperatures_c', limits: (number | null)[]) =>
    (now[key] ?? []).flatMap((value, i) => {
      const near = nearness(value, limits[i] ?? null);
      const then = nearness(before?.[key]?.[i] ?? 0, limits[i] ?? null);
      return near === then || near === '' ? [] : [`${what} of ${info?.coils[i] ?? `coil ${i}`} is ${near}.`];
    });
  return [
    ...(was === is ? [] : weakened),
    ...of('Temperature', 'temperatures_c', info?.max_temperature_c ?? []),
    ...of('Current', 'currents_a', info?.max_current_a ?? []),
  ];
}

/** One line of the log; equal ones within `span` seconds are counted. */
export interface Entry {
  at: Date;
  t_s: number | undefined; // of the run
  text: string;
  count: number;
}

const most = 300;
const span = 10; // [s]

/** The log with another line, the newest first. */
export function logged(log: Entry[], text: string, at: Date, t_s: number | undefined): Entry[] {
  const same = log.findIndex((one) => one.text === text && at.getTime() - one.at.getTime() < 1000 * span);
  if (same < 0) return [{ at, t_s, text, count: 1 }, ...log].slice(0, most);
  return log.map((one, i) => (i === same ? { ...one, count: one.count + 1 } : one));
}
