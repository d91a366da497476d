// SPDX-License-Identifier: Apache-2.0
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import { type Message, type Point, floats } from '../../protocol';
import { Segments, empty, grown, ring } from '../draw';
import { distanceTo } from '../hover';
import type { Entry, Said } from '../key';
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
      const lines = this.world.addChild(Segments.rings(rings, view.line(1.25)));
      lines.tint = colours.prediction;
      lines.alpha = 0.8 * (1 - step++ / steps.size);
    }
  }

  override entries({ prediction }: Palette): Entry[] {
    const text = 'obstacle as predicted, paler with time';
    return this.bodies.length === 0 ? [] : [{ text, shape: 'ring', colour: prediction, alpha: 0.6 }];
  }

  override say(at: Point, { view, now }: Drawing): Said | undefined {
    for (let i = 0; i + columns <= this.bodies.length; i += columns) {
      const moment = this.bodies.subarray(i, i + columns);
      const outline = this.outline(moment, view.scale);
      const closed = [...outline, outline[0]!, outline[1]!];
      if (distanceTo(closed, view.toWorld(at)) > view.um(3)) continue;
      const [body, time, , , , uncertainty] = moment;
      return {
        title: `Obstacle ${body}, as predicted`,
        lines: [`In ${number(time! - now.t, 2)} s, uncertain by ${number(uncertainty!, 2)} µm.`],
      };
    }
    return undefined;
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
