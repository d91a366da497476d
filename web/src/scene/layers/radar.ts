// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import type { Palette } from '../../palette';
import { type Message, type Radar as Scan, floats } from '../../protocol';
import { arc, circle, polyline } from '../draw';
import { type Drawing, Layer } from '../layer';

const fates = ['kept', 'obstacle', 'wall', 'turn'] as const;
const shortest = 0.12; // of a kept beam, as a share of the longest

/** A beam of the radar; their headings ascend. */
interface Beam {
  heading: number;
  fate: number;
  score: number;
}

/** The radar's decision: directions coloured by their fate, kept ones with a length by their score φ,
 *  the chosen one, and the three circles. */
export class Radar extends Layer {
  readonly name = 'radar';
  readonly label = 'Radar';
  override readonly help =
    'Directions the radar looked into: kept ones are long where they score well, the others are screened by an obstacle or a wall or turn too far. The arrow is the one it chose; in the state guard the safety filter commanded another.';
  override readonly isSeenThrough = true;
  override readonly occasions = { zoom: true };
  private readonly sectors = this.world.addChild(new Graphics());
  private readonly circles = this.world.addChild(new Graphics());
  private readonly choice = this.world.addChild(new Graphics());
  private scan: Scan | undefined;

  take(message: Message): boolean {
    if (message.type === 'hello') this.scan = undefined;
    else if (message.type === 'frame') this.scan = message.radar;
    else return false;
    return true;
  }

  draw({ view, colours: { radar, paper } }: Drawing): void {
    for (const graphics of this.world.children) (graphics as Graphics).clear();
    const { scan } = this;
    if (!scan) return;
    const beams = beamsOf(scan);
    this.drawSectors(scan, beams, radar);
    const { detection, safety, prediction } = scan;
    circle(this.circles, view, [0, 0, detection], { color: radar.detection, width: 2.5 });
    circle(this.circles, view, [0, 0, safety], { color: radar.safety, width: 2, dash: 8 });
    circle(this.circles, view, [0, 0, prediction], { color: radar.prediction, width: 1.5 });
    const best = scan.best === undefined ? undefined : beams[scan.best]?.heading;
    const heading = scan.straight ?? best;
    if (heading === undefined) return;
    this.choice.rotation = heading;
    for (const [width, color] of [
      [6, paper],
      [3, radar.chosen],
    ] as const)
      this.arrow(scan.radius, detection + view.um(16), view.um(9), { width: view.um(width), color });
  }

  override place({ now: { swarm } }: Drawing): void {
    const [x, y] = swarm ? [swarm.x, swarm.y] : (this.scan?.centre ?? [0, 0]);
    this.world.position.set(x, y);
  }

  /** Merges neighbours of equal fate into one shape. */
  private drawSectors({ radius, detection }: Scan, beams: Beam[], colours: Palette['radar']): void {
    const half = Math.PI / Math.max(beams.length, 1);
    const kept = beams.filter(({ fate }) => fate === 0).map(({ score }) => score);
    const [low, high] = [Math.min(...kept), Math.max(...kept)];
    const length = ({ fate, score }: Beam) => {
      const share = fate !== 0 || high <= low ? 1 : (score - low) / (high - low);
      return radius + (detection - radius) * (fate === 0 ? shortest + (1 - shortest) * share : 1);
    };
    for (let first = 0; first < beams.length;) {
      const fate = beams[first]!.fate;
      let end = first;
      while (end < beams.length && beams[end]!.fate === fate) ++end;
      const run = beams.slice(first, end);
      const shape = run.flatMap((beam) => {
        return arc(0, 0, length(beam), beam.heading - half, beam.heading + half);
      });
      const inner = arc(0, 0, radius, run.at(-1)!.heading + half, run[0]!.heading - half);
      const name = fates[fate] ?? 'wall';
      const style = { color: colours[name], alpha: fate === 0 ? 0.85 : 0.5 };
      this.sectors.poly([...shape, ...inner]).fill(style);
      first = end;
    }
  }

  /** An arrow to the right; `head` is length and width of its head. */
  private arrow(from: number, to: number, head: number, style: { width: number; color: number }): void {
    const stroke = { ...style, cap: 'round', join: 'round' } as const;
    polyline(this.choice, [from, 0, to, 0]);
    this.choice.stroke(stroke);
    polyline(this.choice, [to - head, head * 0.6, to, 0, to - head, -head * 0.6]);
    this.choice.stroke(stroke);
  }
}

function beamsOf(scan: Scan): Beam[] {
  const numbers = floats(scan.beams);
  const beams: Beam[] = [];
  for (let i = 0; i + 2 < numbers.length; i += 3) {
    const turn = numbers[i]! < (beams.at(-1)?.heading ?? -Infinity) ? 2 * Math.PI : 0;
    beams.push({ heading: numbers[i]! + turn, fate: numbers[i + 1]!, score: numbers[i + 2]! });
  }
  return beams;
}
