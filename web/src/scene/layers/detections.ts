// SPDX-License-Identifier: Apache-2.0
import { type Message, floats } from '../../protocol';
import { Segments, empty, ring } from '../draw';
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
    const lines = this.world.addChild(Segments.rings(rings));
    lines.tint = colours.circle;
    lines.alpha = 0.8;
  }
}
