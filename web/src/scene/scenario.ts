// SPDX-License-Identifier: Apache-2.0
// What the scene needs of a scenario.
import type { Json, Point, Scenario } from '../protocol';

/** Where a swarm or robot starts, or is to arrive. */
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

/** The goals after changes such as "goal_um=[1, 2]". */
export function goalsOf(scenario: Scenario, changes: string[]): Place[] {
  const changed = { ...scenario };
  for (const change of changes) {
    const [, key, value] = /^(goal_um|goal_tolerance_um)=(.*)$/.exec(change) ?? [];
    if (key) changed[key] = numbersIn(value!);
  }
  const tolerance = Number(changed['goal_tolerance_um'] ?? 0);
  const goal = point(changed['goal_um']);
  if (goal) return [{ at: goal, tolerance }];
  return points(object(scenario['robots'])['goals_um']).map((at) => ({ at, tolerance }));
}

function numbersIn(text: string): Json {
  const numbers = (text.match(/[-+\d.eE]+/g) ?? []).map(Number);
  return text.trim().startsWith('[') ? numbers : (numbers[0] ?? null);
}

export function swarmType(scenario: Scenario): string {
  return String(object(scenario['swarm'])['type'] ?? '');
}
