// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import { type Aggregation, type Gathering, type Message, type Point, floats, indices } from '../../protocol';
import { ink, label } from '../draw';
import { gathered } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import type { Goal } from './marks';

const margin = 16; // of the text from the corner [px]

/** Tree of a gathering: for each node its place, the next one, and its branch. */
interface Plan {
  nodes: Float32Array;
  next: Uint32Array;
  region: Uint32Array;
  branch: Uint32Array;
}

/** Who leads a gathering: the branch of the team in a band beneath the tree, the leader, and the state in words. */
export class Team extends Layer {
  readonly name = 'team';
  readonly label = 'Leader and team';
  override readonly help =
    'The robot whose path to the goal decides all inputs, the branch of its team on a yellow ground, and the state of the gathering in words.';
  override readonly occasions = { zoom: true };
  private readonly branch = this.world.addChild(new Graphics());
  private readonly ring = this.screen.addChild(new Graphics());
  private readonly word = this.screen.addChild(label('leader'));
  private readonly state = this.screen.addChild(label('', { align: 'right' }));
  private plan: Plan | undefined;
  private now: Gathering | undefined;

  constructor(private readonly goal: Goal) {
    super();
  }

  take(message: Message): boolean {
    if (message.type === 'hello') this.plan = this.now = undefined;
    else if (message.type === 'aggregation') this.plan = planOf(message);
    else if (message.type === 'frame') {
      if (!message.gathering && !this.now) return false;
      this.now = message.gathering;
    } else return false;
    return true;
  }

  draw({ view, colours }: Drawing): void {
    this.branch.clear();
    this.traceBranch();
    this.branch.stroke({ width: view.line(9), color: colours.team, cap: 'round' });
    this.ring.clear();
    for (const [width, color] of [
      [6, colours.paper],
      [2.5, colours.ink],
    ] as const)
      this.ring.circle(0, 0, 9).stroke({ width, color });
    ink(this.word, colours.ink, colours.paper);
    this.word.anchor.set(0, 1);
    ink(this.state, colours.ink, colours.ground);
    this.state.anchor.set(1, 1);
  }

  override entries({ team, ink: colour }: Palette): Entry[] {
    if (!this.now) return [];
    return [
      { text: 'branch of the team that is led', shape: 'band', colour: team },
      { text: 'robot that leads', shape: 'ring', colour },
    ];
  }

  override say([x, y]: Point, { view }: Drawing): Said | undefined {
    const { position, visible } = this.ring;
    if (!this.now || !visible || Math.hypot(position.x - x, position.y - y) > 11 * view.bold) return undefined;
    return {
      title: `Robot ${this.now.leader}, the leader`,
      lines: ['Its path to the goal decides the input of all robots.'],
    };
  }

  override place({ view, now: { robots } }: Drawing): void {
    for (const one of this.screen.children) one.scale.set(view.bold);
    const [goal] = this.goal.places;
    const count = robots.length / 2;
    const there = goal && count > 1 ? gathered(robots, goal.at, goal.tolerance ?? 0) : undefined;
    const lines = this.now ? stateText(this.now) : [];
    const text = [...(there === undefined ? [] : [`${there} of ${count} gathered`]), ...lines].join('\n');
    if (text !== this.state.text && this.goal.places.length === 1) this.state.text = text;
    const leader = this.now?.leader;
    const isSeen = leader !== undefined && 2 * leader + 1 < robots.length;
    this.ring.visible = this.word.visible = isSeen;
    if (isSeen) {
      const [x, y] = view.toScreen([robots[2 * leader]!, robots[2 * leader + 1]!]);
      this.ring.position.set(x, y);
      this.word.position.set(x + 9 * view.bold, y - 5 * view.bold);
    }
    this.state.position.set(view.width - margin, view.height - margin / 2);
  }

  /** Edges of the team's branch. */
  private traceBranch(): void {
    const { plan, now } = this;
    if (!plan || now?.region === undefined) return;
    plan.region.forEach((region, node) => {
      if (region !== now.region || plan.branch[node] !== now.branch) return;
      const next = plan.next[node]!;
      if (2 * next + 1 >= plan.nodes.length) return; // of a damaged record
      this.branch.moveTo(plan.nodes[2 * node]!, plan.nodes[2 * node + 1]!);
      this.branch.lineTo(plan.nodes[2 * next]!, plan.nodes[2 * next + 1]!);
    });
  }
}

function planOf({ nodes, next, region, branch }: Aggregation): Plan {
  return { nodes: floats(nodes), next: indices(next), region: indices(region), branch: indices(branch) };
}

/** The state in words, a line each. */
function stateText({ leader, region, branch, moves_left: moves, livelock, mean_distance: mean }: Gathering): string[] {
  const team = region === undefined ? '' : ` the team of region ${region}, branch ${branch}`;
  return [
    ...(livelock ? ['Random robots lead, to break a livelock'] : []),
    ...(leader === undefined ? [] : [`Robot ${leader} leads${team}`]),
    ...(moves === undefined ? [] : [`${moves} moves of the plan are left`]),
    `Mean distance to the goal ${mean.toPrecision(3)} µm`,
  ];
}
