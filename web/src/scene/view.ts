// SPDX-License-Identifier: Apache-2.0
import type { Point } from '../protocol';

const margin = 16; // around the fitted map [px]
const foot = 52; // below it, for the scale bar [px]
const most = 400; // maximum zoom, relative to the fitted map
const least = 0.25;

/** Transformation from the world (µm, y up) to the screen (CSS pixels, y down). */
export class View {
  scale = 1; // [px/µm]
  width = 1; // of the screen [px]
  height = 1;
  lo: Point = [0, 0]; // of the map
  hi: Point = [1, 1];
  head = margin; // above the fitted map [px]
  bold = 1; // factor of the widths of lines and of the sizes of texts and marks
  private x = 0; // of the world's origin on the screen [px]
  private y = 0;
  private isFitted = true;

  get origin(): Point {
    return [this.x, this.y];
  }
  toScreen([x, y]: Point): Point {
    return [this.x + this.scale * x, this.y - this.scale * y];
  }
  toWorld([x, y]: Point): Point {
    return [(x - this.x) / this.scale, (this.y - y) / this.scale];
  }
  /** World length [µm] of a screen length [px]. */
  um(pixels: number): number {
    return pixels / this.scale;
  }

  /** World width [µm] of a line of so many pixels. */
  line(pixels: number): number {
    return (pixels * this.bold) / this.scale;
  }

  /** Sets the map; the view changes only for a new one. */
  showMap(lo: Point, hi: Point): void {
    if (String([lo, hi]) === String([this.lo, this.hi])) return;
    this.lo = lo;
    this.hi = hi;
    this.fit();
  }

  fit(): void {
    this.scale = this.fittedScale();
    const middle = [(this.lo[0] + this.hi[0]) / 2, (this.lo[1] + this.hi[1]) / 2];
    this.x = this.width / 2 - this.scale * middle[0]!;
    this.y = (this.height - foot + this.head) / 2 + this.scale * middle[1]!;
    this.isFitted = true;
  }

  resize(width: number, height: number): void {
    const middle = this.toWorld([this.width / 2, this.height / 2]);
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
    if (this.isFitted) this.fit();
    else this.centre(middle);
  }

  pan(dx: number, dy: number): void {
    this.x += dx;
    this.y += dy;
    this.isFitted = false;
  }

  /** Zooms about the world position under the pointer. */
  zoom(factor: number, [px, py]: Point): void {
    const fitted = this.fittedScale();
    const scale = Math.min(Math.max(this.scale * factor, least * fitted), most * fitted);
    this.x = px - ((px - this.x) * scale) / this.scale;
    this.y = py - ((py - this.y) * scale) / this.scale;
    this.scale = scale;
    this.isFitted = false;
  }

  /** Whether the whole map is fitted. */
  get isWhole(): boolean {
    return this.isFitted;
  }

  /** Zooms to at least this scale [px/µm]. */
  enlarge(scale: number): void {
    if (scale > this.scale) this.zoom(scale / this.scale, [this.width / 2, this.height / 2]);
  }

  centre([x, y]: Point): void {
    this.x = this.width / 2 - this.scale * x;
    this.y = this.height / 2 + this.scale * y;
    this.isFitted = false;
  }

  private fittedScale(): number {
    return Math.max(
      Math.min(
        (this.width - 2 * margin) / (this.hi[0] - this.lo[0]),
        (this.height - this.head - foot) / (this.hi[1] - this.lo[1]),
      ),
      1e-9,
    );
  }
}
