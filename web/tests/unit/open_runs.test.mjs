// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { runText } = await source('open_runs');

test('a link to an open run says how far it is, whether it was changed, and whether a page shows it', () => {
  const run = { session: 7, name: '/home/me/flight.yaml', t_s: 3.14159, watched: false, changed: false, live: false };
  assert.equal(runText(run), 'flight.yaml · 3.1 s');
  assert.equal(runText({ ...run, changed: true, watched: true }), 'flight.yaml · 3.1 s · changed · shown by a page');
});
