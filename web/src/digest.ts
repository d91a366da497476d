// SPDX-License-Identifier: Apache-2.0

const first = 16; // rows in a block of the lowest level

/** Points of a line: times, and values or gaps. */
export type Line = [number[], (number | null)[]];

interface Level {
  low: number[];
  high: number[];
}

/**
 * Least and greatest values of a column that grows, over blocks of rows that double from level to level. A line of any
 * number of rows is drawn from as many blocks as it has pixels; new rows cost what they are.
 */
export class Digest {
  private readonly levels: Level[] = [];
  private taken = 0; // rows in the blocks

  constructor(private readonly values: ArrayLike<number>) {}

  /** The column as a line of about `most` points or fewer, in which every extreme value is kept. */
  line(times: ArrayLike<number>, most: number, factor = 1): Line {
    this.take();
    const rows = this.values.length;
    const line: Line = [[], []];
    const add = (row: number, value: number) => {
      line[0].push(times[row] as number);
      line[1].push(Number.isFinite(value) ? value * factor : null);
    };
    let level = -1; // single rows
    while (size(level) * most < (level < 0 ? rows : 2 * rows) && level + 1 < this.levels.length) ++level;
    let row = 0;
    for (; level >= 0; --level) {
      const { low, high } = this.levels[level] as Level;
      const length = size(level);
      for (let i = row / length; i < low.length; ++i, row += length) {
        add(row, low[i] as number);
        add(row + length / 2, high[i] as number);
      }
    }
    for (; row < rows; ++row) add(row, this.values[row] as number);
    return line;
  }

  /** Takes the rows since the last call, by whole blocks. */
  private take(): void {
    for (; this.taken + first <= this.values.length; this.taken += first) {
      let [low, high] = [NaN, NaN];
      for (let i = this.taken; i < this.taken + first; ++i) {
        const value = this.values[i] as number;
        [low, high] = [least(low, value), greatest(high, value)];
      }
      this.push(0, low, high);
    }
  }

  private push(level: number, low: number, high: number): void {
    const { low: lows, high: highs } = (this.levels[level] ??= { low: [], high: [] });
    lows.push(low);
    highs.push(high);
    const count = lows.length;
    if (count % 2 > 0) return;
    const [a, b] = [count - 2, count - 1];
    this.push(level + 1, least(lows[a] as number, lows[b] as number), greatest(highs[a] as number, highs[b] as number));
  }
}

/** Rows in a block of a level. */
function size(level: number): number {
  return level < 0 ? 1 : first * 2 ** level;
}

/** The lesser value; one that is not finite does not count. */
function least(a: number, b: number): number {
  return !Number.isFinite(b) || a < b ? a : b;
}

function greatest(a: number, b: number): number {
  return !Number.isFinite(b) || a > b ? a : b;
}
