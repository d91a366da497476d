// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import type { Message } from '../../protocol';
import { polyline } from '../draw';
import type { Entry } from '../key';
import { type Drawing, Layer } from '../layer';

const longest = 400; // points of a trail

/** Past positions of obstacles in the frames shown: centres of discs and of polygons. */
export class ObstacleTrails extends Layer {
  readonly name = 'obstacle-trails';
  readonly label = 'Trails of obstacles';
  override readonly occasions = { zoom: true, motion: true };
  private readonly lines = this.world.addChild(new Graphics());
  private trails: number[][] = [];
  private frame = -1;

  constructor() {
    super();
    this.shown = false;
  }

  take(message: Message): boolean {
    if (message.type === 'hello') this.trails = [];
    return message.type === 'hello' || message.type === 'frame';
  }

  /** Also collects while hidden, so that the trails are complete when shown. */
  follow({ number, discs, solids }: Drawing['now']): void {
    const count = discs.length / 4 + solids.length;
    if (number < this.frame || count !== this.trails.length) this.trails = Array.from({ length: count }, () => []);
    this.frame = number;
    for (let i = 0; i < discs.length / 4; ++i) add(this.trails[i]!, discs[4 * i]!, discs[4 * i + 1]!);
    solids.forEach(({ rings }, i) => add(this.trails[discs.length / 4 + i]!, ...middle(rings[0]!)));
  }

  override entries({ obstacle }: Palette): Entry[] {
    return this.trails.length > 0
      ? [{ text: 'trail of an obstacle', shape: 'line', colour: obstacle, alpha: 0.45 }]
      : [];
  }

  draw({ view, colours }: Drawing): void {
    this.lines.clear();
    for (const trail of this.trails) polyline(this.lines, trail);
    this.lines.stroke({ width: view.line(2), color: colours.obstacle, alpha: 0.45 });
  }
}

function add(trail: number[], x: number, y: number): void {
  if (trail.at(-2) === x && trail.at(-1) === y) return;
  trail.push(x, y);
  if (trail.length > 2 * longest) trail.splice(0, 2);
}

function middle(ring: Float32Array): [number, number] {
  let [x, y] = [0, 0];
  for (let i = 0; i < ring.length; i += 2) {
    x += ring[i]!;
    y += ring[i + 1]!;
  }
  return [(2 * x) / ring.length, (2 * y) / ring.length];
}
