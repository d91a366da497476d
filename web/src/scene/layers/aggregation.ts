// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { mixed } from '../../palette';
import { type Aggregation as Plan, type Message, floats, indices } from '../../protocol';
import { Pin, Segments, empty, ink, label, polyline } from '../draw';
import { type Drawing, Layer } from '../layer';

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
  private drawn: Drawing['colours'] | undefined; // colours of the edges

  take(message: Message): boolean {
    if (message.type === 'hello') this.plan = undefined;
    else if (message.type === 'aggregation') {
      this.plan = message;
      this.nodes = floats(message.nodes);
      this.next = indices(message.next);
    } else return false;
    this.drawn = undefined;
    return true;
  }

  draw(drawing: Drawing): void {
    const { view, colours } = drawing;
    if (this.drawn !== colours) {
      empty(this.edges);
      empty(this.junctions);
      this.drawEdges(colours);
      this.drawJunctions(colours);
      this.drawn = colours;
    }
    this.routes.clear();
    for (const [width, color] of [
      [5, colours.paper],
      [2, colours.ink],
    ] as const) {
      for (const { gate } of this.plan?.regions ?? []) polyline(this.routes, this.route(gate));
      this.routes.stroke({ width: view.um(width), color, join: 'round', alpha: 0.8 });
    }
  }

  override place({ view }: Drawing): void {
    this.plan?.regions.forEach(({ junction }, i) => {
      (this.junctions.children[i] as Pin | undefined)?.at(view, ...junction);
    });
  }

  private drawEdges(colours: Drawing['colours']): void {
    if (!this.plan) return;
    const region = indices(this.plan.region);
    const branch = indices(this.plan.branch);
    const groups = new Map<string, number[]>();
    region.forEach((number, node) => {
      const key = `${number} ${branch[node]! % 3}`;
      const pairs = groups.get(key) ?? [];
      if (pairs.length === 0) groups.set(key, pairs);
      pairs.push(node, this.next[node]!);
    });
    for (const [key, pairs] of groups) {
      const [number, shade] = key.split(' ').map(Number);
      const colour = colours.series[number! % colours.series.length]!;
      const edges = this.edges.addChild(new Segments(this.nodes, new Uint32Array(pairs)));
      edges.alpha = 0.75;
      edges.tint = mixed(colour, shade === 1 ? colours.ink : colours.paper, [0, 0.3, 0.4][shade!]!);
    }
  }

  private drawJunctions(colours: Drawing['colours']): void {
    this.plan?.regions.forEach((_, i) => {
      if (i === 0) return void this.junctions.addChild(new Pin()); // the goal has its own mark
      const colour = colours.series[i % colours.series.length]!;
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
