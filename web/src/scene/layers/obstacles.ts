// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { mixed } from '../../palette';
import type { Message, Point } from '../../protocol';
import { type Rings, fill, outline, ringsOf } from '../draw';
import { type Drawing, Layer } from '../layer';
import type { View } from '../view';

export const minRadius = 3; // smaller ones would be invisible [px]
const largest = 0.6; // share of the map; larger bodies are moving walls

/** Current positions of all moving bodies except the swarm. */
export class Obstacles extends Layer {
  readonly name = 'obstacles';
  readonly label = 'Obstacles';
  override readonly isSeenThrough = true;
  override readonly occasions = { zoom: true, motion: true };
  private readonly bodies = this.world.addChild(new Graphics());

  take(message: Message): boolean {
    return message.type === 'frame';
  }

  draw({ view, now, colours: { obstacle, wall } }: Drawing): void {
    const isLarge = ({ rings }: { rings: Rings }) => isGround(rings[0]!, view);
    const grounds = ringsOf(none, now.solids.filter(isLarge), view);
    const others = now.solids.filter((solid) => !isLarge(solid));
    const bodies = ringsOf(now.discs, others, view, view.um(minRadius));
    this.bodies.clear();
    if (grounds.length > 0) {
      fill(this.bodies, grounds, mixed(wall, obstacle, 0.22));
      outline(this.bodies, grounds, { color: obstacle, width: view.um(2) });
    }
    if (bodies.length > 0) {
      fill(this.bodies, bodies, obstacle, 0.85);
      outline(this.bodies, bodies, { color: mixed(obstacle, 0, 0.4), width: view.um(1) });
    }
  }
}

const none = new Float32Array();

/** Whether an outline spans most of the map, as a deforming channel does: it cannot be dragged. */
export function isGround(ring: Float32Array, { lo, hi }: View): boolean {
  const [low, high]: [Point, Point] = [
    [Infinity, Infinity],
    [-Infinity, -Infinity],
  ];
  ring.forEach((value, i) => {
    const axis = (i % 2) as 0 | 1;
    low[axis] = Math.min(low[axis], value);
    high[axis] = Math.max(high[axis], value);
  });
  return high[0] - low[0] > largest * (hi[0] - lo[0]) && high[1] - low[1] > largest * (hi[1] - lo[1]);
}
