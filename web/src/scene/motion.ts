// SPDX-License-Identifier: Apache-2.0
import { type Frame, floats } from '../protocol';

/** Disc of a swarm. */
export interface Disc {
  x: number;
  y: number;
  radius: number;
  heading: number;
}
/** A solid polygon: its outline, then its holes, with alternating x and y. */
export interface Solid {
  rings: Float32Array[];
  number: number;
}
/** Moving objects at one time. */
export interface Moment {
  t: number;
  number: number;
  swarm: Disc | undefined;
  discs: Float32Array; // x, y, radius, number each
  solids: Solid[];
  robots: Float32Array;
}

const longest = 300; // longer steps are not interpolated [ms]

export const nothing: Moment = {
  t: 0,
  number: 0,
  swarm: undefined,
  discs: new Float32Array(),
  solids: [],
  robots: new Float32Array(),
};

/** Interpolation between the last two frames, never beyond the newest. */
export class Motion {
  private from = nothing;
  private to = nothing;
  private began = 0; // arrival of the newest frame [ms]
  private lasts = 0; // duration of the interpolation [ms]

  take(frame: Frame, now: number, plays: boolean): void {
    const next = momentOf(frame);
    const passed = now - this.began;
    const isNext = next.number > this.to.number && isLike(this.to, next);
    const smooth = plays && isNext && passed < longest;
    this.from = smooth ? this.at(now) : next;
    this.lasts = smooth ? (this.lasts > 0 ? 0.7 * this.lasts + 0.3 * passed : passed) : 0;
    this.to = next;
    this.began = now;
  }

  /** Ends the interpolation: shows the newest frame itself. */
  settle(): void {
    this.from = this.to;
    this.lasts = 0;
  }

  reset(): void {
    this.from = this.to = nothing;
    this.lasts = 0;
  }

  get newest(): Moment {
    return this.to;
  }

  isMoving(now: number): boolean {
    return this.lasts > 0 && now < this.began + this.lasts;
  }

  at(now: number): Moment {
    if (!this.isMoving(now)) return this.to;
    const share = Math.max(0, (now - this.began) / this.lasts);
    return blend(this.from, this.to, share);
  }
}

function momentOf(frame: Frame): Moment {
  const { t_s, x_um, y_um, radius_um, heading_rad } = frame.frame;
  const robots = floats(frame.robots);
  const disc = {
    x: Number(x_um),
    y: Number(y_um),
    radius: Number(radius_um),
    heading: Number(heading_rad),
  };
  return {
    t: Number(t_s),
    number: frame.number,
    swarm: robots.length > 0 || x_um == null ? undefined : disc,
    discs: floats(frame.bodies.discs),
    solids: frame.bodies.polygons.map(({ outer, holes, number }) => ({
      rings: [floats(outer), ...holes.map(floats)],
      number,
    })),
    robots,
  };
}

/** Centres of the obstacles by number: of polygons the mean of the outline's corners. */
export function centresOf({ discs, solids }: Pick<Moment, 'discs' | 'solids'>): Map<number, [number, number]> {
  const centres = new Map<number, [number, number]>();
  for (let i = 0; i + 3 < discs.length; i += 4) centres.set(discs[i + 3]!, [discs[i]!, discs[i + 1]!]);
  for (const { rings, number } of solids) {
    const [ring] = rings as [Float32Array];
    let [x, y] = [0, 0];
    for (let i = 0; i < ring.length; i += 2) {
      x += ring[i]!;
      y += ring[i + 1]!;
    }
    centres.set(number, [(2 * x) / ring.length, (2 * y) / ring.length]);
  }
  return centres;
}

/** Whether both have the same objects in the same order. */
function isLike(a: Moment, b: Moment): boolean {
  return (
    a.robots.length === b.robots.length &&
    a.discs.length === b.discs.length &&
    a.solids.length === b.solids.length &&
    !a.swarm === !b.swarm
  );
}

function blend(a: Moment, b: Moment, share: number): Moment {
  return {
    t: a.t + share * (b.t - a.t),
    number: b.number,
    swarm: a.swarm && b.swarm ? blendDiscs(a.swarm, b.swarm, share) : b.swarm,
    discs: blendNumbers(a.discs, b.discs, share),
    solids: b.solids.map(({ rings, number }, i) => ({
      rings: rings.map((ring, k) => blendNumbers(a.solids[i]!.rings[k], ring, share)),
      number,
    })),
    robots: blendNumbers(a.robots, b.robots, share),
  };
}

function blendDiscs(a: Disc, b: Disc, share: number): Disc {
  const turn = Math.atan2(Math.sin(b.heading - a.heading), Math.cos(b.heading - a.heading));
  return {
    x: a.x + share * (b.x - a.x),
    y: a.y + share * (b.y - a.y),
    radius: a.radius + share * (b.radius - a.radius),
    heading: a.heading + share * turn,
  };
}

function blendNumbers(a: Float32Array | undefined, b: Float32Array, share: number): Float32Array {
  if (!a || a.length !== b.length) return b;
  const out = new Float32Array(b.length);
  for (let i = 0; i < b.length; ++i) out[i] = a[i]! + share * (b[i]! - a[i]!);
  return out;
}
