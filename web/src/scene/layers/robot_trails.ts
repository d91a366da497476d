// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import type { Message } from '../../protocol';
import { polyline } from '../draw';
import type { Entry } from '../key';
import { type Drawing, Layer } from '../layer';
import { Trails } from '../trails';

/** The last places of each robot, of at most some hundred robots. */
export class RobotTrails extends Layer {
  readonly name = 'robot-trails';
  readonly label = 'Trails of robots';
  override readonly help = 'Where each robot was in the last frames, of at most 500 robots.';
  override readonly occasions = { zoom: true, motion: true };
  private readonly lines = this.world.addChild(new Graphics());
  private readonly trails = new Trails();

  take(message: Message): boolean {
    if (message.type === 'hello') this.trails.clear();
    return message.type === 'hello' || message.type === 'frame';
  }

  /** Takes the newest frame, also while the layer is hidden. */
  follow({ number, robots }: Drawing['now']): void {
    this.trails.take(number, robots);
  }

  override entries({ robots, swarm }: Palette): Entry[] {
    const { count } = this.trails;
    if (count === 0) return [];
    const colour = count > robots.length ? swarm : robots[0]!;
    return [{ text: 'where a robot just was', shape: 'line', colour, alpha: 0.5 }];
  }

  draw({ view, now: { robots }, colours }: Drawing): void {
    this.lines.clear();
    const { count } = this.trails;
    const few = count <= colours.robots.length;
    for (let i = 0; i < count; ++i) {
      polyline(
        this.lines,
        [...this.trails.of(i), robots[2 * i] ?? NaN, robots[2 * i + 1] ?? NaN].filter(Number.isFinite),
      );
      if (few) this.stroke(view.line(2), colours.robots[i]!);
    }
    if (!few) this.stroke(view.line(1.25), colours.swarm);
  }

  private stroke(width: number, color: number): void {
    this.lines.stroke({ width, color, alpha: 0.5, join: 'round', cap: 'round' });
  }
}
