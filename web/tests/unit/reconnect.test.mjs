// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { attemptsAfter, pauseBefore, verdictOf } = await source('reconnect');

test('attempts are soon at first, then every five seconds, without an end', () => {
  const pauses = Array.from({ length: 2000 }, (_, i) => pauseBefore(i));
  assert.ok(pauses[0] <= 300);
  pauses.slice(1).forEach((pause, i) => assert.ok(pause >= pauses[i]));
  assert.equal(pauses.at(-1), 5000);
});

test('a stream that opens and breaks at once is not opened ever faster', () => {
  assert.equal(attemptsAfter(6, 0), 6);
  assert.equal(attemptsAfter(6, 200), 6);
  assert.equal(attemptsAfter(6, 60_000), 0);
});

test('only a session that is gone, or another lab, ends the attempts', () => {
  for (const status of [undefined, 200, 429, 500, 503])
    assert.equal(verdictOf(status, 'The run').state, 'lost', `${status}`);
  assert.equal(verdictOf(404, 'Session A').state, 'closed');
  assert.match(verdictOf(404, 'Session A').text, /^Session A is closed/);
  assert.equal(verdictOf(410, 'The run').state, 'closed');
  assert.match(verdictOf(410, 'The run').text, /^The run was of a lab that has ended/);
  assert.doesNotMatch(verdictOf(410, 'The run').text, /30 minutes/);
  assert.match(verdictOf(403, 'The run').text, /printed last/);
});
