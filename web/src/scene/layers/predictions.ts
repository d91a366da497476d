// SPDX-License-Identifier: Apache-2.0
import { type Message, floats } from '../../protocol';
import { Segments, empty, ring } from '../draw';
import { type Drawing, Layer } from '../layer';

const columns = 6; // body, time, x, y, radius, uncertainty

/** Obstacles as the predictive navigator expects them: a circle for each step, paler with time. */
export class Predictions extends Layer {
  readonly name = 'predictions';
  readonly label = 'Predicted obstacles';
  override readonly isSeenThrough = true;
  override readonly occasions = { zoom: true };
  private bodies = new Float32Array();

  take(message: Message): boolean {
    if (message.type === 'hello') this.bodies = new Float32Array();
    else if (message.type === 'frame') {
      if (!message.predicted && this.bodies.length === 0) return false;
      this.bodies = message.predicted ? floats(message.predicted.bodies) : new Float32Array();
    } else return false;
    return true;
  }

  draw({ view, colours }: Drawing): void {
    empty(this.world);
    const steps = new Map<number, Float32Array[]>();
    for (let i = 0; i + columns <= this.bodies.length; i += columns) {
      const [, time, x, y, radius] = this.bodies.subarray(i, i + columns);
      const rings = steps.get(time!) ?? [];
      if (rings.length === 0) steps.set(time!, rings);
      rings.push(ring(x!, y!, radius!, view.scale));
    }
    let step = 0;
    for (const rings of steps.values()) {
      const lines = this.world.addChild(Segments.rings(rings));
      lines.tint = colours.radar.obstacle;
      lines.alpha = 0.8 * (1 - step++ / steps.size);
    }
  }
}
