// SPDX-License-Identifier: Apache-2.0
import { discRadius } from './discs';
import { element } from './dom';
import type { Live } from './live';
import { numberEntry } from './number_entry';
import type { Parameters } from './parameters';
import { movedObstacle, restingDisc, rounded } from './obstacle_places';
import { type Json, type Point, said } from './protocol';
import { at, text } from './settings';
import type { Scene, Touch } from './scene/scene';

type Tool = 'obstacle' | 'wall' | 'remove';
const hints: { [tool in Tool]: string } = {
  obstacle: 'Click the position of the new obstacle. Esc: done.',
  wall: 'Click the position of the new round wall; the run restarts. Esc: done.',
  remove: 'Click an obstacle or a round wall to remove it. Esc: done.',
};
/** Effects of dragging and clicking in the scene on the session, and the tools for them. */
export class Hands {
  readonly tools: HTMLElement;
  private tool: Tool | undefined;
  private readonly radius = numberEntry({ 'aria-label': 'Radius of a new disc in µm' }, undefined, (trouble) =>
    this.say(trouble),
  );
  private readonly buttons = new Map<Tool, HTMLButtonElement>();
  private last: Promise<void> = Promise.resolve(); // touches are handled in sequence

  constructor(
    private readonly live: Live,
    private readonly scene: Scene,
    private readonly parameters: Parameters,
    private readonly say: (text: string, isTrouble?: boolean) => void,
  ) {
    scene.onTouch((touch) => (this.last = this.last.then(() => this.take(touch))));
    const button = (tool: Tool, label: string) => {
      const made = element(
        'button',
        {
          type: 'button',
          class: `tool-${tool}`,
          'aria-pressed': 'false',
          onclick: () => this.choose(this.tool === tool ? undefined : tool),
        },
        label,
      );
      this.buttons.set(tool, made);
      return made;
    };
    const radius = element('label', { class: 'unit' }, 'r ', this.radius.root, ' µm');
    live.listen((message) => {
      if (message.type !== 'hello') return;
      const { lo, hi } = message.map;
      this.radius.set(discRadius(hi[0] - lo[0], hi[1] - lo[1]));
      // Robots that are tracked one by one have no moving obstacles, and only maps of polygons have round walls.
      const hasRobots = at(message.scenario, 'robots') != null;
      const hasDiscs = this.discs() !== undefined;
      (this.buttons.get('obstacle') as HTMLElement).hidden = hasRobots;
      (this.buttons.get('wall') as HTMLElement).hidden = !hasDiscs;
      radius.hidden = (this.buttons.get('remove') as HTMLElement).hidden = hasRobots && !hasDiscs;
    });
    this.tools = element(
      'div',
      { class: 'tools', role: 'toolbar', 'aria-label': 'Scene' },
      button('obstacle', '+ Obstacle'),
      button('wall', '+ Wall'),
      radius,
      button('remove', '− Remove'),
    );
  }

  choose(tool: Tool | undefined): void {
    this.tool = tool;
    for (const [name, one] of this.buttons) one.setAttribute('aria-pressed', String(name === tool));
    this.scene.root.classList.toggle('placing', tool !== undefined);
    this.say(tool ? hints[tool] : '', false);
  }

  /** Uses the chosen tool at the middle of the view, for those without a pointer. */
  use(): void {
    const { view } = this.scene;
    const at = view.toWorld([view.width / 2, view.height / 2]);
    const { what } = this.scene.hit([view.width / 2, view.height / 2]);
    if (this.tool) this.last = this.last.then(() => this.take({ phase: 'end', what, from: at, at }));
    else this.say('Choose a tool first, such as + Obstacle.', false);
  }

  private async take(touch: Touch): Promise<void> {
    if (touch.phase !== 'end' || this.live.hello?.playback) return;
    const { kind, index } = touch.what;
    if (this.tool === 'obstacle') return this.addObstacle(touch.at);
    if (this.tool === 'wall') return this.addWall(touch.at);
    if (this.tool === 'remove') return this.remove(touch);
    if (touch.at[0] === touch.from[0] && touch.at[1] === touch.from[1]) return;
    if (kind === 'goal') return this.apply('goal_um', () => rounded(touch.at));
    if (kind === 'start') return this.moveStart(touch.at);
    if (kind === 'obstacle' && index !== undefined)
      return this.moveObstacle(index, touch.at[0] - touch.from[0], touch.at[1] - touch.from[1]);
  }

  private async moveStart(to: Point): Promise<void> {
    const [x, y] = rounded(to);
    await this.restart([`start.x_um=${x}`, `start.y_um=${y}`]);
  }

  private async moveObstacle(index: number, dx: number, dy: number): Promise<void> {
    const moved = () => movedObstacle(this.live.hello?.scenario, index, [dx, dy]);
    const move = moved();
    if (!move) return this.say('The motion of this obstacle comes from a file; it cannot be dragged.');
    await this.apply(move.key, () => moved()?.value ?? move.value);
  }

  private obstacles(): Json[] {
    const list = this.live.hello?.scenario['obstacles'];
    return Array.isArray(list) ? list : [];
  }

  private discs(): Json[] | undefined {
    if (at(this.live.hello?.scenario, 'map.type') !== 'polygons') return undefined;
    const list = at(this.live.hello?.scenario, 'map.discs');
    return Array.isArray(list) ? list : [];
  }

  private async addObstacle(position: Point): Promise<void> {
    const disc = restingDisc(position, this.radius.get() ?? 0);
    await this.apply('obstacles', () => [...this.obstacles(), disc]);
  }

  private async addWall(position: Point): Promise<void> {
    const discs = this.discs();
    if (!discs) return this.say('Round walls can only be added to a map of polygons.');
    const wall = { centre_um: rounded(position), radius_um: this.radius.get() ?? 0 };
    await this.restart([`map.discs=${text([...discs, wall])}`]);
  }

  private async remove(touch: Touch): Promise<void> {
    const { kind, index } = touch.what;
    if (kind === 'obstacle' && index !== undefined)
      return this.apply('obstacles', () => this.obstacles().filter((_, i) => i !== index));
    const left = this.discs()?.filter((one) => {
      const { centre_um: centre, radius_um: radius } = one as { centre_um: Point; radius_um: number };
      return Math.hypot(touch.at[0] - centre[0], touch.at[1] - centre[1]) > radius;
    });
    if (left && left.length < (this.discs()?.length ?? 0)) return this.restart([`map.discs=${text(left)}`]);
    this.say('Nothing to remove here.');
  }

  /** Applies a value, which is made of the scenario on which it acts. */
  private async apply(key: string, make: () => Json): Promise<void> {
    if (this.parameters.isAtOnce(key) || this.parameters.isOfPast(key))
      return this.say(said(await this.parameters.change(key, make)));
    await this.restart([`${key}=${text(make())}`]);
  }

  private async restart(settings: string[]): Promise<void> {
    const answer = await this.parameters.restart(settings);
    const trouble = said(answer);
    this.say(trouble || 'The run restarts.', trouble !== '');
  }
}
