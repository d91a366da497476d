// SPDX-License-Identifier: Apache-2.0
import { number } from '../numbers';
import type { Json } from '../protocol';

/** Description of a scene in a sentence. `frame` is a row of the record, `robots` their number. */
export function sceneText(name: string, frame: { [key: string]: Json }, robots: number): string {
  const value = (key: string) => (typeof frame[key] === 'number' ? number(frame[key], 4) : undefined);
  const who = robots > 0 ? `${robots} robots, their mean` : 'swarm';
  const at = value('x_um') === undefined ? 'no swarm is seen' : `${who} at x ${value('x_um')}, y ${value('y_um')} µm`;
  const goal = value('goal_distance_um');
  return [
    `Map of ${name || 'an experiment'}`,
    `${value('t_s') ?? 0} s`,
    at,
    goal === undefined ? '' : `${goal} µm from the goal`,
  ]
    .filter((one) => one !== '')
    .join(', ');
}
