// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { csvOf } = await source('csv');

test('a table of the plots says which speed it has, and the state in words', () => {
  const columns = new Map([
    ['t_s', [0, 0.1]],
    ['clearance_um', [Infinity, 5]],
    ['speed_um_per_s', [3, 4]],
    ['state', [1, 7]],
  ]);
  assert.equal(
    csvOf(columns, ['hold', 'follow']),
    't_s,clearance_um,commanded_speed_um_per_s,state\n0,,3,follow\n0.1,5,4,7\n',
  );
  assert.equal(csvOf(new Map(), []), '\n');
});
