// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import type { Message, Point } from '../../protocol';
import { Pin } from '../draw';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import type { Goal } from './marks';

/** The navigator's local target. */
export class Target extends Layer {
  readonly name = 'target';
  readonly label = 'Local target';
  private readonly pin = this.world.addChild(new Pin());
  private readonly cross = this.pin.addChild(new Graphics());
  private at: Point | undefined;

  constructor(private readonly goal: Goal) {
    super();
  }

  take(message: Message): boolean {
    if (message.type === 'hello') this.at = undefined;
    if (message.type !== 'frame') return false;
    this.at = message.target;
    return true;
  }

  draw({ colours }: Drawing): void {
    this.pin.visible = this.isThere();
    this.cross.clear();
    for (const [width, color] of [
      [5, colours.paper],
      [2.5, colours.circle],
    ] as const)
      this.cross.moveTo(-4, -4).lineTo(4, 4).moveTo(-4, 4).lineTo(4, -4).stroke({ width, color, cap: 'round' });
  }

  override entries({ circle }: Palette): Entry[] {
    return this.isThere() ? [{ text: 'local target, headed for now', shape: 'cross', colour: circle }] : [];
  }

  override say(at: Point, { view, now: { swarm } }: Drawing): Said | undefined {
    if (!this.at || !this.isThere()) return undefined;
    const [x, y] = view.toScreen(this.at);
    if (Math.hypot(x - at[0], y - at[1]) > 9 * view.bold) return undefined;
    const away = swarm ? [`${number(Math.hypot(this.at[0] - swarm.x, this.at[1] - swarm.y), 3)} µm away.`] : [];
    return { title: 'Local target', lines: ['The navigator heads for this point now.', ...away] };
  }

  private isThere(): boolean {
    return this.at !== undefined && !this.isGoal(this.at);
  }

  /** At the goal its mark is sufficient. */
  private isGoal([x, y]: Point): boolean {
    return this.goal.places.some(({ at }) => Math.hypot(x - at[0], y - at[1]) < 1e-3);
  }

  override place({ view }: Drawing): void {
    if (this.at) this.pin.at(view, ...this.at);
  }
}
