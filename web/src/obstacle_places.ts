// SPDX-License-Identifier: Apache-2.0
import type { Json, Point, Scenario } from './protocol';
import { at } from './settings';

/** Key of a motion's position. */
const places: { [motion: string]: string } = {
  still: 'position_um',
  straight: 'start_um',
  harmonic_line: 'centre_um',
  harmonic_arc: 'pivot_um',
  waypoints: 'points_um',
};

/** Key and value of a change that moves an obstacle. */
export interface Move {
  key: string;
  value: Point | Point[];
  /** Position afterwards: the first one of several. */
  place: Point;
}

/** The change that moves an obstacle by this [µm]; undefined if its motion comes from a file. */
export function movedObstacle(scenario: Scenario | undefined, index: number, [dx, dy]: Point): Move | undefined {
  const motion = `obstacles.${index}.motion`;
  const name = places[String(at(scenario, `${motion}.type`))];
  if (!name) return undefined;
  const key = `${motion}.${name}`;
  const before = at(scenario, key) ?? [0, 0];
  const shift = (point: Json): Point => {
    const [x, y] = point as Point;
    return rounded([x + dx, y + dy]);
  };
  const isList = Array.isArray(before) && Array.isArray(before[0]);
  const value = isList ? (before as Json[]).map(shift) : shift(before);
  return { key, value, place: isList ? (value[0] as Point) : (value as Point) };
}

/** A disc that rests, as an entry of `obstacles`. */
export function restingDisc(position: Point, radius: number): Json {
  return {
    shape: { type: 'disc', radius_um: radius },
    motion: { type: 'still', position_um: rounded(position) },
  };
}

export function rounded([x, y]: Point): Point {
  return [Math.round(x * 10) / 10, Math.round(y * 10) / 10];
}
