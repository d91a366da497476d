// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { logged, newsOf } = await source('rig_log');
const { nearness } = await source('rig_limits');
const { linkText, median } = await source('rig_link');

const rig = (state, more = {}) => ({ type: 'rig', state, why: '', zero_confirmed: null, ...more });
const info = { coils: ['x', 'y'], max_current_a: [2, null], max_temperature_c: [80, 80] };

test('a limit that comes near is said in words', () => {
  assert.deepEqual(
    [nearness(1.5, 2), nearness(-1.7, 2), nearness(2, 2), nearness(5, null)],
    ['', 'near its limit', 'at its limit', ''],
  );
});

test('the log says what changed, once', () => {
  assert.deepEqual(newsOf(undefined, rig('dry')), ['Dry run.']);
  assert.deepEqual(newsOf(rig('dry'), rig('dry')), []);
  const ended = rig('ended', { why: 'a page stopped it', zero_confirmed: true });
  assert.deepEqual(newsOf(rig('armed'), ended), [
    'The run has ended: a page stopped it.',
    'The device confirmed that its coils are at zero.',
  ]);
  assert.deepEqual(newsOf(rig('armed'), rig('armed', { sight: 'several' })), ['The swarm: several are seen.']);
  assert.deepEqual(newsOf(rig('armed', { sight: 'none' }), rig('armed', { sight: '' })), ['The swarm: seen again.']);
  assert.deepEqual(newsOf(rig('armed', { missed_deadlines: 1 }), rig('armed', { missed_deadlines: 4 })), [
    '3 ticks missed their deadlines.',
  ]);
  assert.deepEqual(newsOf(rig('dry', { frame_gaps: 1 }), rig('dry', { frame_gaps: 9 })), [
    'Frames of the camera are lost or late.',
  ]);
  assert.deepEqual(newsOf(rig('armed', { scale: 1 }), rig('armed', { scale: 0.83 })), [
    'The limits leave 83 % of the field.',
  ]);
  const hot = { currents_a: [-1.9, 9], temperatures_c: [79, 20] };
  assert.deepEqual(newsOf(rig('armed'), rig('armed', hot), info), [
    'Temperature of x is at its limit.',
    'Current of x is near its limit.',
  ]);
  assert.deepEqual(newsOf(rig('armed', hot), rig('armed', hot), info), []);
});

test('equal lines within seconds are counted', () => {
  const at = (s) => new Date(1000 * s);
  let log = logged([], 'a', at(0), 0);
  log = logged(log, 'b', at(1), 1);
  log = logged(log, 'a', at(2), 2);
  assert.deepEqual(
    log.map(({ text, count }) => [text, count]),
    [
      ['b', 1],
      ['a', 2],
    ],
  );
  assert.equal(logged(log, 'a', at(20), 20).length, 3);
});

test('the age of the picture has the delay of the connection in it', () => {
  assert.deepEqual(linkText(20, 40, 30), { text: 'Picture 80 ms old · Link 20 ms there and back', isSlow: false });
  assert.match(linkText(600, 100, 30).text, /SLOW/);
  assert.match(linkText(20, 3000, 30).text, /^Picture 3\.0 s old.*SLOW/);
  assert.equal(linkText(20, 9000, 30, false).text, 'Link 20 ms there and back');
  assert.equal(linkText(undefined, undefined, 0).text, 'No picture yet · Link –');
  assert.deepEqual([median([9, 1, 5]), median([]), median([4, 2])], [5, undefined, 2]);
});
