// SPDX-License-Identifier: Apache-2.0
import { Matrix, Sprite, Texture } from 'pixi.js';
import type { Message, Picture } from '../../protocol';
import { Layer } from '../layer';

/** The newest picture of a rig's camera at its world position. */
export class Camera extends Layer {
  readonly name = 'camera';
  readonly label = 'Camera';
  private readonly sprite = new Sprite();
  private waiting: Picture | undefined;
  private decodes = false;

  constructor(private readonly came: () => void) {
    super();
    this.sprite.visible = false;
    this.world.addChild(this.sprite);
  }

  take(message: Message): boolean {
    if (message.type === 'picture') {
      this.waiting = message;
      if (!this.decodes) void this.decode();
    }
    return false;
  }
  draw(): void {}

  get isSet(): boolean {
    return this.shown && this.sprite.visible;
  }

  /** Decodes one picture at a time, always the newest. */
  private async decode(): Promise<void> {
    this.decodes = true;
    while (this.waiting) {
      const picture = this.waiting;
      this.waiting = undefined;
      try {
        const bitmap = await createImageBitmap(new Blob([picture.jpeg.slice()], { type: 'image/jpeg' }));
        this.show(bitmap, picture.to_um);
      } catch {
        // A picture that cannot be decoded is skipped.
      }
    }
    this.decodes = false;
  }

  private show(bitmap: ImageBitmap, [a, b, c, d, e, f]: Picture['to_um']): void {
    if (this.world.destroyed) return;
    const old = this.sprite.texture;
    this.sprite.texture = Texture.from(bitmap, true);
    if (old !== Texture.EMPTY) old.destroy(true);
    // The centre of the first pixel is half a pixel from the sprite's corner.
    this.sprite.setFromMatrix(new Matrix(a, d, b, e, c - (a + b) / 2, f - (d + e) / 2));
    this.sprite.visible = true;
    this.came();
  }
}
