// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { differing, without } = await source('preset');

const schema = {
  properties: {
    type: { const: 'radar' },
    speed: { type: 'number', default: 80 },
    gap: { type: 'number', default: 5 },
    filter: { properties: { active: { type: 'boolean', default: true }, horizon: { type: 'number', default: 5 } } },
  },
};

test('a preset keeps what a person gave, which is what differs from the defaults', () => {
  const value = { type: 'radar', speed: 36, gap: 5, filter: { active: true, horizon: 9 } };
  assert.deepEqual(differing(schema, value), { speed: 36, filter: { horizon: 9 } });
  assert.deepEqual(differing(schema, { type: 'radar', speed: 80, filter: { active: true } }), {});
});

test('values that are refused go back to their defaults, and the preset itself stays', () => {
  const value = { as_published: true, speed: 36, filter: { horizon: 9, active: true } };
  const issues = [
    { keys: ['navigator.filter.horizon', 'navigator.as_published'], text: '' },
    { keys: ['goal_um'], text: '' },
  ];
  assert.deepEqual(without('navigator', value, issues), { as_published: true, speed: 36, filter: { active: true } });
});
