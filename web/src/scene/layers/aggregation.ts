// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import { type Palette, mixed } from '../../palette';
import { type Aggregation as Plan, type Message, type Point, floats, indices } from '../../protocol';
import { Pin, Segments, empty, ink, label, polyline } from '../draw';
import { segmentAt } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

const width = 1.2; // of the tree's edges [px]

/** Plan of a gathering: tree, regions by colour and branches by shade, junctions with the regions'
 *  numbers, and the routes from region to region to the goal. */
export class Aggregation extends Layer {
  readonly name = 'aggregation';
  readonly label = 'Regions';
  override readonly help =
    'Regions of the map by colour, their branches by shade, and the routes from junction to junction to the goal.';
  override readonly occasions = { zoom: true };
  private readonly edges = this.world.addChild(new Pin());
  private readonly routes = this.world.addChild(new Graphics());
  private readonly junctions = this.world.addChild(new Pin());
  private plan: Plan | undefined;
  private nodes = new Float32Array();
  private next = new Uint32Array();
  private pairs = new Uint32Array();
  private region = new Uint32Array();
  private drawn: Drawing['colours'] | undefined; // colours of the edges

  take(message: Message): boolean {
    if (message.type === 'hello') {
      this.plan = undefined;
      this.nodes = new Float32Array();
      this.pairs = new Uint32Array();
    } else if (message.type === 'aggregation') {
      this.plan = message;
      this.nodes = floats(message.nodes);
      this.next = indices(message.next);
      this.region = indices(message.region);
      this.pairs = new Uint32Array(2 * this.next.length);
      this.next.forEach((next, i) => this.pairs.set([i, next], 2 * i));
    } else return false;
    this.drawn = undefined;
    return true;
  }

  draw(drawing: Drawing): void {
    const { view, colours } = drawing;
    if (this.drawn !== colours) {
      empty(this.edges);
      empty(this.junctions);
      this.drawEdges(colours, view.line(width));
      this.drawJunctions(colours);
      this.drawn = colours;
    }
    this.routes.clear();
    for (const [px, color] of [
      [5, colours.paper],
      [2, colours.ink],
    ] as const) {
      for (const { gate } of this.plan?.regions ?? []) polyline(this.routes, this.route(gate));
      this.routes.stroke({ width: view.line(px), color, join: 'round', alpha: 0.8 });
    }
  }

  override place({ view }: Drawing): void {
    for (const one of this.edges.children) (one as Segments).widen(view.line(width));
    this.plan?.regions.forEach(({ junction }, i) => {
      (this.junctions.children[i] as Pin | undefined)?.at(view, ...junction);
    });
  }

  override entries({ regions, ink }: Palette): Entry[] {
    if (!this.plan) return [];
    return [
      { text: 'regions of the map by colour, their tree', shape: 'tree', colour: regions[0]! },
      { text: 'route from a region to the goal', shape: 'line', colour: ink },
    ];
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    const found = segmentAt(this.nodes, this.pairs, view.toWorld(at), view.um(4));
    if (!this.plan || found < 0) return undefined;
    const index = this.region[found]!;
    const of = this.plan.regions[index];
    let [size, length] = [0, 0];
    this.region.forEach((one, node) => {
      if (one !== index) return;
      const [a, b] = [2 * node, 2 * this.next[node]!];
      ++size;
      length += Math.hypot(this.nodes[a]! - this.nodes[b]!, this.nodes[a + 1]! - this.nodes[b + 1]!);
    });
    const share = number((100 * size) / Math.max(1, this.region.length), 2);
    const onwards = !of ? [] : index === 0 ? ['The goal is in it.'] : [`Its robots go on to region ${of.next}.`];
    return {
      title: `Region ${index}`,
      lines: [
        `${size} nodes, ${share} % of the tree, ${number(length, 3)} µm long${of ? `, ${of.branches} branches` : ''}.`,
        ...onwards,
      ],
    };
  }

  private drawEdges(colours: Palette, across: number): void {
    if (!this.plan) return;
    const branch = indices(this.plan.branch);
    const groups = new Map<string, number[]>();
    this.region.forEach((number, node) => {
      const key = `${number} ${branch[node]! % 3}`;
      const pairs = groups.get(key) ?? [];
      if (pairs.length === 0) groups.set(key, pairs);
      pairs.push(node, this.next[node]!);
    });
    for (const [key, pairs] of groups) {
      const [number, shade] = key.split(' ').map(Number);
      const colour = colours.regions[number! % colours.regions.length]!;
      const edges = this.edges.addChild(new Segments(this.nodes, new Uint32Array(pairs), across));
      edges.alpha = 0.65;
      edges.tint = mixed(colour, shade === 1 ? colours.ink : colours.paper, [0, 0.3, 0.4][shade!]!);
    }
  }

  private drawJunctions(colours: Drawing['colours']): void {
    this.plan?.regions.forEach((_, i) => {
      if (i === 0) return void this.junctions.addChild(new Pin()); // the goal has its own mark
      const colour = colours.regions[i % colours.regions.length]!;
      const pin = this.junctions.addChild(new Pin());
      const disc = pin.addChild(new Graphics()).circle(0, 0, 9);
      disc.fill(colours.paper).stroke({ width: 2, color: colour });
      const text = pin.addChild(label(String(i), { fontSize: 12, fontWeight: '600' }));
      ink(text, colours.ink, colours.paper);
      text.anchor.set(0.5);
    });
  }

  /** Route from a node along the next ones to the goal. */
  private route(from: number): number[] {
    const points: number[] = [];
    let node = from;
    for (let left = this.next.length; left > 0; --left) {
      points.push(this.nodes[2 * node]!, this.nodes[2 * node + 1]!);
      if (this.next[node] === node || this.next[node] === undefined) break;
      node = this.next[node]!;
    }
    return points;
  }
}
