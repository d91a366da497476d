// SPDX-License-Identifier: Apache-2.0
import type { Point } from '../protocol';
import { isGround, minRadius } from './layers/obstacles';
import type { Moment } from './motion';
import type { Grip } from './pointer';
import type { Place } from './scenario';
import type { View } from './view';

const slack = 4; // [px]
const mark = 13; // radius of a mark [px]

/** The mark at a screen position. */
export function hitMark(
  kind: 'goal' | 'start',
  places: Place[],
  view: View,
  screen: Point,
): { what: Grip; place: Point } | undefined {
  const index = places.findIndex(({ at }) => {
    const [x, y] = view.toScreen(at);
    return Math.hypot(x - screen[0], y - screen[1]) <= mark;
  });
  const place = places[index];
  if (!place) return undefined;
  return { what: places.length > 1 ? { kind, index } : { kind }, place: place.at };
}

/** The obstacle at a screen position. */
export function hitObstacle(now: Moment, view: View, screen: Point): Grip | undefined {
  const [x, y] = view.toWorld(screen);
  const near = view.um(slack);
  const { discs, solids } = now;
  for (let i = discs.length - 4; i >= 0; i -= 4) {
    const radius = Math.max(discs[i + 2]!, view.um(minRadius));
    if (Math.hypot(x - discs[i]!, y - discs[i + 1]!) <= radius + near)
      return { kind: 'obstacle', index: discs[i + 3]! };
  }
  for (const { rings, number } of [...solids].reverse()) {
    const inside = rings.reduce((odd, ring) => odd !== isInside(ring, x, y), false);
    const isHit = inside || rings.some((ring) => isNear(ring, x, y, near));
    if (isHit && !isGround(rings[0]!, view)) return { kind: 'obstacle', index: number };
  }
  return undefined;
}

function isInside(ring: Float32Array, x: number, y: number): boolean {
  let odd = false;
  eachEdge(ring, (ax, ay, bx, by) => {
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) odd = !odd;
  });
  return odd;
}

function isNear(ring: Float32Array, x: number, y: number, near: number): boolean {
  let found = false;
  eachEdge(ring, (ax, ay, bx, by) => {
    const square = (bx - ax) ** 2 + (by - ay) ** 2;
    const along = square > 0 ? ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square : 0;
    const t = Math.min(Math.max(along, 0), 1);
    found ||= Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)) <= near;
  });
  return found;
}

type Visit = (ax: number, ay: number, bx: number, by: number) => void;

function eachEdge(ring: Float32Array, visit: Visit): void {
  for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2)
    visit(ring[j]!, ring[j + 1]!, ring[i]!, ring[i + 1]!);
}
