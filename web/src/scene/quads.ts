// SPDX-License-Identifier: Apache-2.0

/** Corners of segments as rectangles: four points for each pair of point indices, `width` wide; written to `to`. */
export function corners(points: Float32Array, pairs: Uint32Array, width: number, to: Float32Array): Float32Array {
  for (let k = 0; 2 * k + 1 < pairs.length; ++k) {
    const [a, b] = [2 * pairs[2 * k]!, 2 * pairs[2 * k + 1]!];
    const [ax, ay, bx, by] = [points[a]!, points[a + 1]!, points[b]!, points[b + 1]!];
    const length = Math.hypot(bx - ax, by - ay);
    const share = length > 0 ? width / (2 * length) : 0;
    const [nx, ny] = [-(by - ay) * share, (bx - ax) * share];
    const at = 8 * k;
    to[at] = ax + nx;
    to[at + 1] = ay + ny;
    to[at + 2] = bx + nx;
    to[at + 3] = by + ny;
    to[at + 4] = bx - nx;
    to[at + 5] = by - ny;
    to[at + 6] = ax - nx;
    to[at + 7] = ay - ny;
  }
  return to;
}

/** Indices of two triangles for each of so many rectangles. */
export function triangles(count: number): Uint32Array {
  const indices = new Uint32Array(6 * count);
  for (let k = 0; k < count; ++k) indices.set([4 * k, 4 * k + 1, 4 * k + 2, 4 * k, 4 * k + 2, 4 * k + 3], 6 * k);
  return indices;
}
