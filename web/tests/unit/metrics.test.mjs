// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { metricsOf } = await source('metrics');

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
