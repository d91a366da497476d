// SPDX-License-Identifier: Apache-2.0
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import { type Message, type Point, floats } from '../../protocol';
import { Segments, empty, ring } from '../draw';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

/** The detection circles of the newest plan. */
export class Detections extends Layer {
  readonly name = 'detections';
  readonly label = 'Detection circles';
  override readonly occasions = { zoom: true };
  private circles = new Float32Array();

  take(message: Message): boolean {
    if (message.type === 'hello') this.circles = new Float32Array();
    if (message.type === 'plan') this.circles = floats(message.detections);
    return message.type === 'hello' || message.type === 'plan';
  }

  draw({ view, colours }: Drawing): void {
    empty(this.world);
    const rings: Float32Array[] = [];
    for (let i = 0; i + 2 < this.circles.length; i += 3)
      rings.push(ring(this.circles[i]!, this.circles[i + 1]!, this.circles[i + 2]!, view.scale));
    if (rings.length === 0) return;
    const lines = this.world.addChild(Segments.rings(rings, view.line(1.5)));
    lines.tint = colours.circle;
  }

  override entries({ circle }: Palette): Entry[] {
    return this.circles.length < 3
      ? []
      : [{ text: 'detection circle: plans again inside', shape: 'ring', colour: circle }];
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    const [x, y] = view.toWorld(at);
    for (let i = 0; i + 2 < this.circles.length; i += 3) {
      const radius = this.circles[i + 2]!;
      if (Math.abs(Math.hypot(x - this.circles[i]!, y - this.circles[i + 1]!) - radius) > view.um(4)) continue;
      const lines = [`Radius ${number(radius, 3)} µm. Planning starts again when an obstacle comes into it.`];
      return { title: 'Detection circle of the newest plan', lines };
    }
    return undefined;
  }
}
