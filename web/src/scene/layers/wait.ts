// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import type { Hierarchical, Message, Point } from '../../protocol';
import { Pin, ink, label } from '../draw';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import type { Goal } from './marks';

/** The point of its route that hierarchical D-RRT* heads for, and where it waits for an obstacle to pass. */
export class Wait extends Layer {
  readonly name = 'wait';
  readonly label = 'Route point and wait';
  override readonly help =
    'The point of the route that local targets lead to, and where the swarm waits for an obstacle to pass.';
  private readonly towards = this.world.addChild(new Mark());
  private readonly spot = this.world.addChild(new Mark());
  private decision: Hierarchical | undefined;

  constructor(private readonly goal: Goal) {
    super();
  }

  take(message: Message): boolean {
    if (message.type !== 'hello' && message.type !== 'frame') return false;
    const had = this.decision !== undefined;
    this.decision = message.type === 'frame' ? message.hierarchical : undefined;
    return had || this.decision !== undefined;
  }

  draw({ colours: { circle, path, paper } }: Drawing): void {
    const { wait, wait_since: since } = this.decision ?? {};
    this.towards.visible = this.isLed();
    if (this.towards.visible)
      this.towards.draw('route point', circle, paper, (to) => to.poly([0, -7, 7, 0, 0, 7, -7, 0]));
    this.spot.visible = wait !== undefined;
    if (this.spot.visible) {
      const text = since === undefined ? 'waits here' : `waits here since t = ${since.toFixed(1)} s`;
      this.spot.draw(text, path, paper, (to) => to.moveTo(-3, -6).lineTo(-3, 6).moveTo(3, -6).lineTo(3, 6));
    }
  }

  override place({ view }: Drawing): void {
    if (this.decision) this.towards.at(view, ...this.decision.towards);
    if (this.decision?.wait) this.spot.at(view, ...this.decision.wait);
  }

  override entries({ circle }: Palette): Entry[] {
    return this.isLed() ? [{ text: 'route point', shape: 'diamond', colour: circle }] : [];
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    const isAt = (place: Point | undefined) => {
      const [x, y] = place ? view.toScreen(place) : [Infinity, 0];
      return Math.hypot(x - at[0], y - at[1]) <= 10 * view.bold;
    };
    const { towards, wait, wait_since: since } = this.decision ?? {};
    if (isAt(wait))
      return {
        title: 'Place of waiting',
        lines: [
          `The swarm waits here for an obstacle to pass${since === undefined ? '' : `, since ${since.toFixed(1)} s`}.`,
        ],
      };
    if (!isAt(towards) || !this.isLed()) return undefined;
    return { title: 'Route point', lines: ['The local targets lead to this point of the route.'] };
  }

  private isLed(): boolean {
    const { towards } = this.decision ?? {};
    return towards !== undefined && !this.isGoal(towards);
  }

  /** At the goal its mark is sufficient. */
  private isGoal([x, y]: Point): boolean {
    return this.goal.places.some(({ at }) => Math.hypot(x - at[0], y - at[1]) < 1e-3);
  }
}

/** A labelled symbol of constant size. */
class Mark extends Pin {
  private readonly symbol = this.addChild(new Graphics());
  private readonly text = this.addChild(label(''));

  draw(text: string, color: number, paper: number, shape: (to: Graphics) => Graphics): void {
    this.symbol.clear();
    for (const [width, colour] of [
      [6, paper],
      [2.5, color],
    ] as const)
      shape(this.symbol).stroke({ width, color: colour, cap: 'round', join: 'round' });
    this.text.text = text;
    ink(this.text, color, paper);
    this.text.anchor.set(0, 0);
    this.text.position.set(9, 4);
  }
}
