// SPDX-License-Identifier: Apache-2.0

const longest = 40; // frames
const most = 500; // robots
const widest = 3; // frames left out between two places; with more a line would cut corners

/** Places of robots in the last frames, in order. A jump back in time or of the number of robots clears them. */
export class Trails {
  /** Number of robots with a trail. */
  count = 0;
  private frame = -1;
  private readonly places: Float32Array[] = []; // of all robots, a frame each

  clear(): void {
    this.count = 0;
    this.frame = -1;
    this.places.length = 0;
  }

  take(frame: number, robots: Float32Array): void {
    const count = robots.length / 2 > most ? 0 : robots.length / 2;
    if (frame === this.frame && count === this.count) return;
    if (frame < this.frame || frame > this.frame + widest || count !== this.count) this.clear();
    this.frame = frame;
    this.count = count;
    if (count === 0) return;
    this.places.push(robots);
    if (this.places.length > longest) this.places.shift();
  }

  /** The places of a robot, x and y in turn. */
  of(robot: number): number[] {
    return this.places.flatMap((robots) => [robots[2 * robot]!, robots[2 * robot + 1]!]);
  }
}
