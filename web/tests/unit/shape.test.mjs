// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { shapeOf } = await source('shape');
const { waitingWords } = await source('waiting_bar');

const scenario = (more) => ({
  seed: 1,
  goal_um: [1, 2],
  obstacles: [{ motion: { type: 'still', position_um: [0, 0] } }],
  navigator: { type: 'radar', k: null },
  ...more,
});
const isSame = (more) => JSON.stringify(shapeOf(scenario())) === JSON.stringify(shapeOf(scenario(more)));

test('values do not change the shape of a form; types, entries and absent values do', () => {
  assert.ok(isSame({ seed: 7, goal_um: [5, 6, 7] }));
  assert.ok(isSame({ obstacles: [{ motion: { type: 'still', position_um: [9, 9] } }] }));
  assert.ok(!isSame({ obstacles: [] }));
  assert.ok(!isSame({ obstacles: [{ motion: { type: 'straight', position_um: [0, 0] } }] }));
  assert.ok(!isSame({ navigator: { type: 'follower', k: null } }));
  assert.ok(!isSame({ navigator: { type: 'radar', k: 3 } }));
});

test('changes that wait are counted', () => {
  assert.match(waitingWords(1), /^One change takes/);
  assert.match(waitingWords(3), /^3 changes take/);
});
