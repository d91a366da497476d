// SPDX-License-Identifier: Apache-2.0
import { type Frame, type Scenario, floats } from './protocol';
import { gathered } from './scene/hover';
import { goalsOf } from './scene/scenario';

/** As metrics: how many robots are within the tolerance of their common goal, and how many there are. */
export function robotsAtGoal(
  frame: Pick<Frame, 'robots'>,
  scenario: Scenario | undefined,
): { robots_at_the_goal?: number; robots?: number } {
  const [goal, ...others] = scenario ? goalsOf(scenario) : [];
  const robots = floats(frame.robots);
  if (!goal || others.length > 0 || robots.length < 4) return {};
  return { robots_at_the_goal: gathered(robots, goal.at, goal.tolerance ?? 0), robots: robots.length / 2 };
}
