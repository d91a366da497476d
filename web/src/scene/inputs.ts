// SPDX-License-Identifier: Apache-2.0
import type { Point } from '../protocol';

/** A command that all robots got. */
export interface Input {
  heading: number; // [rad]
  speed: number; // [µm/s]; 0 is hold
}

const longest = 24; // commands remembered

/** The newest command and those before, without repetitions. A jump back in time clears them. */
export class Inputs {
  readonly past: Input[] = []; // the oldest first, without the newest
  now: Input | undefined;
  private frame = -1;

  clear(): void {
    this.past.length = 0;
    this.now = undefined;
    this.frame = -1;
  }

  take(frame: number, input: Input): void {
    if (frame < this.frame) this.clear();
    this.frame = frame;
    const { now } = this;
    if (now && now.heading === input.heading && now.speed === input.speed) return;
    if (now && now.speed > 0) this.past.push(now);
    if (this.past.length > longest) this.past.shift();
    this.now = input;
  }
}

/** Middle and factor of an inset of `radius` px: beside the map where there is room, else small in the upper right corner. */
export function insetAt(
  { width, head, map }: { width: number; head: number; map: { lo: Point; hi: Point } }, // all in px, y down
  radius: number,
  margin: number,
): { at: Point; factor: number } {
  const need = 2 * (radius + margin);
  const y = Math.max(head, map.lo[1]) + radius;
  if (width - map.hi[0] >= need) return { at: [map.hi[0] + margin + radius, y], factor: 1 };
  if (map.lo[0] >= need) return { at: [map.lo[0] - margin - radius, y], factor: 1 };
  const small = 0.55;
  return { at: [width - margin - small * radius, head + small * radius], factor: small };
}
