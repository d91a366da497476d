// SPDX-License-Identifier: Apache-2.0
// Data of a scenario for the scene.
import type { Json, Point, Scenario } from '../protocol';

/** Start or goal of a swarm or robot. */
export interface Place {
  at: Point;
  heading?: number; // [rad]
  tolerance?: number; // [µm]
}

type Object = { [key: string]: Json };

function object(value: Json | undefined): Object {
  return value !== null && typeof value === 'object' && !Array.isArray(value) ? value : {};
}

function point(value: Json | undefined): Point | undefined {
  if (!Array.isArray(value) || value.length !== 2) return undefined;
  const [x, y] = value.map(Number);
  return Number.isFinite(x) && Number.isFinite(y) ? [x!, y!] : undefined;
}

function points(value: Json | undefined): Point[] {
  return Array.isArray(value) ? value.map(point).filter((at) => at !== undefined) : [];
}

export function startsOf(scenario: Scenario): Place[] {
  const { x_um, y_um, heading_deg } = object(scenario['start']);
  const at = point([x_um ?? null, y_um ?? null]);
  if (x_um != null && at) return [{ at, heading: (Number(heading_deg ?? 0) * Math.PI) / 180 }];
  return points(object(scenario['robots'])['starts_um']).map((start) => ({ at: start }));
}

export function goalsOf(scenario: Scenario): Place[] {
  const tolerance = Number(scenario['goal_tolerance_um'] ?? 0);
  const goal = point(scenario['goal_um']);
  if (goal) return [{ at: goal, tolerance }];
  return points(object(scenario['robots'])['goals_um']).map((at) => ({ at, tolerance }));
}

export function swarmType(scenario: Scenario): string {
  return String(object(scenario['swarm'])['type'] ?? '');
}
