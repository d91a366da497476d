// SPDX-License-Identifier: Apache-2.0

/** The largest 1, 2 or 5 times a power of ten that is at most `most`. */
export function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  for (const factor of [5, 2]) if (factor * power <= most) return factor * power;
  return power;
}

/** A length of `um` µm as text, in mm from 1 mm on. */
export function lengthText(um: number): string {
  const [value, unit] = um >= 1000 ? [um / 1000, 'mm'] : [um, 'µm'];
  return `${Number(value.toPrecision(3))} ${unit}`;
}
