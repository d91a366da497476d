// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import type { Json, Message, Point } from '../../protocol';
import { Pin, arc, polyline } from '../draw';
import { swarmText } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import { swarmType } from '../scenario';

const minRadius = 5; // [px]
const quarter = Math.PI / 2;

/** The swarm's disc and heading: a ribbon lies along it, a vortex turns. */
export class Swarm extends Layer {
  readonly name = 'swarm';
  readonly label = 'Swarm';
  override readonly isSeenThrough = true;
  override readonly occasions = { zoom: true, motion: true };
  private readonly pin = this.world.addChild(new Pin());
  private readonly body = this.pin.addChild(new Graphics());
  private type = '';
  private frame: { [key: string]: Json } | undefined; // undefined of robots
  private drawn = ''; // state for which the body was drawn

  take(message: Message): boolean {
    if (message.type === 'hello') this.type = swarmType(message.scenario);
    if (message.type === 'hello') this.frame = undefined;
    if (message.type === 'frame') this.frame = message.robots.length > 0 ? undefined : message.frame;
    return message.type === 'hello' || message.type === 'frame';
  }

  draw({ view, now: { swarm }, colours }: Drawing): void {
    this.pin.visible = swarm !== undefined;
    if (!swarm) return;
    const radius = Math.max(swarm.radius * view.scale, minRadius) / view.bold; // pins are larger by this
    const drawn = `${this.type} ${radius.toFixed(1)} ${colours.swarm}`;
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    this.body.clear();
    const { swarm: color, paper } = colours;
    this.body.poly(arc(0, 0, radius, 0, 4 * quarter)).fill(color);
    this.body.poly(arc(0, 0, radius, 0, 4 * quarter)).stroke({ width: 1.5, color: paper });
    const mark = { width: Math.min(Math.max(radius / 8, 1.5), 4), color: paper, cap: 'round' } as const;
    if (this.type === 'vortex' && radius > 9)
      for (const from of [0.4, 1.4, 2.4, 3.4]) {
        polyline(this.body, arc(0, 0, 0.62 * radius, from * quarter, (from + 0.6) * quarter));
        this.body.stroke({ ...mark, alpha: 0.75 });
      }
    if (this.type === 'ribbon' && radius > 9)
      for (const y of [-0.35, 0.35]) {
        polyline(this.body, [-0.6 * radius, y * radius, 0.6 * radius, y * radius]);
        this.body.stroke({ ...mark, alpha: 0.75 });
      }
    this.body.moveTo(0, 0).lineTo(radius, 0).stroke(mark);
    const tip = radius + Math.min(Math.max(radius / 3, 6), 12);
    const wing = (tip - radius) * 0.7;
    this.body.poly([tip, 0, radius + 1, wing, radius + 1, -wing]).fill(color);
  }

  override entries({ swarm }: Palette): Entry[] {
    const text = this.type ? `swarm, a ${this.type}` : 'swarm';
    return this.frame ? [{ text, shape: 'disc', colour: swarm }] : [];
  }

  override say(at: Point, { view, now: { swarm } }: Drawing): Said | undefined {
    if (!swarm || !this.frame) return undefined;
    const [x, y] = view.toScreen([swarm.x, swarm.y]);
    const radius = Math.max(swarm.radius * view.scale, minRadius);
    return Math.hypot(x - at[0], y - at[1]) <= radius + 3 ? swarmText(this.frame, this.type) : undefined;
  }

  override place({ view, now: { swarm } }: Drawing): void {
    if (!swarm) return;
    this.pin.at(view, swarm.x, swarm.y);
    this.pin.rotation = swarm.heading;
  }
}
