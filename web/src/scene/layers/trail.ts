// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { type Message, doubles } from '../../protocol';
import { polyline } from '../draw';
import { type Drawing, Layer } from '../layer';

const gap = 0.7; // between drawn points [px]
const most = 300; // points of the part that is redrawn with each frame

/** The travelled path, up to the time shown. */
export class Trail extends Layer {
  readonly name = 'trail';
  readonly label = 'Trail';
  override readonly occasions = { zoom: true, motion: true };
  private readonly old = this.world.addChild(new Graphics());
  private readonly fresh = this.world.addChild(new Graphics());
  private way: number[] = []; // x and y of every tick
  private end = 0; // tick up to which `old` is drawn
  private look = ''; // style of `old`

  take(message: Message): boolean {
    if (message.type === 'rows') this.takeRows(message);
    else if (message.type === 'hello') this.way = [];
    else return message.type === 'frame';
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
    const look = `${view.scale} ${colours.trail}`;
    const round = { join: 'round', cap: 'round' } as const;
    const style = { width: view.um(2.5), color: colours.trail, alpha: 0.8, ...round };
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
