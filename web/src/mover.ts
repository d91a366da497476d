// SPDX-License-Identifier: Apache-2.0
import { discRadius } from './discs';
import { element } from './dom';
import { number } from './numbers';
import { type Move, movedObstacle, restingDisc } from './obstacle_places';
import type { Json, Point, Scenario } from './protocol';

const ways: { [key: string]: Point } = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Step of a key for a map of this size [µm]: a hundredth of it, a tenth with Shift. */
export function stepOf(key: string, isFar: boolean, size: number): Point | undefined {
  const way = ways[key];
  const step = Number((size * (isFar ? 0.1 : 0.01)).toPrecision(1));
  return way && [way[0] * step, way[1] * step];
}

/** The scenario with its map that obstacles are moved in, and the effect of a change. */
export interface MoverOwner {
  scenario(): Scenario;
  map(): { lo: Point; hi: Point };
  change(key: string, make: () => Json): Promise<unknown>;
}

/** Buttons for those without a pointer: one that moves an obstacle by the arrow keys, and one that adds a disc. */
export class Mover {
  private moves: number | undefined; // the obstacle that is moved
  private readonly said = element('output', { class: 'doc moved' });
  private last: Promise<unknown> = Promise.resolve(); // one change at a time

  /** `name` is the form's own in its page. */
  constructor(
    private readonly owner: MoverOwner,
    private readonly name: string,
  ) {}

  /** The button of an obstacle's entry in a list. It stays pressed when the list is made again. */
  moveButton(index: number): HTMLElement[] {
    const isMoved = () => this.moves === index;
    const show = () => {
      button.setAttribute('aria-pressed', String(isMoved()));
      button.textContent = isMoved() ? 'Arrows move it' : 'Move';
    };
    const button = element('button', {
      type: 'button',
      class: 'move',
      id: `${this.name}-move-${index}`,
      title: 'Move it by the arrow keys (Shift: far); Esc: done',
      onclick: () => {
        this.moves = isMoved() ? undefined : index;
        show();
        button.focus();
        this.said.value = isMoved() ? 'Arrow keys move it, with Shift farther. Esc: done.' : '';
      },
      onkeydown: (event) => this.press(event as KeyboardEvent, index, show),
      onblur: () => {
        if (button.isConnected && isMoved()) this.moves = undefined;
        show();
      },
    });
    show();
    return [button];
  }

  /** The button that adds a disc in the middle of the map, and what is said of moves. */
  addButton(): HTMLElement[] {
    const act = () => {
      const { lo, hi } = this.owner.map();
      const middle: Point = [(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2];
      const radius = discRadius(hi[0] - lo[0], hi[1] - lo[1]);
      const disc = restingDisc(middle, radius);
      void this.owner.change('obstacles', () => {
        const before = this.owner.scenario()['obstacles'];
        return [...(Array.isArray(before) ? before : []), disc];
      });
      this.said.value = `A disc of radius ${radius} µm at ${middle.map((one) => number(one)).join(', ')} µm.`;
    };
    const title = 'Add a disc in the middle of the map';
    return [element('button', { type: 'button', class: 'add', title, onclick: act }, 'Add a disc'), this.said];
  }

  private press(event: KeyboardEvent, index: number, show: () => void): void {
    if (this.moves !== index) return;
    const { lo, hi } = this.owner.map();
    const step = stepOf(event.key, event.shiftKey, Math.max(hi[0] - lo[0], hi[1] - lo[1]));
    if (!step && event.key !== 'Escape') return;
    event.preventDefault();
    event.stopPropagation(); // the page's own keys seek and steer
    if (step) this.last = this.last.then(() => this.move(index, step));
    else {
      this.moves = undefined;
      this.said.value = '';
      show();
    }
  }

  private async move(index: number, step: Point): Promise<void> {
    const move: Move | undefined = movedObstacle(this.owner.scenario(), index, step);
    if (!move) {
      this.said.value = 'Its motion comes from a file: it cannot be moved.';
      return;
    }
    await this.owner.change(move.key, () => movedObstacle(this.owner.scenario(), index, step)?.value ?? move.value);
    const now = movedObstacle(this.owner.scenario(), index, [0, 0]);
    this.said.value = now ? `Obstacle ${index} at ${now.place.map((one) => number(one)).join(', ')} µm.` : '';
  }
}
