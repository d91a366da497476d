// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { discRadius } = await source('discs');

test('a new disc is small on its map', () => {
  for (const side of [10, 100, 1000, 1300, 5000, 1e5]) {
    const radius = discRadius(side, 2 * side);
    assert.ok(radius >= 0.01 * side && radius <= 0.05 * side, `${side}: ${radius}`);
  }
  assert.equal(discRadius(2000, 1000), 50);
});
