// SPDX-License-Identifier: Apache-2.0
import { Sprite, Texture } from 'pixi.js';
import type { Point } from '../../protocol';
import { empty } from '../draw';
import { Layer } from '../layer';

const faded = 0.75; // opacity, so that the layers above stand out
const largest = 4096; // maximum side of a texture [px]

/** A picture scaled to a size that every graphics card supports. */
function reduced(image: HTMLImageElement): HTMLImageElement | HTMLCanvasElement {
  const factor = largest / Math.max(image.naturalWidth, image.naturalHeight);
  if (factor >= 1) return image;
  const canvas = document.createElement('canvas');
  canvas.width = Math.max(1, Math.round(factor * image.naturalWidth));
  canvas.height = Math.max(1, Math.round(factor * image.naturalHeight));
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}

/** A photograph beneath the map. */
export class Background extends Layer {
  readonly name = 'background';
  readonly label = 'Photograph';

  take(): boolean {
    return false;
  }
  draw(): void {}

  /** Shows the picture with its lower left corner at `lo`; none for an empty address. */
  async set(url: string, lo: Point, umPerPx: number): Promise<void> {
    empty(this.world);
    if (!url) return;
    const image = new Image();
    image.src = url;
    await image.decode();
    const { naturalWidth, naturalHeight } = image;
    const resource = reduced(image);
    const sprite = new Sprite(Texture.from({ resource, autoGenerateMipmaps: true }));
    const scale = (umPerPx * naturalWidth) / resource.width;
    sprite.position.set(lo[0], lo[1] + umPerPx * naturalHeight);
    sprite.scale.set(scale, -scale);
    sprite.alpha = faded;
    empty(this.world);
    this.world.addChild(sprite);
  }

  get isThere(): boolean {
    return this.world.children.length > 0;
  }

  get isSet(): boolean {
    return this.shown && this.isThere;
  }
}
