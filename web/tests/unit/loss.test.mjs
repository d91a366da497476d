// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { isAtRisk, mayBeginAnew, mayLeave } = await source('loss');
const live = (more) => ({
  session: 1,
  isTouched: true,
  hello: { live: false, playback: false },
  standing: { frames: 3 },
  ...more,
});

test('only what a record alone can repeat is at risk', () => {
  assert.equal(isAtRisk(live()), true);
  assert.equal(isAtRisk(live({ isTouched: false })), false);
  assert.equal(isAtRisk(live({ isClosed: true })), false);
  assert.equal(isAtRisk(live({ hello: { live: true, playback: false } })), false);
  assert.equal(isAtRisk(live({ hello: { live: false, playback: true } })), false);
});

test('nothing is asked where nothing is lost', async () => {
  // A question would need a document, which is not here.
  assert.equal(await mayBeginAnew(live({ standing: { frames: 0 } })), true);
  assert.equal(await mayBeginAnew(live({ isTouched: false })), true);
  assert.equal(await mayLeave([live({ isTouched: false })]), true);
  await assert.rejects(mayBeginAnew(live()));
  await assert.rejects(mayLeave([live({ isTouched: false }), live()]));
});
