// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { statusText } = await source('status');
const run = { growing: false, mode: 'autonomous', ended: false, state: '', status: 'running', plays: false, frames: 0 };

test('a run says whether it has begun, plays, pauses or is over', () => {
  assert.equal(statusText(run, false), 'not begun');
  assert.equal(statusText({ ...run, frames: 3, plays: true, state: 'avoid_now' }, false), 'avoid now');
  assert.equal(statusText({ ...run, frames: 3, mode: 'manual' }, false), 'paused · manual · running');
  assert.equal(statusText({ ...run, frames: 3, mode: 'manual', state: 'manual', plays: true }, false), 'manual');
  assert.equal(statusText({ ...run, frames: 3, ended: true, status: 'time_limit' }, false), 'time limit');
  assert.equal(statusText({ ...run, frames: 3, status: 'solved' }, true), 'solved');
  assert.equal(statusText({ ...run, growing: true }, true), 'still being written');
});
