// SPDX-License-Identifier: Apache-2.0
import type { Palette } from '../../palette';
import { type Message, type Point, floats, indices } from '../../protocol';
import { Segments, empty } from '../draw';
import { segmentAt } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

const width = 1.2; // of its edges [px]

/** The search tree of the newest plan. */
export class Tree extends Layer {
  readonly name = 'tree';
  readonly label = 'Search tree';
  private nodes = new Float32Array();
  private parents = new Uint32Array();
  private pairs = new Uint32Array();
  private edges: Segments | undefined;

  take(message: Message): boolean {
    if (message.type === 'hello') this.nodes = new Float32Array();
    if (message.type === 'plan') {
      this.nodes = floats(message.nodes);
      this.parents = indices(message.parents);
      this.pairs = new Uint32Array(2 * this.parents.length);
      this.parents.forEach((parent, i) => this.pairs.set([i, parent], 2 * i));
    }
    return message.type === 'hello' || message.type === 'plan';
  }

  draw({ view, colours }: Drawing): void {
    empty(this.world);
    this.edges = undefined;
    if (this.nodes.length < 4) return;
    this.edges = this.world.addChild(new Segments(this.nodes, this.pairs, view.line(width)));
    this.edges.tint = colours.tree;
  }

  override place({ view }: Drawing): void {
    this.edges?.widen(view.line(width));
  }

  override entries({ tree }: Palette): Entry[] {
    return this.nodes.length < 4 ? [] : [{ text: 'search tree of the newest plan', shape: 'tree', colour: tree }];
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    if (segmentAt(this.nodes, this.pairs, view.toWorld(at), view.um(3)) < 0) return undefined;
    return { title: 'Search tree of the newest plan', lines: [`${this.nodes.length / 2} nodes.`] };
  }
}
