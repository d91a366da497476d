// SPDX-License-Identifier: Apache-2.0
import { Sprite, Texture } from 'pixi.js';
import type { Point } from '../../protocol';
import { empty } from '../draw';
import { Layer } from '../layer';

const faded = 0.75; // of its strength, so that what lies on it stands out

/** A photograph beneath the map. */
export class Background extends Layer {
  readonly name = 'background';
  readonly label = 'Photograph';

  take(): boolean {
    return false;
  }
  draw(): void {}

  /** Shows the picture between two corners of the world; nothing for an empty address. */
  async set(url: string, lo: Point, hi: Point): Promise<void> {
    empty(this.world);
    if (!url) return;
    const image = new Image();
    image.src = url;
    await image.decode();
    const sprite = new Sprite(Texture.from({ resource: image, autoGenerateMipmaps: true }));
    sprite.position.set(lo[0], hi[1]);
    sprite.scale.set((hi[0] - lo[0]) / image.naturalWidth, -(hi[1] - lo[1]) / image.naturalHeight);
    sprite.alpha = faded;
    empty(this.world);
    this.world.addChild(sprite);
  }

  get isSet(): boolean {
    return this.shown && this.world.children.length > 0;
  }
}
