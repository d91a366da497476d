// SPDX-License-Identifier: Apache-2.0
// What is under the pointer, in words. Positions in µm, y up.
import { number } from '../numbers';
import type { Point } from '../protocol';
import type { Said } from './key';

/** A direction of the radar; their headings ascend. */
export interface Beam {
  heading: number; // [rad]
  fate: number; // 0 kept, 1 obstacle, 2 wall, 3 turn
  score: number; // φ
  obstacle: number; // that screens it, or −1
}

/** A heading in degrees from 0 to 359, counterclockwise from the right. */
export function degrees(heading: number): number {
  return ((Math.round((heading * 180) / Math.PI) % 360) + 360) % 360;
}

/** Length of a polyline of alternating x and y. */
export function lengthOf(points: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 3; i < points.length; i += 2)
    sum += Math.hypot(points[i - 1]! - points[i - 3]!, points[i]! - points[i - 2]!);
  return sum;
}

/** Distance of a point to a polyline of alternating x and y; infinite without points. */
export function distanceTo(points: ArrayLike<number>, [x, y]: Point): number {
  let least = points.length >= 2 ? Math.hypot(points[0]! - x, points[1]! - y) : Infinity;
  for (let i = 3; i < points.length; i += 2)
    least = Math.min(least, toSegment([x, y], points[i - 3]!, points[i - 2]!, points[i - 1]!, points[i]!));
  return least;
}

/** Index of the segment, given as pairs of point indices, nearest to a point within `reach`; −1 without one. */
export function segmentAt(points: Float32Array, pairs: ArrayLike<number>, at: Point, reach: number): number {
  let [found, least] = [-1, reach];
  for (let k = 0; 2 * k + 1 < pairs.length; ++k) {
    const [a, b] = [2 * pairs[2 * k]!, 2 * pairs[2 * k + 1]!];
    const distance = toSegment(at, points[a]!, points[a + 1]!, points[b]!, points[b + 1]!);
    if (distance > least) continue;
    [found, least] = [k, distance];
  }
  return found;
}

function toSegment([x, y]: Point, ax: number, ay: number, bx: number, by: number): number {
  const square = (bx - ax) ** 2 + (by - ay) ** 2;
  const along = square > 0 ? ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square : 0;
  const t = Math.min(Math.max(along, 0), 1);
  return Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
}

/** The direction of the radar in which a point lies, seen from its centre. */
export function beamAt(beams: Beam[], dx: number, dy: number): Beam | undefined {
  const heading = Math.atan2(dy, dx);
  const off = (beam: Beam) => Math.abs(Math.atan2(Math.sin(beam.heading - heading), Math.cos(beam.heading - heading)));
  let nearest: Beam | undefined;
  for (const beam of beams) if (!nearest || off(beam) < off(nearest)) nearest = beam;
  return nearest;
}

/** Why the radar kept a direction or did not. `step` is how far it looks [µm]. */
export function sectorText(beam: Beam, isChosen: boolean, step: number): Said {
  const at = `Direction ${degrees(beam.heading)}°`;
  const ahead = `a step of ${number(step, 3)} µm`;
  const score = `score φ ${number(beam.score, 3)}`;
  if (isChosen) return { title: `${at}: chosen`, lines: [`The highest ${score} of those kept.`] };
  if (beam.fate === 0)
    return { title: `${at}: kept`, lines: [`Its ${score} is lower than that of the chosen direction.`] };
  if (beam.fate === 3)
    return {
      title: `${at}: turns too far`,
      lines: [`It is free, with the ${score}, but turns further from the heading than is allowed; others do not.`],
    };
  if (beam.fate === 2) return { title: `${at}: screened by a wall`, lines: [`After ${ahead} the wall is too near.`] };
  const which = beam.obstacle < 0 ? 'an obstacle' : `obstacle ${beam.obstacle}`;
  return { title: `${at}: screened by ${which}`, lines: [`After ${ahead} it is too near.`] };
}

