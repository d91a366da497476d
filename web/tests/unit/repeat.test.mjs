// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { decisionsNote, metricsHeading, parametersNote, repeatOf } = await source('repeat');
const run = { command: 'microswarm run a.yaml', playback: false };
const record = { command: 'microswarm replay run.h5', playback: true };

test('a command is said to repeat a run only if it does', () => {
  const plain = repeatOf(run, { changes: [], steered: false });
  assert.match(plain.note, /repeats the run/);
  const changed = repeatOf(run, { changes: ['goal_um=[1,2]'], steered: false });
  assert.equal(changed.command, "microswarm run a.yaml --set 'goal_um=[1,2]'");
  assert.match(changed.note, /another.*record\.h5/);
  const steered = repeatOf(run, { changes: [], steered: true });
  assert.match(steered.none, /steered/);
  assert.match(steered.note, /no command line.*record\.h5/);
});

test('a record is repeated by itself, whatever was done in it', () => {
  for (const steered of [true, false]) {
    const { command, none } = repeatOf(record, { changes: ['seed=3'], steered });
    assert.equal(command, record.command);
    assert.equal(/steered/.test(none), steered);
  }
});

test('numbers that are not of the picture say of when they are', () => {
  const back = { looks_back: true, growing: false, changes: [], metrics: { time_s: 3 }, decisions_every: 4 };
  const now = { ...back, looks_back: false };
  assert.equal(metricsHeading(false, now), 'Metrics so far');
  assert.match(metricsHeading(false, back), /3\.0 s/);
  assert.match(metricsHeading(true, now), /whole record/);
  assert.match(parametersNote(false, back, 3), /3\.0 s/);
  assert.equal(parametersNote(false, now, 71), '');
  assert.equal(parametersNote(true, now, 3), '');
  assert.match(parametersNote(true, { ...now, changes: ['seed=2'] }, 3), /3\.0 s/);
  assert.match(decisionsNote(back), /one frame in 4/);
  assert.equal(decisionsNote(now), '');
  assert.equal(decisionsNote({ ...back, decisions_every: 1 }), '');
});
