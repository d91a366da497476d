// SPDX-License-Identifier: Apache-2.0
import { ink, label } from '../draw';
import { type Drawing, Layer } from '../layer';

/** The simulated time, for exported pictures; in the page the time bar shows it. */
export class Clock extends Layer {
  readonly name = 'clock';
  readonly label = 'Clock';
  override readonly occasions = { motion: true };
  override readonly isEverywhere = true;
  private readonly text = this.screen.addChild(label('', { fontSize: 15 }));

  constructor() {
    super();
    this.shown = false;
  }

  take(): boolean {
    return false;
  }

  draw({ now, colours }: Drawing): void {
    this.text.text = `${now.t.toFixed(1)} s`;
    ink(this.text, colours.ink, colours.ground);
    this.text.anchor.set(0.5, 1);
  }

  override place({ view }: Drawing): void {
    this.text.scale.set(view.bold);
    this.text.position.set(Math.round(view.width / 2), view.height - 8);
  }
}
