// SPDX-License-Identifier: Apache-2.0
import { type Message, floats, indices } from '../../protocol';
import { Segments, empty } from '../draw';
import { type Drawing, Layer } from '../layer';

/** The search tree of the newest plan. */
export class Tree extends Layer {
  readonly name = 'tree';
  readonly label = 'Search tree';
  private nodes = new Float32Array();
  private parents = new Uint32Array();

  take(message: Message): boolean {
    if (message.type === 'hello') this.nodes = new Float32Array();
    if (message.type === 'plan') {
      this.nodes = floats(message.nodes);
      this.parents = indices(message.parents);
    }
    return message.type === 'hello' || message.type === 'plan';
  }

  draw({ colours }: Drawing): void {
    empty(this.world);
    if (this.nodes.length < 4) return;
    const pairs = new Uint32Array(this.nodes.length);
    for (let i = 0; i < pairs.length / 2; ++i) pairs.set([i, this.parents[i]!], 2 * i);
    const edges = this.world.addChild(new Segments(this.nodes, pairs));
    edges.tint = colours.tree;
  }
}
