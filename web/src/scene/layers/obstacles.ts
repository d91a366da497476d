// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import { type Palette, mixed } from '../../palette';
import type { Message, Point } from '../../protocol';
import { type Rings, fill, outline, ringsOf } from '../draw';
import { hitObstacle } from '../hit';
import { motionText } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import { type Moment, centresOf } from '../motion';
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
  private newest: Moment | undefined;
  private before: Moment | undefined;

  take(message: Message): boolean {
    return message.type === 'frame';
  }

  /** Takes the newest frame, for the velocities. */
  follow(now: Moment): void {
    if (now.t === this.newest?.t) return;
    this.before = this.newest && now.t > this.newest.t ? this.newest : undefined;
    this.newest = now;
  }

  override entries({ obstacle }: Palette): Entry[] {
    const { discs, solids } = this.newest ?? { discs: [], solids: [] };
    return discs.length + solids.length > 0 ? [{ text: 'obstacle', shape: 'disc', colour: obstacle, alpha: 0.85 }] : [];
  }

  override say(at: Point, { view, now }: Drawing): Said | undefined {
    const index = hitObstacle(now, view, at)?.index;
    if (index === undefined) return undefined;
    const i = now.discs.findIndex((number, k) => k % 4 === 3 && number === index);
    const { swarm } = now;
    const lines = motionText(this.velocity(index));
    if (i >= 0) {
      const [x, y, radius] = [now.discs[i - 3]!, now.discs[i - 2]!, now.discs[i - 1]!];
      lines.unshift(`A disc of radius ${number(radius, 3)} µm.`);
      if (swarm)
        lines.push(
          `Gap of ${number(Math.hypot(x - swarm.x, y - swarm.y) - radius - swarm.radius, 3)} µm to the swarm.`,
        );
    } else lines.unshift('A polygon.');
    return { title: `Obstacle ${index}`, lines };
  }

  /** Velocity by the last two frames [µm/s]. */
  private velocity(number: number): Point | undefined {
    if (!this.newest || !this.before) return undefined;
    const seconds = this.newest.t - this.before.t;
    const [a, b] = [centresOf(this.before).get(number), centresOf(this.newest).get(number)];
    return a && b ? [(b[0] - a[0]) / seconds, (b[1] - a[1]) / seconds] : undefined;
  }

  draw({ view, now, colours: { obstacle, wall } }: Drawing): void {
    const isLarge = ({ rings }: { rings: Rings }) => isGround(rings[0]!, view);
    const grounds = ringsOf(none, now.solids.filter(isLarge), view);
    const others = now.solids.filter((solid) => !isLarge(solid));
    const bodies = ringsOf(now.discs, others, view, view.um(minRadius));
    this.bodies.clear();
    if (grounds.length > 0) {
      fill(this.bodies, grounds, mixed(wall, obstacle, 0.22));
      outline(this.bodies, grounds, { color: obstacle, width: view.line(2) });
    }
    if (bodies.length > 0) {
      fill(this.bodies, bodies, obstacle, 0.85);
      outline(this.bodies, bodies, { color: mixed(obstacle, 0, 0.4), width: view.line(1) });
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
