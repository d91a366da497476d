// SPDX-License-Identifier: Apache-2.0
import { type Message, floats } from '../../protocol';
import { Segments, empty, grown, ring } from '../draw';
import { type Drawing, Layer } from '../layer';

const columns = 8; // body, time, x, y, radius, uncertainty, turn, growth

/** Obstacles as the navigator expects them: an outline for each step, paler with time. */
export class Predictions extends Layer {
  readonly name = 'predictions';
  readonly label = 'Predicted obstacles';
  override readonly help =
    'Where the navigator expects each obstacle over the next seconds, with its safety growth: an outline for each step, paler with time.';
  override readonly isSeenThrough = true;
  override readonly occasions = { zoom: true };
  private bodies = new Float32Array();
  private readonly corners = new Map<number, number[]>(); // of the outline of a body; none for discs

  take(message: Message): boolean {
    if (message.type !== 'hello' && message.type !== 'frame') return false;
    const predicted = message.type === 'frame' ? message.predicted : undefined;
    if (message.type === 'frame' && !predicted && this.bodies.length === 0) return false;
    this.bodies = predicted ? floats(predicted.bodies) : new Float32Array();
    this.corners.clear();
    const numbers = predicted ? floats(predicted.corners) : new Float32Array();
    for (let i = 0; i + 2 < numbers.length; i += 3) {
      const corners = this.corners.get(numbers[i]!) ?? [];
      if (corners.length === 0) this.corners.set(numbers[i]!, corners);
      corners.push(numbers[i + 1]!, numbers[i + 2]!);
    }
    return true;
  }

  draw({ view, colours }: Drawing): void {
    empty(this.world);
    const steps = new Map<number, Float32Array[]>();
    for (let i = 0; i + columns <= this.bodies.length; i += columns) {
      const time = this.bodies[i + 1]!;
      const rings = steps.get(time) ?? [];
      if (rings.length === 0) steps.set(time, rings);
      rings.push(this.outline(this.bodies.subarray(i, i + columns), view.scale));
    }
    let step = 0;
    for (const rings of steps.values()) {
      const lines = this.world.addChild(Segments.rings(rings));
      lines.tint = colours.radar.obstacle;
      lines.alpha = 0.8 * (1 - step++ / steps.size);
    }
  }

  private outline(moment: Float32Array, scale: number): Float32Array {
    const [body, , x, y, radius, , turn, growth] = moment;
    const corners = this.corners.get(body!);
    if (!corners) return ring(x!, y!, radius!, scale);
    const [cos, sin] = [Math.cos(turn!), Math.sin(turn!)];
    const placed: number[] = [];
    for (let i = 0; i + 1 < corners.length; i += 2) {
      const [dx, dy] = [corners[i]!, corners[i + 1]!];
      placed.push(x! + cos * dx - sin * dy, y! + sin * dx + cos * dy);
    }
    return grown(placed, growth!);
  }
}
