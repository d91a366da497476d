// SPDX-License-Identifier: Apache-2.0

/** Radius of a new disc for a map of this size [µm]: one or five times a power of ten. */
export function discRadius(width: number, height: number): number {
  const wanted = 0.05 * Math.min(width, height);
  const decade = 10 ** Math.floor(Math.log10(wanted));
  return Number((wanted >= 5 * decade ? 5 * decade : decade).toPrecision(1));
}
