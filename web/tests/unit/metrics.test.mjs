// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { headingAt, metricsOf, numbersAt } = await source('metrics');
const { History } = await source('history');

test('metrics of a group are named in words', () => {
  const list = metricsOf({ time_s: 3, obstacles: { clearance_um: 5, t_s: 1 }, avoidance: { least_gap_um: null } });
  assert.deepEqual(
    list.map(({ key, label, unit, value }) => [key, label, unit, value]),
    [
      ['time_s', 'time', 's', 3],
      ['obstacles: clearance_um', 'obstacles: least clearance', 'µm', 5],
      ['obstacles: t_s', 'obstacles: time of the least', 's', 1],
      ['avoidance: least_gap_um', 'avoidance: least gap', 'µm', undefined],
    ],
  );
});

test('numbers of a tick are those of its row', () => {
  const history = new History();
  history.take(['t_s', 'clearance_um', 'state'], new Float64Array([0, 5, 0, 0.1, 6, 1]), [], true);
  assert.equal(headingAt(history, 1, ['hold', 'direct_path']), 'At 0.1 s: direct path');
  assert.equal(numbersAt(history, 1)['clearance_um'], 6);
  assert.equal(numbersAt(history, 7)['clearance_um'], null);
});
