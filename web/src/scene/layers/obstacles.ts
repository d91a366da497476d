// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { mixed } from '../../palette';
import type { Message } from '../../protocol';
import { fill, outline, ringsOf } from '../draw';
import { type Drawing, Layer } from '../layer';

export const leastRadius = 3; // smaller ones would not be seen [px]

/** Everything that moves but the swarm, as it is at the moment. */
export class Obstacles extends Layer {
  readonly name = 'obstacles';
  readonly label = 'Obstacles';
  override readonly occasions = { zoom: true, motion: true };
  private readonly bodies = this.world.addChild(new Graphics());

  take(message: Message): boolean {
    return message.type === 'frame';
  }

  draw({ view, now, colours }: Drawing): void {
    const bodies = ringsOf(now.discs, now.solids, view, view.um(leastRadius));
    this.bodies.clear();
    if (bodies.length === 0) return;
    fill(this.bodies, bodies, colours.obstacle, 0.85);
    const edge = mixed(colours.obstacle, 0x000000, 0.4);
    outline(this.bodies, bodies, { color: edge, width: view.um(1) });
  }
}
