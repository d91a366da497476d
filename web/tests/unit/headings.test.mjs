// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { cardText, heading, refusal } = await source('headings');
const record = {
  file: '/out/R7/run.h5',
  name: 'run',
  description: 'first flight',
  record: true,
  navigator: 'fmt_star',
  outcome: 'time_limit',
  written: '2026-11-30 08:15',
  trouble: '',
};

test('headings do not depend on what else is listed', () => {
  assert.equal(heading('/usr/share/microswarm/scenarios'), 'First steps');
  assert.equal(heading('/usr/share/microswarm/scenarios/papers/drrt'), 'papers › drrt');
  assert.equal(heading('/home/ann/my_experiments/day_2'), 'my experiments › day 2');
  assert.equal(heading('/tmp/microswarm-aB3dE9/up'), 'Opened here');
});

test('a record says of what it is, how it ended, with which navigator and when', () => {
  const { name, text } = cardText(record);
  assert.equal(name, 'R7 / run');
  assert.equal(text, 'Record of first flight · time limit · fmt star · 2026-11-30 08:15');
  assert.equal(cardText({ ...record, record: false }).text, 'first flight');
});

test('a file that is too large is refused with its name, its size and the limit', () => {
  assert.equal(refusal('a.png', 64 * 2 ** 20), '');
  assert.match(refusal('a.png', 70 * 2 ** 20), /a\.png.*70 MiB.*64 MiB/);
});
