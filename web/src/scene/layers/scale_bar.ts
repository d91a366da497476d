// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { ink, label } from '../draw';
import { type Drawing, Layer } from '../layer';
import { lengthText, roundLength } from '../length';

/** A length of 1, 2 or 5 times a power of ten. */
export class ScaleBar extends Layer {
  readonly name = 'scale-bar';
  readonly label = 'Scale bar';
  override readonly occasions = { zoom: true };
  override readonly isEverywhere = true;
  private readonly bar = this.screen.addChild(new Graphics());
  private readonly text = this.screen.addChild(label(''));

  take(): boolean {
    return false;
  }

  draw({ view, colours }: Drawing): void {
    const um = roundLength(view.um(Math.min(220, 0.3 * view.width)));
    const width = um * view.scale;
    const height = 4 * view.bold;
    this.bar.clear();
    this.bar.rect(-2, -2, width + 4, height + 4).fill({ color: colours.ground, alpha: 0.8 });
    this.bar.rect(0, 0, width, height).fill(colours.ink);
    this.text.text = lengthText(um);
    ink(this.text, colours.ink, colours.ground);
    this.text.anchor.set(0, 1);
  }

  override place({ view }: Drawing): void {
    this.text.scale.set(view.bold);
    this.bar.position.set(16, view.height - 10 - 4 * view.bold);
    this.text.position.set(14, view.height - 11 - 4 * view.bold);
  }
}
