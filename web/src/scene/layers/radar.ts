// SPDX-License-Identifier: Apache-2.0
import { Graphics } from 'pixi.js';
import { number } from '../../numbers';
import type { Palette } from '../../palette';
import { type Message, type Point, type Radar as Scan, floats, whole } from '../../protocol';
import { arc, circle, polyline } from '../draw';
import { type Beam, beamAt, choiceText, sectorText } from '../hover';
import type { Entry, Said } from '../key';
import { type Drawing, Layer } from '../layer';

const fates = ['kept', 'obstacle', 'wall', 'turn'] as const;
const shortest = 0.12; // of a kept beam, as a share of the longest

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
  private beams: Beam[] = [];
  private isGuarded = false; // the safety filter commanded another direction

  take(message: Message): boolean {
    if (message.type === 'hello') this.scan = undefined;
    else if (message.type === 'frame') {
      this.scan = message.radar;
      this.beams = message.radar ? beamsOf(message.radar) : [];
      this.isGuarded = message.frame['state'] === 'guard';
    } else return false;
    return true;
  }

  draw({ view, colours: { radar, paper } }: Drawing): void {
    for (const graphics of this.world.children) (graphics as Graphics).clear();
    const { scan, beams } = this;
    if (!scan) return;
    this.drawSectors(scan, beams, radar, [view.line(0.75), paper]);
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
      this.arrow(scan.radius, detection + view.line(16), view.line(9), { width: view.line(width), color });
  }

  override place({ now: { swarm } }: Drawing): void {
    const [x, y] = swarm ? [swarm.x, swarm.y] : (this.scan?.centre ?? [0, 0]);
    this.world.position.set(x, y);
  }

  override entries({ radar }: Palette): Entry[] {
    if (!this.scan) return [];
    const [kept, obstacle, wall, turn] = radar.alpha;
    const area = (text: string, colour: number, alpha: number): Entry => ({ text, shape: 'area', colour, alpha });
    return [
      area('direction kept, longer for a higher score φ', radar.kept, kept),
      area('direction screened by an obstacle', radar.obstacle, obstacle),
      area('direction screened by a wall', radar.wall, wall),
      area('direction that turns too far', radar.turn, turn),
      { text: 'direction chosen', shape: 'arrow', colour: radar.chosen },
      { text: 'detection circle', shape: 'ring', colour: radar.detection },
      { text: 'safety circle', shape: 'dashed', colour: radar.safety },
      { text: 'prediction circle', shape: 'ring', colour: radar.prediction },
    ];
  }

  override say(at: Point, { view }: Drawing): Said | undefined {
    const { scan, beams } = this;
    if (!scan) return undefined;
    const [x, y] = view.toWorld(at);
    const [dx, dy] = [x - this.world.position.x, y - this.world.position.y];
    const away = Math.hypot(dx, dy);
    const heading = scan.straight ?? (scan.best === undefined ? undefined : beams[scan.best]?.heading);
    if (heading !== undefined && away > 0.6 * scan.detection && away < scan.detection + view.line(20)) {
      const off = away * Math.sin(Math.abs(Math.atan2(dy, dx) - heading));
      if (Math.cos(Math.atan2(dy, dx) - heading) > 0 && Math.abs(off) < view.line(7)) return this.why();
    }
    const rings: [string, number, string][] = [
      ['Detection circle', scan.detection, 'An obstacle within it is avoided, else the swarm goes straight.'],
      ['Safety circle', scan.safety, 'An obstacle or wall within it screens the directions that lead too near to it.'],
      ['Prediction circle', scan.prediction, 'The swarm is within it after its next step.'],
    ];
    const ring = rings.find(([, radius]) => Math.abs(away - radius) < view.um(2));
    const beam = away > scan.radius && away <= scan.detection ? beamAt(beams, dx, dy) : undefined;
    const onRing = ring ? `radius ${number(ring[1], 3)} µm. ${ring[2]}` : '';
    if (!beam) return ring && { title: ring[0], lines: [`R${onRing.slice(1)}`] };
    const { title, lines } = sectorText(beam, beam === beams[scan.best ?? -1], scan.step);
    return { title, lines: ring ? [...lines, `${ring[0]}: ${onRing}`] : lines };
  }

  /** Why the direction was chosen; the safety filter may have commanded another one. */
  private why(): Said {
    const { title, lines } = choiceText(this.beams, this.scan?.best, this.scan?.straight);
    return { title, lines: this.isGuarded ? [...lines, 'The safety filter commanded another one.'] : lines };
  }

  /** Merges neighbours of equal fate into one shape. */
  private drawSectors(
    { radius, detection }: Scan,
    beams: Beam[],
    colours: Palette['radar'],
    [line, paper]: [number, number],
  ): void {
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
      const style = { color: colours[name], alpha: colours.alpha[fate as 0] ?? 0.5 };
      this.sectors
        .poly([...shape, ...inner])
        .fill(style)
        .stroke({ width: line, color: paper, alpha: 0.8 });
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
  const screens = scan.screens ? whole(scan.screens) : undefined; // of an older program none
  const beams: Beam[] = [];
  for (let i = 0; i + 2 < numbers.length; i += 3) {
    const turn = numbers[i]! < (beams.at(-1)?.heading ?? -Infinity) ? 2 * Math.PI : 0;
    beams.push({
      heading: numbers[i]! + turn,
      fate: numbers[i + 1]!,
      score: numbers[i + 2]!,
      obstacle: screens?.[i / 3] ?? -1,
    });
  }
  return beams;
}
