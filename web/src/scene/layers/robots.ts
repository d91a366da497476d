// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import type { Message, Point } from '../../protocol';
import { Dots } from '../dots';
import { robotAt } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import type { View } from '../view';

const dot = 3; // radius of one robot [px]
const cell = 3; // robots within one cell are one pile [px]
const crowd = 2000; // number of dots from which they have no rims
const largest = 14; // radius of a pile [px]

/** Individually tracked robots. Robots in one cell of the screen are a pile: one dot with the area of
 *  their dots. */
export class Robots extends Layer {
  readonly name = 'robots';
  readonly label = 'Robots';
  override readonly help =
    'A larger dot is a pile of robots: its area grows with their number. Walls lie above the robots.';
  override readonly occasions = { zoom: true, motion: true };
  private readonly inside = this.world.addChild(new Graphics()); // the map: piles do not leave it
  private readonly rims = this.world.addChild(new Dots()); // separate the dots from the background
  private readonly dots: Dots[] = []; // one for all, or one for each colour
  private readonly piles = new Map<number, number>(); // cell to index of its pile
  private count = 0;
  private covered = '';
  private x = new Float64Array(); // sums over a pile
  private y = new Float64Array();
  private size = new Uint32Array();

  take(message: Message): boolean {
    if (message.type === 'hello') this.count = 0;
    if (message.type === 'frame') this.count = message.robots.length / 8;
    return message.type === 'hello' || message.type === 'frame';
  }

  override entries({ robots, swarm }: Palette): Entry[] {
    const { count } = this;
    if (count === 0) return [];
    if (count <= robots.length)
      return Array.from({ length: count }, (_, i) => ({
        text: `robot ${i + 1}`,
        shape: 'disc' as const,
        colour: robots[i]!,
      }));
    return [{ text: 'robot; a larger dot is a pile of them', shape: 'disc', colour: swarm }];
  }

  override say(at: Point, { view, now: { robots } }: Drawing): Said | undefined {
    const place = view.toWorld(at);
    const found = robotAt(robots, place, view.um(9 * view.bold), view.um(cell));
    if (!found) return undefined;
    const { index, count } = found;
    const [x, y] = [robots[2 * index]!, robots[2 * index + 1]!];
    const of = robots.length / 2;
    const where = `x ${number(x, 4)}, y ${number(y, 4)} µm.`;
    if (count > 1) return { title: `${count} robots of ${of}`, lines: ['All robots get the same input.', where] };
    const name = of <= 8 ? `Robot ${index + 1} of ${of}` : `Robot ${index}, of ${of} from 0`;
    return { title: name, lines: ['All robots get the same input.', where] };
  }

  draw({ view, now: { robots }, colours }: Drawing): void {
    const count = robots.length / 2;
    this.cover(view);
    this.rims.tint = colours.paper;
    this.rims.clear();
    if (count <= colours.robots.length) {
      for (let i = 0; i < Math.max(count, this.dots.length); ++i) {
        const dots = this.group(i, colours.robots[i]!);
        dots.clear();
        if (i < count) this.add(dots, robots[2 * i]!, robots[2 * i + 1]!, 2 * dot, view);
        dots.update();
      }
      return this.rims.update();
    }
    const piles = this.pile(robots, view.um(cell));
    const dots = this.group(0, colours.swarm);
    dots.clear();
    const rims = piles <= crowd;
    for (let i = 0; i < piles; ++i) {
      const size = this.size[i]!;
      const radius = Math.min(dot * Math.sqrt(size), largest);
      this.add(dots, this.x[i]! / size, this.y[i]! / size, radius, view, rims);
    }
    dots.update();
    this.rims.update();
  }

  private cover({ lo, hi }: View): void {
    const covered = String([lo, hi]);
    if (covered === this.covered) return;
    this.covered = covered;
    this.inside
      .clear()
      .rect(...lo, hi[0] - lo[0], hi[1] - lo[1])
      .fill(0xffffff);
    this.world.mask = this.inside;
  }

  private add(to: Dots, x: number, y: number, radius: number, view: View, rim = true): void {
    to.add(x, y, view.line(radius));
    if (rim) this.rims.add(x, y, view.line(radius + 1));
  }

  private group(i: number, colour: number): Dots {
    const dots = (this.dots[i] ??= this.world.addChild(new Dots()));
    dots.tint = colour;
    return dots;
  }

  /** Sums of positions and numbers of robots for each cell of `width` µm; returns the number of piles. */
  private pile(robots: Float32Array, width: number): number {
    this.reserve(robots.length / 2);
    this.piles.clear();
    let piles = 0;
    for (let i = 0; i < robots.length; i += 2) {
      const [x, y] = [robots[i]!, robots[i + 1]!];
      const at = Math.floor(x / width) + Math.floor(y / width) * 2 ** 24;
      let k = this.piles.get(at);
      if (k === undefined) {
        this.piles.set(at, (k = piles++));
        this.x[k] = this.y[k] = this.size[k] = 0;
      }
      this.x[k]! += x;
      this.y[k]! += y;
      ++this.size[k]!;
    }
    return piles;
  }

  private reserve(count: number): void {
    if (this.x.length >= count) return;
    this.x = new Float64Array(count);
    this.y = new Float64Array(count);
    this.size = new Uint32Array(count);
  }
}
