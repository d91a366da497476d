// SPDX-License-Identifier: Apache-2.0
import { Graphics, type Text } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import type { Message, Point, Scenario } from '../../protocol';
import { Pin, circle, ink, label } from '../draw';
import { gathered } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';
import { type Place, goalsOf, startsOf } from '../scenario';

/** Labelled positions, of the same size at any zoom. */
abstract class Marks extends Layer {
  override readonly occasions = { zoom: true };
  places: Place[] = [];
  private readonly circles = this.world.addChild(new Graphics());
  private readonly pins: Pin[] = [];
  protected abstract readonly word: string;

  take(message: Message): boolean {
    if (message.type !== 'hello' && message.type !== 'scenario') return false;
    const before = JSON.stringify(this.places);
    this.places = this.placesIn(message.scenario);
    return JSON.stringify(this.places) !== before;
  }

  draw(drawing: Drawing): void {
    const { view, colours } = drawing;
    this.circles.clear();
    for (const pin of this.pins.splice(0)) pin.destroy({ children: true });
    this.places.forEach((place, i) => {
      const many = this.places.length > 1;
      const colour = many ? colours.robots[i % colours.robots.length]! : this.colour(drawing);
      const { at, tolerance = 0 } = place;
      if (tolerance > 0) {
        const style = { color: colour, width: 1.5, dash: 9 };
        circle(this.circles, view, [at[0], at[1], tolerance], style);
      }
      const pin = this.world.addChild(new Pin());
      const graphics = pin.addChild(new Graphics());
      this.symbol(graphics, place, colour, colours.paper);
      const text = pin.addChild(label(many ? `${this.word} ${i + 1}` : this.word));
      ink(text, colour, colours.paper);
      this.beside(text, drawing, at);
      this.pins.push(pin);
    });
  }

  override place({ view }: Drawing): void {
    this.pins.forEach((pin, i) => pin.at(view, ...this.places[i]!.at));
  }

  override say(at: Point, drawing: Drawing): Said | undefined {
    const { view } = drawing;
    const i = this.places.findIndex((one) => {
      const [x, y] = view.toScreen(one.at);
      return Math.hypot(x - at[0], y - at[1]) <= 12 * view.bold;
    });
    const place = this.places[i];
    if (!place) return undefined;
    const name = this.label + (this.places.length > 1 ? ` of robot ${i + 1}` : '');
    const lines = [`x ${number(place.at[0], 4)}, y ${number(place.at[1], 4)} µm.`, ...this.more(place, i, drawing)];
    return { title: name, lines };
  }

  /** Further lines on a place. */
  protected more(_place: Place, _index: number, _drawing: Drawing): string[] {
    return [];
  }

  protected abstract readonly placesIn: (scenario: Scenario) => Place[];
  protected abstract colour(drawing: Drawing): number;
  protected abstract symbol(to: Graphics, place: Place, colour: number, paper: number): void;

  /** To the right above the symbol, or to the left at the screen's right edge. */
  private beside(text: Text, { view }: Drawing, at: Point): void {
    const isRight = view.toScreen(at)[0] + 14 + text.width < view.width;
    text.anchor.set(isRight ? 0 : 1, 1);
    text.position.set(isRight ? 9 : -9, -5);
  }
}

/** Start and heading of the swarm or of each robot. */
export class Start extends Marks {
  readonly name = 'start';
  readonly label = 'Start';
  protected readonly word = 'start';

  override entries({ start }: Palette): Entry[] {
    return this.places.length > 0 ? [{ text: 'start', shape: 'ring', colour: start }] : [];
  }

  protected readonly placesIn = startsOf;
  protected colour({ colours }: Drawing): number {
    return colours.start;
  }
  protected symbol(to: Graphics, { heading }: Place, color: number, paper: number): void {
    to.circle(0, 0, 6).stroke({ width: 5, color: paper, alpha: 0.8 });
    to.circle(0, 0, 6).stroke({ width: 2, color });
    if (heading === undefined) return;
    const [x, y] = [Math.cos(heading), -Math.sin(heading)];
    to.moveTo(6 * x, 6 * y)
      .lineTo(15 * x, 15 * y)
      .stroke({ width: 2, color });
  }
}

/** Goal and its tolerance; one for each robot with its own goal. */
export class Goal extends Marks {
  readonly name = 'goal';
  readonly label = 'Goal';
  protected readonly word = 'goal';

  override entries({ goal }: Palette): Entry[] {
    return this.places.length > 0 ? [{ text: 'goal, reached within the dashes', shape: 'target', colour: goal }] : [];
  }

  protected override more({ at, tolerance = 0 }: Place, index: number, { now: { swarm, robots } }: Drawing): string[] {
    const reached = tolerance > 0 ? [`Reached within ${number(tolerance, 3)} µm.`] : [];
    const count = robots.length / 2;
    const away = (x: number, y: number) => `${number(Math.hypot(x - at[0], y - at[1]), 4)} µm away`;
    if (swarm) return [...reached, `The swarm is ${away(swarm.x, swarm.y)}, as the crow flies.`];
    if (count === 0) return reached;
    if (this.places.length > 1 && index < count)
      return [...reached, `Its robot is ${away(robots[2 * index]!, robots[2 * index + 1]!)}, as the crow flies.`];
    return [...reached, `${gathered(robots, at, tolerance)} of ${count} robots are there.`];
  }

  protected readonly placesIn = goalsOf;
  protected colour({ colours }: Drawing): number {
    return colours.goal;
  }
  protected symbol(to: Graphics, _place: Place, color: number, paper: number): void {
    to.circle(0, 0, 8).stroke({ width: 6, color: paper, alpha: 0.8 });
    to.circle(0, 0, 8).stroke({ width: 2.5, color });
    to.circle(0, 0, 2.5).fill(color);
  }
}
