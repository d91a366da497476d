// SPDX-License-Identifier: Apache-2.0

export const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 0];

/** The speed `by` steps above `speed`; 0 is as fast as possible. */
export function fasterSpeed(speed: number, by: number): number {
  let here = speeds.indexOf(speed);
  if (here < 0) here = speeds.findIndex((one) => one === 0 || one >= speed);
  return speeds[Math.max(0, Math.min(speeds.length - 1, here + by))] as number;
}