/** Why the radar chose its direction. */
export function choiceText(beams: Beam[], best: number | undefined, straight: number | undefined): Said {
  if (straight !== undefined)
    return {
      title: `Direction ${degrees(straight)}°: straight on`,
      lines: ['No obstacle and no wall is within the detection circle.'],
    };
  const chosen = best === undefined ? undefined : beams[best];
  if (!chosen) return { title: 'No direction is free', lines: whyNot(beams) };
  const count = beams.filter(({ fate }) => fate === 0).length;
  return {
    title: `Chosen direction ${degrees(chosen.heading)}°`,
    lines: [
      `The highest score φ ${number(chosen.score, 3)} of ${count} directions kept.`,
      ...whyNot(beams),
      'φ is high towards the goal and away from the nearest obstacle.',
    ],
  };
}

/** Numbers of the directions that fell away, by reason. */
function whyNot(beams: Beam[]): string[] {
  const of = (fate: number) => beams.filter((one) => one.fate === fate);
  const screened = of(1);
  const numbers = [...new Set(screened.map(({ obstacle }) => obstacle).filter((one) => one >= 0))].sort(
    (a, b) => a - b,
  );
  const by = numbers.length === 0 ? 'obstacles' : `obstacle${numbers.length > 1 ? 's' : ''} ${list(numbers)}`;
  const count = (many: Beam[], does: string, one: string) =>
    many.length === 0 ? [] : [`${many.length} ${many.length === 1 ? one : does}.`];
  return [
    ...count(screened, `are screened by ${by}`, `is screened by ${by}`),
    ...count(of(2), 'are screened by walls', 'is screened by walls'),
    ...count(of(3), 'turn too far', 'turns too far'),
  ];
}

function list(numbers: number[]): string {
  return numbers.length < 2 ? numbers.join() : `${numbers.slice(0, -1).join(', ')} and ${numbers.at(-1)}`;
}

/** Speed and heading in words; empty without a speed. */
export function motionText(velocity: Point | undefined): string[] {
  if (!velocity) return [];
  const speed = Math.hypot(...velocity);
  if (speed < 0.05) return ['Rests.'];
  return [`Moves at ${number(speed, 3)} µm/s to ${degrees(Math.atan2(velocity[1], velocity[0]))}°.`];
}

/** A swarm as its frame says. */
export function swarmText(frame: { [key: string]: unknown }, type: string): Said {
  const value = (key: string) =>
    typeof frame[key] === 'number' && Number.isFinite(frame[key]) ? frame[key] : undefined;
  const radius = value('radius_um') ?? 0;
  const gaps: [string, number | undefined][] = [
    ['wall', value('wall_clearance_um')],
    ['obstacle', value('obstacle_clearance_um')],
  ];
  const known = gaps.filter((one): one is [string, number] => one[1] !== undefined);
  known.sort((a, b) => a[1] - b[1]);
  const [next] = known;
  const heading = value('heading_rad');
  const goal = value('goal_distance_um');
  return {
    title: type ? `Swarm, a ${type}` : 'Swarm',
    lines: [
      `Radius ${number(radius, 3)} µm${heading === undefined ? '' : `, heading ${degrees(heading)}°`}, speed ${number(value('speed_um_per_s') ?? 0, 3)} µm/s.`,
      ...(next ? [`Gap of ${number(next[1] - radius, 3)} µm to the next ${next[0]}.`] : []),
      ...(goal === undefined ? [] : [`${number(goal, 4)} µm to the goal.`]),
    ],
  };
}

/** Numbers of robots within a distance of a goal. */
export function gathered(robots: Float32Array, [x, y]: Point, within: number): number {
  let count = 0;
  for (let i = 0; i + 1 < robots.length; i += 2) if (Math.hypot(robots[i]! - x, robots[i + 1]! - y) <= within) ++count;
  return count;
}

/** The robots nearest to a point within `reach`: the first one, and how many are as near as `pile` to it. */
export function robotAt(
  robots: Float32Array,
  [x, y]: Point,
  reach: number,
  pile: number,
): { index: number; count: number } | undefined {
  let [index, least] = [-1, reach];
  for (let i = 0; i + 1 < robots.length; i += 2) {
    const distance = Math.hypot(robots[i]! - x, robots[i + 1]! - y);
    if (distance > least) continue;
    [index, least] = [i / 2, distance];
  }
  if (index < 0) return undefined;
  return { index, count: gathered(robots, [robots[2 * index]!, robots[2 * index + 1]!], pile) };
}
