// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { sceneText } = await source('scene/words');
const { number, words } = await source('numbers');

test('a scene is said in a sentence', () => {
  const frame = { t_s: 1.5, x_um: 10.04, y_um: 20, goal_distance_um: 300 };
  assert.equal(
    sceneText('first flight', frame, 0),
    'Map of first flight, 1.5 s, swarm at x 10.04, y 20 µm, 300 µm from the goal',
  );
  assert.match(sceneText('', { ...frame, goal_distance_um: null }, 64), /^Map of an experiment.*64 robots.*µm$/);
  assert.match(sceneText('', { t_s: 0, x_um: null }, 0), /no swarm is seen/);
});

test('keys have labels and units', () => {
  assert.deepEqual(words('goal_tolerance_um'), { label: 'goal tolerance', unit: 'µm' });
  assert.deepEqual(words('wide_width_px'), { label: 'wide width', unit: 'px' });
  assert.deepEqual(words('seed'), { label: 'seed', unit: '' });
});

test('numbers are short', () => {
  assert.deepEqual(
    [number(171.88733), number(0), number(1e-7), number(NaN), number(123456789)],
    ['171.9', '0', '1e-7', '–', '1.235e8'],
  );
});
