// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { movedObstacle, restingDisc } = await source('obstacle_places');
const { stepOf } = await source('mover');
const { deflection } = await source('stick');

test('an obstacle of any motion is moved by the key of its position', () => {
  const motions = {
    still: ['position_um', [5, 6], [6, 4]],
    straight: ['start_um', [5, 6], [6, 4]],
    harmonic_line: ['centre_um', [5, 6], [6, 4]],
    harmonic_arc: ['pivot_um', [5, 6], [6, 4]],
    waypoints: [
      'points_um',
      [
        [5, 6],
        [0, 0.04],
      ],
      [
        [6, 4],
        [1, -2],
      ],
    ],
  };
  for (const [type, [key, before, after]] of Object.entries(motions)) {
    const scenario = { obstacles: [{}, { motion: { type, [key]: before } }] };
    const move = movedObstacle(scenario, 1, [1, -2]);
    assert.deepEqual(move, { key: `obstacles.1.motion.${key}`, value: after, place: [6, 4] });
  }
  assert.equal(movedObstacle({ obstacles: [{ motion: { type: 'track' } }] }, 0, [1, 1]), undefined);
  assert.deepEqual(restingDisc([1.234, 5], 7).motion, { type: 'still', position_um: [1.2, 5] });
});

test('a key moves by a round hundredth of the map, with Shift by a tenth', () => {
  assert.deepEqual(stepOf('ArrowLeft', false, 2000), [-20, 0]);
  assert.deepEqual(stepOf('ArrowUp', true, 2000), [0, 200]);
  assert.deepEqual(stepOf('ArrowRight', false, 123), [1, 0]);
  assert.equal(stepOf('a', false, 100), undefined);
});

test('a stick gives its direction, y up, and at most 1', () => {
  assert.deepEqual(deflection(0, 0, 40), [0, 0]);
  assert.deepEqual(deflection(20, 0, 40), [0.5, 0]);
  assert.deepEqual(deflection(0, -80, 40), [0, 1]);
  const [x, y] = deflection(300, 400, 40);
  assert.ok(Math.abs(x - 0.6) < 1e-12 && Math.abs(y + 0.8) < 1e-12);
});
