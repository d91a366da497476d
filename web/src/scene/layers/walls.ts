// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import { type Bodies, type Message, type Point, floats } from '../../protocol';
import { Segments, empty, fill, ringsOf } from '../draw';
import type { Entry } from '../key';
import { type Drawing, Layer } from '../layer';

const edge = 1.25; // width of the outlines [px]

/** The free space, its border and the walls. */
export class Walls extends Layer {
  readonly name = 'walls';
  readonly label = 'Walls';
  private lo: Point = [0, 0];
  private hi: Point = [0, 0];
  override readonly isEverywhere = true;
  private bodies: Bodies | undefined;
  private edges: Segments | undefined;

  /** Walls over a picture are translucent. */
  constructor(private readonly pictures: { readonly isSet: boolean }[]) {
    super();
  }

  take(message: Message): boolean {
    if (message.type !== 'hello') return false;
    this.lo = message.map.lo;
    this.hi = message.map.hi;
    this.bodies = message.map.walls;
    return true;
  }

  draw({ view, colours }: Drawing): void {
    empty(this.world);
    this.edges = undefined;
    if (!this.bodies) return;
    const polygons = this.bodies.polygons.map(({ outer, holes }) => ({
      rings: [floats(outer), ...holes.map(floats)],
    }));
    const close = { scale: 8 * view.scale }; // still round when zoomed in
    const bodies = ringsOf(floats(this.bodies.discs), polygons, close);
    const [x0, y0] = this.lo;
    const [x1, y1] = this.hi;
    const border = new Float32Array([x0, y0, x1, y0, x1, y1, x0, y1]);
    const solid = new Graphics();
    fill(solid, bodies, colours.wall, this.pictures.some((one) => one.isSet) ? 0.35 : 1);
    const isOutside = (v: number, i: number) => (i % 2 === 0 ? v < x0 || v > x1 : v < y0 || v > y1);
    if (bodies.flat().some((one) => one.some(isOutside))) {
      const inside = this.world.addChild(new Graphics());
      inside.rect(x0, y0, x1 - x0, y1 - y0).fill(0xffffff);
      solid.mask = inside;
    }
    this.edges = Segments.rings([border, ...bodies.flat()], view.line(edge));
    this.edges.tint = colours.wallEdge;
    this.world.addChild(solid, this.edges);
  }

  override place({ view }: Drawing): void {
    this.edges?.widen(view.line(edge));
  }

  override entries({ wall }: Palette): Entry[] {
    const { discs, polygons } = this.bodies ?? { discs: [], polygons: [] };
    return discs.length + polygons.length > 0 ? [{ text: 'wall', shape: 'area', colour: wall }] : [];
  }
}
