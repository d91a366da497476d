// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import { type Message, type Point, doubles } from '../../protocol';
import { polyline } from '../draw';
import { distanceTo, lengthOf } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

const gap = 0.7; // between drawn points [px]
const most = 300; // points of the part that is redrawn with each frame

/** The travelled path, up to the time shown. */
export class Trail extends Layer {
  readonly name = 'trail';
  readonly label = 'Path travelled';
  override readonly occasions = { zoom: true, motion: true };
  private readonly old = this.world.addChild(new Graphics());
  private readonly fresh = this.world.addChild(new Graphics());
  private way: number[] = []; // x and y of every tick
  private end = 0; // tick up to which `old` is drawn
  private look = ''; // style of `old`
  private isThere = false;

  take(message: Message): boolean {
    if (message.type === 'rows') this.takeRows(message);
    else if (message.type === 'hello') this.way = [];
    else {
      if (message.type === 'frame' && message.number > 0)
        this.isThere ||= message.robots.length === 0 && message.frame['x_um'] != null;
      return message.type === 'frame';
    }
    if (message.type === 'hello') this.isThere = false;
    if (message.type === 'hello' || message.anew) this.look = '';
    return true;
  }

  private takeRows({ anew, columns, rows }: Message & { type: 'rows' }): void {
    if (anew) this.way = [];
    const [x, y] = [columns.indexOf('x_um'), columns.indexOf('y_um')];
    if (x < 0 || y < 0) return;
    const numbers = doubles(rows);
    for (let i = 0; i < numbers.length; i += columns.length) this.way.push(numbers[i + x]!, numbers[i + y]!);
  }

  draw({ view, now, colours }: Drawing): void {
    const last = Math.min(now.number, this.way.length / 2);
    const look = `${view.line(1)} ${colours.trail}`;
    const round = { join: 'round', cap: 'round' } as const;
    const style = { width: view.line(3.5), color: colours.trail, ...round };
    const recent = this.thinned(this.end, last, view.um(gap));
    if (!now.swarm || look !== this.look || last < this.end || recent.length > 2 * most) {
      this.look = look;
      this.old.clear();
      this.fresh.clear();
      this.end = now.swarm ? last : 0;
      if (!now.swarm) return;
      polyline(this.old, this.thinned(0, last, view.um(gap)));
      this.old.stroke(style);
      recent.length = 0;
    }
    this.fresh.clear();
    if (recent.length === 0) recent.push(...this.way.slice(Math.max(0, 2 * this.end - 2), 2 * this.end));
    polyline(this.fresh, [...recent, now.swarm!.x, now.swarm!.y]);
    this.fresh.stroke(style);
  }

  override entries({ trail }: Palette): Entry[] {
    return this.isThere ? [{ text: 'path travelled', shape: 'line', colour: trail }] : [];
  }

  override say(at: Point, { view, now }: Drawing): Said | undefined {
    if (!now.swarm) return undefined;
    const points = this.thinned(0, Math.min(now.number, this.way.length / 2), view.um(gap));
    if (points.length < 4 || distanceTo(points, view.toWorld(at)) > view.um(5)) return undefined;
    return { title: 'Path travelled', lines: [`${number(lengthOf(points), 4)} µm so far.`] };
  }

  /** Path from the tick before `first` to the one before `end`, without points close together. */
  private thinned(first: number, end: number, apart: number): number[] {
    const points: number[] = [];
    for (let i = Math.max(0, first - 1); i < end; ++i) {
      const [x, y] = [this.way[2 * i]!, this.way[2 * i + 1]!];
      const n = points.length;
      if (n > 0 && Math.hypot(x - points[n - 2]!, y - points[n - 1]!) < apart) continue;
      points.push(x, y);
    }
    return points;
  }
}
