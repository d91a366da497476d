// SPDX-License-Identifier: Apache-2.0
import { Particle, ParticleContainer, Texture } from 'pixi.js';
import type { Message } from '../../protocol';
import { type Drawing, Layer } from '../layer';

const dot = 2.5; // radius of one robot [px]
const cell = 3; // robots within one are one pile [px]
const largest = 16; // radius of a pile [px]
const side = 64; // of the dot's texture [px]

/** Individually tracked robots. Those that share a cell of the screen are a pile: one dot, whose
 *  area is that of its robots' dots. */
export class Robots extends Layer {
  readonly name = 'robots';
  readonly label = 'Robots';
  override readonly occasions = { zoom: true, motion: true };
  private readonly texture = disc();
  private readonly dots = this.world.addChild(
    new ParticleContainer({
      texture: this.texture,
      dynamicProperties: { position: true, vertex: true, color: true },
    }),
  );
  private readonly piles = new Map<number, number>(); // cell to index of its pile
  private readonly pool: Particle[] = [];
  private x = new Float64Array(); // sums over a pile
  private y = new Float64Array();
  private size = new Uint32Array();

  take(message: Message): boolean {
    return message.type === 'hello' || message.type === 'frame';
  }

  draw({ view, now: { robots }, colours }: Drawing): void {
    const count = robots.length / 2;
    const each = count > 0 && count <= colours.series.length; // then each has a colour
    const piles = each ? this.alone(robots) : this.pile(robots, view.um(cell));
    const shown = this.dots.particleChildren;
    const isOther = shown.length !== piles;
    while (this.pool.length < piles)
      this.pool.push(new Particle({ texture: this.texture, anchorX: 0.5, anchorY: 0.5 }));
    shown.length = piles;
    for (let i = 0; i < piles; ++i) {
      const particle = (shown[i] = this.pool[i]!);
      const size = this.size[i]!;
      const radius = each ? 2 * dot : Math.min(dot * Math.sqrt(size), largest);
      particle.x = this.x[i]! / size;
      particle.y = this.y[i]! / size;
      particle.scaleX = particle.scaleY = view.um((2 * (radius + 1)) / side);
      particle.tint = each ? colours.series[i]! : colours.swarm;
    }
    if (isOther) this.dots.update();
  }

  private alone(robots: Float32Array): number {
    this.reserve(robots.length / 2);
    for (let i = 0; i < robots.length / 2; ++i) {
      this.x[i] = robots[2 * i]!;
      this.y[i] = robots[2 * i + 1]!;
      this.size[i] = 1;
    }
    return robots.length / 2;
  }

  /** Sums of places and numbers of robots for each cell of `width` µm; how many piles. */
  private pile(robots: Float32Array, width: number): number {
    this.reserve(robots.length / 2);
    this.piles.clear();
    let piles = 0;
    for (let i = 0; i < robots.length; i += 2) {
      const [x, y] = [robots[i]!, robots[i + 1]!];
      const at = Math.floor(x / width) + Math.floor(y / width) * 2 ** 24;
      let k = this.piles.get(at);
      if (k === undefined) {
        this.piles.set(at, (k = piles++));
        this.x[k] = this.y[k] = this.size[k] = 0;
      }
      this.x[k]! += x;
      this.y[k]! += y;
      ++this.size[k]!;
    }
    return piles;
  }

  private reserve(count: number): void {
    if (this.x.length >= count) return;
    this.x = new Float64Array(count);
    this.y = new Float64Array(count);
    this.size = new Uint32Array(count);
  }
}

/** A white disc with a translucent rim, which parts neighbours. */
function disc(): Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = side;
  const context = canvas.getContext('2d')!;
  context.fillStyle = 'white';
  context.beginPath();
  context.arc(side / 2, side / 2, 0.4 * side, 0, 2 * Math.PI);
  context.fill();
  return Texture.from({ resource: canvas, autoGenerateMipmaps: true });
}
