// SPDX-License-Identifier: Apache-2.0
import { Graphics, Sprite, Texture } from 'pixi.js';
import { number } from '../../numbers';
import { between } from '../../palette';
import { type Clearance as Grid, type Message, type Point, type Request, floats } from '../../protocol';
import { empty, ink, label } from '../draw';
import type { Said } from '../key';
import { lengthText } from '../length';
import { type Drawing, Layer } from '../layer';

/** Distance to the nearest wall or border, as a heat map with its key. */
export class Clearance extends Layer {
  readonly name = 'clearance';
  readonly label = 'Clearance';
  override readonly isEverywhere = true;
  private grid: Grid | undefined;
  private values = new Float32Array();
  private isAsked = false;
  private readonly key = this.screen.addChild(new Graphics());
  private readonly low = this.screen.addChild(label('0'));
  private readonly high = this.screen.addChild(label(''));

  constructor() {
    super();
    this.shown = false;
    this.low.anchor.set(0, 1);
    this.high.anchor.set(1, 1);
  }

  take(message: Message): boolean {
    if (message.type === 'hello') {
      this.grid = undefined;
      this.isAsked = false;
    } else if (message.type === 'clearance') {
      this.grid = message;
      this.values = floats(message.values);
    } else return false;
    return true;
  }

  override wants(): Request | undefined {
    if (this.isAsked) return undefined;
    this.isAsked = true;
    return { do: 'clearance' };
  }

  draw({ view, colours }: Drawing): void {
    empty(this.world);
    this.screen.visible = this.grid !== undefined;
    if (!this.grid) return;
    const { values } = this;
    const most = values.reduce((a, b) => Math.max(a, b), 0);
    const sprite = new Sprite(texture(this.grid, values, most, colours.heat));
    const { lo, cell, rows } = this.grid;
    sprite.position.set(lo[0], lo[1] + rows * cell);
    sprite.scale.set(cell, -cell);
    const inside = new Graphics();
    inside.rect(...view.lo, view.hi[0] - view.lo[0], view.hi[1] - view.lo[1]).fill(0xffffff);
    sprite.mask = inside; // the outer cells reach beyond the border
    this.world.addChild(inside, sprite);
    this.high.text = lengthText(most);
    for (const text of [this.low, this.high]) ink(text, colours.ink, colours.ground);
    this.key.clear();
    for (let i = 0; i < keyWidth; i += 4) this.key.rect(i, 0, 4, 8).fill(between(colours.heat, i / keyWidth));
    this.key.rect(0, 0, keyWidth, 8).stroke({ width: 1, color: colours.wallEdge, alignment: 0 });
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    if (!this.grid || !this.shown) return undefined;
    const [x, y] = view.toWorld(at);
    const { lo, cell, columns, rows } = this.grid;
    const [column, row] = [Math.floor((x - lo[0]) / cell), Math.floor((y - lo[1]) / cell)];
    if (column < 0 || row < 0 || column >= columns || row >= rows) return undefined;
    const value = this.values[row * columns + column]!;
    return { title: 'Clearance', lines: [`${number(value, 3)} µm to the next wall.`] };
  }

  override place({ view }: Drawing): void {
    const x = view.width - keyWidth - 16;
    const y = view.height - 18;
    this.key.position.set(x, y);
    this.low.position.set(x, y - 1);
    this.high.position.set(x + keyWidth, y - 1);
  }
}

const keyWidth = 140;

/** A pixel for each cell; none in walls, where the distance is 0. */
function texture(grid: Grid, values: Float32Array, most: number, heat: number[]): Texture {
  const canvas = document.createElement('canvas');
  canvas.width = grid.columns;
  canvas.height = grid.rows;
  const context = canvas.getContext('2d')!;
  const image = context.createImageData(grid.columns, grid.rows);
  for (let row = 0; row < grid.rows; ++row)
    for (let column = 0; column < grid.columns; ++column) {
      const value = values[row * grid.columns + column]!;
      const colour = between(heat, value / (most || 1));
      const at = 4 * ((grid.rows - 1 - row) * grid.columns + column);
      image.data.set([colour >> 16, (colour >> 8) & 255, colour & 255, 255], at);
    }
  context.putImageData(image, 0, 0);
  return Texture.from(canvas);
}
