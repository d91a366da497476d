// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import { type Message, type Point, floats } from '../../protocol';
import { polyline } from '../draw';
import { distanceTo, lengthOf } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

const mostDots = 100; // on its vertices

/** The path that the navigator follows, in a band as wide as the clearance with which it was planned. */
export class Path extends Layer {
  readonly name = 'path';
  readonly label = 'Planned path';
  override readonly help =
    'The path that the navigator follows; the band around it is the clearance with which it was planned.';
  override readonly occasions = { zoom: true };
  private readonly band = this.world.addChild(new Graphics());
  private readonly line = this.world.addChild(new Graphics());
  private points = new Float32Array();
  private clearance = 0; // 0 for none

  take(message: Message): boolean {
    if (message.type !== 'frame') return false;
    const points = floats(message.path);
    const clearance = message.hierarchical?.path_clearance ?? 0;
    const isLike = points.length === this.points.length && clearance === this.clearance;
    const isSame = isLike && points.every((v, i) => v === this.points[i]);
    this.points = points;
    this.clearance = clearance;
    return !isSame;
  }

  draw({ view, colours }: Drawing): void {
    this.line.clear();
    this.band.clear();
    if (this.points.length < 4) return;
    const round = { join: 'round', cap: 'round' } as const;
    if (this.clearance > 0) {
      polyline(this.band, this.points);
      this.band.stroke({ width: 2 * this.clearance, color: colours.path, alpha: 0.12, ...round });
    }
    for (const [width, color] of [
      [5, colours.paper],
      [2.5, colours.path],
    ] as const) {
      polyline(this.line, this.points);
      const alpha = width > 3 ? 0.7 : 1;
      this.line.stroke({ width: view.line(width), color, alpha, ...round });
    }
    if (this.points.length > 2 * mostDots) return;
    for (let i = 2; i + 3 < this.points.length; i += 2)
      this.line.regularPoly(this.points[i]!, this.points[i + 1]!, view.line(3), 8).fill(colours.path);
  }

  override entries({ path }: Palette): Entry[] {
    if (this.points.length < 4) return [];
    const band: Entry = { text: 'its clearance', shape: 'band', colour: path, alpha: 0.12 };
    return [{ text: 'planned path', shape: 'line', colour: path }, ...(this.clearance > 0 ? [band] : [])];
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    if (this.points.length < 4 || distanceTo(this.points, view.toWorld(at)) > view.um(5)) return undefined;
    const clearance = this.clearance > 0 ? [`Planned with a clearance of ${number(this.clearance, 3)} µm.`] : [];
    const lines = [`${number(lengthOf(this.points), 4)} µm from its begin to its end.`, ...clearance];
    return { title: 'Planned path', lines };
  }
}
