// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { routed } = await source('issues');
const fields = ['seed', 'start.x_um', 'swarm.radius_um', 'navigator.type', 'navigator.planner.type', 'map.discs'];
const places = (issues, asked = []) => Object.fromEntries(routed(issues, fields, asked).at);

test('each mistake is at its own field', () => {
  const issues = [
    { keys: ['start.x_um'], text: 'outside' },
    { keys: ['seed'], text: 'negative' },
    { keys: ['swarm.radius_um'], text: 'too small' },
  ];
  const asked = ['start.x_um', 'seed', 'swarm.radius_um'];
  assert.deepEqual(places(issues, asked), {
    'start.x_um': 'outside',
    seed: 'negative',
    'swarm.radius_um': 'too small',
  });
});

test('two mistakes at one field are both shown', () =>
  assert.deepEqual(
    places([
      { keys: ['seed'], text: 'A.' },
      { keys: ['seed'], text: 'B.' },
    ]),
    { seed: 'A. B.' },
  ));

test('a mistake without a field of its own is at the nearest asked one, or the type of its group', () => {
  const bad = { keys: ['map.discs.2.radius_um'], text: 'no' };
  assert.deepEqual(places([bad], ['map.discs']), { 'map.discs': 'no' });
  assert.deepEqual(places([{ keys: ['navigator.planner'], text: 'no' }]), { 'navigator.planner.type': 'no' });
});

test('a mistake without keys is at the only change, else above the form', () => {
  const loose = { keys: [], text: 'the lab is full' };
  assert.deepEqual(places([loose], ['seed']), { seed: 'the lab is full' });
  assert.deepEqual(routed([loose], fields, ['seed', 'start.x_um']).loose, [loose]);
});

test('a mistake names its field as the page does', () => {
  assert.deepEqual(places([{ keys: ['swarm.radius_um'], text: 'radius_um is -1 µm, allowed 0.001..1e5 µm' }]), {
    'swarm.radius_um': 'radius is -1 µm, allowed 0.001..1e5 µm',
  });
});
