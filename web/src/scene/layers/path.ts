// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { type Message, floats } from '../../protocol';
import { polyline } from '../draw';
import { type Drawing, Layer } from '../layer';

const mostDots = 100; // on its vertices

/** The path that the navigator follows. */
export class Path extends Layer {
  readonly name = 'path';
  readonly label = 'Planned path';
  override readonly occasions = { zoom: true };
  private readonly line = this.world.addChild(new Graphics());
  private points = new Float32Array();

  take(message: Message): boolean {
    if (message.type !== 'frame') return false;
    const points = floats(message.path);
    const isSame = points.length === this.points.length && points.every((v, i) => v === this.points[i]);
    this.points = points;
    return !isSame;
  }

  draw({ view, colours }: Drawing): void {
    this.line.clear();
    if (this.points.length < 4) return;
    for (const [width, color] of [[5, colours.paper], [2, colours.path]] as const) {
      polyline(this.line, this.points);
      const alpha = width > 2 ? 0.7 : 1;
      this.line.stroke({ width: view.um(width), color, join: 'round', cap: 'round', alpha });
    }
    if (this.points.length > 2 * mostDots) return;
    for (let i = 2; i + 3 < this.points.length; i += 2)
      this.line.regularPoly(this.points[i]!, this.points[i + 1]!, view.um(2.5), 8).fill(colours.path);
  }
}
