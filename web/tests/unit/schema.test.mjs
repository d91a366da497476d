// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { rangeOf, described } = await source('schema');

/** Every position gives a value in the range, and that value the position. */
function isConsistent(schema, most) {
  const range = rangeOf(schema, most);
  let before = -Infinity;
  for (let share = 0; share <= 1.0001; share += 0.05) {
    const value = range.toValue(Math.min(share, 1));
    assert.ok(value >= schema.minimum && value <= schema.maximum, `${value}`);
    assert.ok(value >= before, 'it grows');
    before = value;
    const back = range.toValue(range.toShare(value));
    assert.ok(Math.abs(back - value) <= 0.02 * Math.abs(value) + 1e-12, `${value}, ${back}`);
  }
  return before;
}

test('sliders are monotonous, invertible and within the range', () => {
  isConsistent({ minimum: -3, maximum: 5 });
  isConsistent({ minimum: 0, maximum: 1e5, default: 50 });
  isConsistent({ minimum: 1, maximum: 1e4, type: 'integer', default: 64 });
  isConsistent({ minimum: 1e-3, maximum: 10 });
  assert.equal(rangeOf({ minimum: 0 }), undefined);
  assert.equal(rangeOf({ minimum: 0, maximum: 1e5, default: 50 }).toValue(0), 0);
});

test('a slider ends at ten times its default, and a length at that of the map, but reaches its default', () => {
  assert.equal(isConsistent({ minimum: 0, maximum: 1e5, default: 50 }, 2000), 500);
  assert.equal(isConsistent({ minimum: 0, maximum: 1e5, default: 50 }, 200), 200);
  assert.equal(isConsistent({ minimum: 0, maximum: 1e5, default: 5000 }, 2000), 5000);
  assert.equal(isConsistent({ minimum: 0, maximum: 1e5, default: 0 }, 2000), 2000);
  assert.equal(isConsistent({ minimum: 0, maximum: 100 }, 2000), 100);
  assert.equal(isConsistent({ minimum: 0, maximum: 1, default: 0.1 }), 1, 'a range that is narrow is whole');
  const wide = { minimum: 1e-3, maximum: 1e6, default: 50 };
  assert.equal(isConsistent(wide, 3000), 500);
  assert.equal(rangeOf(wide, 3000).toValue(0), 0.5);
});

test('a unit in brackets is none of the text', () => {
  assert.deepEqual(described({ description: 'Gap to walls [µm]' }), { doc: 'Gap to walls', unit: 'µm' });
  assert.deepEqual(described({ description: 'A point [x, y]' }), { doc: 'A point [x, y]', unit: '' });
});
