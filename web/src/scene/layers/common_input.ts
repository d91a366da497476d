// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import type { Message, Point } from '../../protocol';
import { ink, label } from '../draw';
import { degrees } from '../hover';
import { Inputs, insetAt } from '../inputs';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

const radius = 38; // [px]
const margin = 14;

/** The input that all robots get, as a large arrow, and the inputs before it, paler with time. */
export class CommonInput extends Layer {
  readonly name = 'input';
  readonly label = 'Input of all robots';
  override readonly help =
    'All robots get the same input, as in a field that is the same everywhere: its direction now, and those before it, paler with time.';
  override readonly occasions = { zoom: true };
  private readonly dial = this.screen.addChild(new Graphics());
  private readonly text = this.screen.addChild(label('input of all', { fontSize: 12 }));
  private readonly inputs = new Inputs();
  private isThere = false;
  private at: Point = [0, 0];
  private scale = 1;

  take(message: Message): boolean {
    if (message.type === 'hello') {
      this.inputs.clear();
      this.isThere = false;
    } else if (message.type === 'frame') {
      this.isThere = message.robots.length > 0;
      const { command_heading_rad: heading, command_speed_um_per_s: speed } = message.frame;
      this.inputs.take(message.number, { heading: Number(heading ?? 0), speed: Number(speed ?? 0) });
    } else return false;
    return true;
  }

  draw({ colours }: Drawing): void {
    const { now, past } = this.inputs;
    this.dial.visible = this.text.visible = this.isThere && now !== undefined;
    this.dial.clear();
    if (!this.isThere || !now) return;
    this.dial
      .circle(0, 0, radius)
      .fill({ color: colours.paper, alpha: 0.85 })
      .stroke({ width: 1.25, color: colours.faint });
    past.forEach(({ heading }, i) => {
      const alpha = (0.5 * (i + 1)) / past.length;
      const [x, y] = [Math.cos(heading), -Math.sin(heading)];
      const style = { width: 2, color: colours.faint, alpha, cap: 'round' } as const;
      this.dial
        .moveTo(0.62 * radius * x, 0.62 * radius * y)
        .lineTo(0.95 * radius * x, 0.95 * radius * y)
        .stroke(style);
    });
    if (now.speed > 0) this.arrow(now.heading, colours.input);
    else this.dial.rect(-6, -6, 12, 12).fill(colours.input);
    ink(this.text, colours.ink, colours.ground);
    this.text.anchor.set(0.5, 0);
  }

  private arrow(heading: number, color: number): void {
    const [x, y] = [Math.cos(heading), -Math.sin(heading)];
    const at = (along: number, aside: number): Point => [along * x - aside * y, along * y + aside * x];
    const tip = 0.9 * radius;
    const stroke = { width: 6, color, cap: 'butt' } as const;
    this.dial
      .moveTo(...at(-0.55 * radius, 0))
      .lineTo(...at(0.4 * radius, 0))
      .stroke(stroke);
    this.dial.poly([...at(tip, 0), ...at(0.3 * radius, 11), ...at(0.3 * radius, -11)]).fill(color);
  }

  override place({ view }: Drawing): void {
    const lo = view.toScreen([view.lo[0], view.hi[1]]);
    const hi = view.toScreen([view.hi[0], view.lo[1]]);
    const { bold } = view;
    const { at, factor } = insetAt({ width: view.width, head: view.head, map: { lo, hi } }, radius * bold, margin);
    this.at = at;
    this.scale = factor * bold;
    this.dial.scale.set(this.scale);
    this.text.scale.set(bold);
    this.text.alpha = factor < 1 ? 0 : 1; // the legend says it
    this.dial.position.set(...this.at);
    this.text.position.set(this.at[0], this.at[1] + (radius + 2) * this.scale);
  }

  override entries({ input }: Palette): Entry[] {
    return this.isThere ? [{ text: 'input, the same for all robots', shape: 'arrow', colour: input }] : [];
  }

  override say(at: Point): Said | undefined {
    const { now, past } = this.inputs;
    const isIn = Math.hypot(at[0] - this.at[0], at[1] - this.at[1]) <= radius * this.scale;
    if (!this.isThere || !now || !isIn) return undefined;
    const does = now.speed > 0 ? `${number(now.speed, 3)} µm/s to ${degrees(now.heading)}°` : 'hold';
    return {
      title: `Input of all robots: ${does}`,
      lines: [
        'Each robot moves so, unless a wall stops it.',
        `Around it: the ${past.length} inputs before, paler with time.`,
      ],
    };
  }
}
