// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Point } from '../../protocol';
import { type Rings, fill, outline, ring } from '../draw';
import { type Drawing, Layer } from '../layer';

/** Preview of the dragged object at its new position. */
export class Ghost extends Layer {
  readonly name = 'ghost';
  readonly label = 'Dragged';
  override readonly occasions = { zoom: true };
  private readonly shape = this.world.addChild(new Graphics());
  private held: { kind: string; bodies: Rings[]; place?: Point } | undefined;

  take(): boolean {
    return false;
  }

  /** Bodies, or the position of a mark. */
  hold(held: { kind: string; bodies: Rings[]; place?: Point } | undefined): void {
    this.held = held;
    this.world.position.set(0);
  }

  move(dx: number, dy: number): void {
    this.world.position.set(dx, dy);
  }

  draw({ view, colours }: Drawing): void {
    this.shape.clear();
    if (!this.held) return;
    const { kind, bodies, place } = this.held;
    const color = kind === 'goal' ? colours.goal : kind === 'start' ? colours.start : colours.obstacle;
    const shapes = place ? [[ring(...place, view.um(8), view.scale)]] : bodies;
    fill(this.shape, shapes, color, 0.35);
    outline(this.shape, shapes, { color, width: view.line(2) });
  }
}
