// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Message } from '../../protocol';
import { type Drawing, Layer } from '../layer';

/** Area of the map, below everything. */
export class Ground extends Layer {
  readonly name = 'ground';
  readonly label = 'Ground';
  private readonly area = this.world.addChild(new Graphics());

  take(message: Message): boolean {
    return message.type === 'hello';
  }
  draw({ view, colours }: Drawing): void {
    const { lo, hi } = view;
    this.area
      .clear()
      .rect(lo[0], lo[1], hi[0] - lo[0], hi[1] - lo[1])
      .fill(colours.paper);
  }
}
