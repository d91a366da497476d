// SPDX-License-Identifier: Apache-2.0

/** Nearness of a value to its limit, in words that the page shows beside the colour; empty without a limit or far from it. */
export function nearness(value: number, limit: number | null): '' | 'near its limit' | 'at its limit' {
  const share = limit === null || limit <= 0 ? 0 : Math.abs(value) / limit;
  return share >= 0.97 ? 'at its limit' : share >= 0.8 ? 'near its limit' : '';
}
