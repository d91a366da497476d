// SPDX-License-Identifier: Apache-2.0
import { Mesh, MeshGeometry, Texture } from 'pixi.js';

const side = 64; // of the texture [px]
const rim = 4; // around its disc [px]

/** Any number of discs of one colour in one draw call. (Pixi's particles evaluate text as code,
 *  which the page's policy forbids.) */
export class Dots extends Mesh {
  private count = 0;
  private corners = new Float32Array();

  constructor() {
    const geometry = new MeshGeometry({
      positions: new Float32Array(8),
      uvs: new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]),
      indices: new Uint32Array([0, 1, 2, 0, 2, 3]),
    });
    geometry.batchMode = 'no-batch';
    super({ geometry, texture: disc() });
    this.corners = geometry.positions;
  }

  clear(): void {
    this.count = 0;
  }

  add(x: number, y: number, radius: number): void {
    if (8 * this.count >= this.corners.length) this.grow();
    const half = (radius * side) / (side - 2 * rim);
    const { corners } = this;
    const i = 8 * this.count++;
    corners[i] = corners[i + 6] = x - half;
    corners[i + 2] = corners[i + 4] = x + half;
    corners[i + 1] = corners[i + 3] = y - half;
    corners[i + 5] = corners[i + 7] = y + half;
  }

  /** Shows the discs added since the last clear. */
  update(): void {
    this.corners.fill(0, 8 * this.count);
    this.geometry.getBuffer('aPosition').update();
  }

  private grow(): void {
    const capacity = Math.max(64, (2 * this.corners.length) / 8);
    const corners = new Float32Array(8 * capacity);
    corners.set(this.corners);
    const uvs = new Float32Array(8 * capacity);
    const indices = new Uint32Array(6 * capacity);
    for (let k = 0; k < capacity; ++k) {
      uvs.set([0, 0, 1, 0, 1, 1, 0, 1], 8 * k);
      indices.set(
        [0, 1, 2, 0, 2, 3].map((corner) => 4 * k + corner),
        6 * k,
      );
    }
    const geometry = this.geometry as MeshGeometry;
    geometry.positions = corners;
    geometry.uvs = uvs;
    geometry.indices = indices;
    this.corners = corners;
  }
}

let shared: Texture | undefined;

/** Texture of a white disc, shared by all. */
function disc(): Texture {
  if (shared) return shared;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = side;
  const context = canvas.getContext('2d')!;
  context.fillStyle = 'white';
  context.beginPath();
  context.arc(side / 2, side / 2, side / 2 - rim, 0, 2 * Math.PI);
  context.fill();
  return (shared = Texture.from({ resource: canvas, autoGenerateMipmaps: true }));
}
