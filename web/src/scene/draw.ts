// SPDX-License-Identifier: Apache-2.0
// Shapes that several layers draw. Pixi chooses the number of a circle's sides by its radius in
// the container's unit, here µm, so that circles are drawn as polygons with enough sides on screen.
import { Container, type Graphics, Mesh, MeshGeometry, Text, type TextStyleOptions, Texture } from 'pixi.js';
import { corners, triangles } from './quads';
import type { View } from './view';

export const font = 'system-ui, sans-serif';

export function label(text: string, options: TextStyleOptions = {}): Text {
  return new Text({
    text,
    style: { fontFamily: font, fontSize: 13, ...options },
    resolution: Math.max(2, window.devicePixelRatio),
  });
}

/** Sets a text's colour, with an outline in the paper's colour for legibility. */
export function ink(text: Text, colour: number, paper: number): void {
  text.style.fill = colour;
  text.style.stroke = { color: paper, width: 4, join: 'round' };
}

/** A container at a world position whose content is in pixels, y down. */
export class Pin extends Container {
  at(view: View, x: number, y: number): void {
    this.position.set(x, y);
    this.scale.set(view.line(1), -view.line(1));
  }
}

/** Lines between pairs of point indices, any number of one colour in one draw call. */
export class Segments extends Mesh {
  private readonly positions: Float32Array;
  private across: number; // [µm]

  /** `width` in µm. */
  constructor(
    private readonly points: Float32Array,
    private readonly pairs: Uint32Array,
    width: number,
  ) {
    const count = Math.max(1, pairs.length / 2);
    const positions = corners(points, pairs, width, new Float32Array(8 * count));
    const geometry = new MeshGeometry({ positions, uvs: new Float32Array(8 * count), indices: triangles(count) });
    geometry.batchMode = 'no-batch';
    super({ geometry, texture: Texture.WHITE });
    this.positions = positions;
    this.across = width;
  }

  /** Sets the width [µm]. */
  widen(width: number): void {
    if (width === this.across) return;
    this.across = width;
    corners(this.points, this.pairs, width, this.positions);
    this.geometry.getBuffer('aPosition').update();
  }

  /** Closed lines. */
  static rings(rings: Float32Array[], width: number): Segments {
    const points = new Float32Array(rings.reduce((sum, ring) => sum + ring.length, 0));
    const pairs = new Uint32Array(points.length);
    let first = 0;
    for (const ring of rings) {
      points.set(ring, 2 * first);
      const count = ring.length / 2;
      for (let i = 0; i < count; ++i) pairs.set([first + i, first + ((i + 1) % count)], 2 * (first + i));
      first += count;
    }
    return new Segments(points, pairs, width);
  }

  override destroy(): void {
    const { geometry } = this;
    super.destroy();
    geometry.destroy(true);
  }
}

/** Removes and destroys a container's content. */
export function empty(container: Container): void {
  for (const child of container.removeChildren()) child.destroy({ children: true });
}

/** Vertices of a circle; `scale` [px/µm] determines their number. */
export function ring(x: number, y: number, radius: number, scale: number): Float32Array {
  const sides = Math.round(Math.min(Math.max(6 * Math.sqrt(radius * scale), 16), 180));
  const points = new Float32Array(2 * sides);
  for (let i = 0; i < sides; ++i) {
    points[2 * i] = x + radius * Math.cos((2 * Math.PI * i) / sides);
    points[2 * i + 1] = y + radius * Math.sin((2 * Math.PI * i) / sides);
  }
  return points;
}

/** A convex outline, counterclockwise, with rounded corners where it is grown by `by` µm on all sides. */
export function grown(corners: number[], by: number): Float32Array {
  const count = corners.length / 2;
  const at = (k: number): [number, number] => {
    const i = 2 * ((k + count) % count);
    return [corners[i]!, corners[i + 1]!];
  };
  const normal = (k: number) => {
    const [[ax, ay], [bx, by]] = [at(k), at(k + 1)];
    return Math.atan2(ax - bx, by - ay);
  };
  const points: number[] = [];
  for (let k = 0; k < count; ++k) {
    const [from, to] = [normal(k - 1), normal(k)];
    points.push(...arc(...at(k), by, from, to < from ? to + 2 * Math.PI : to));
  }
  return new Float32Array(points);
}

/** Draws a path through alternating x and y. */
export function polyline(to: Graphics, points: ArrayLike<number>): void {
  for (let i = 0; i + 1 < points.length; i += 2) {
    if (i === 0) to.moveTo(points[i]!, points[i + 1]!);
    else to.lineTo(points[i]!, points[i + 1]!);
  }
}

/** Points of an arc between two headings [rad]. */
export function arc(x: number, y: number, radius: number, from: number, to: number): number[] {
  const steps = Math.max(2, Math.ceil(Math.abs(to - from) / 0.06));
  const points: number[] = [];
  for (let i = 0; i <= steps; ++i) {
    const heading = from + ((to - from) * i) / steps;
    points.push(x + radius * Math.cos(heading), y + radius * Math.sin(heading));
  }
  return points;
}

/** Outline of a circle, `width` px wide, in dashes of `dash` px if given. */
export function circle(
  to: Graphics,
  view: View,
  [x, y, radius]: readonly [number, number, number],
  style: { color: number; width: number; alpha?: number; dash?: number },
): void {
  const { dash, width, ...look } = style;
  if (dash) {
    const dashes = Math.min(Math.max(8, Math.round((Math.PI * radius * view.scale) / dash)), 120);
    const step = (2 * Math.PI) / dashes;
    for (let k = 0; k < dashes; ++k) polyline(to, arc(x, y, radius, k * step, (k + 0.55) * step));
  } else {
    to.poly([...ring(x, y, radius, view.scale)]);
  }
  to.stroke({ ...look, width: view.line(width) });
}

/** Draws a body: its outline, then its holes. */
export type Rings = Float32Array[];

/** Outlines of discs (x, y, radius, number) with a radius of at least `least` µm, and of polygons. */
export function ringsOf(
  discs: Float32Array,
  polygons: { rings: Rings }[],
  view: { scale: number },
  least = 0,
): Rings[] {
  const bodies: Rings[] = [];
  for (let i = 0; i + 3 < discs.length; i += 4)
    bodies.push([ring(discs[i]!, discs[i + 1]!, Math.max(discs[i + 2]!, least), view.scale)]);
  for (const { rings } of polygons) bodies.push(rings);
  return bodies;
}

export function fill(to: Graphics, bodies: Rings[], color: number, alpha = 1): void {
  for (const [outer, ...holes] of bodies) {
    if (!outer) continue;
    to.poly([...outer]).fill({ color, alpha });
    for (const hole of holes) to.poly([...hole]);
    if (holes.length > 0) to.cut(); // once: a second cut would also cut the shape before
  }
}

export function outline(to: Graphics, bodies: Rings[], style: { color: number; width: number; alpha?: number }): void {
  for (const rings of bodies) for (const one of rings) to.poly([...one]);
  to.stroke(style);
}
