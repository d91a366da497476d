// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { metricsHeading, parametersNote, repeatOf } = await source('repeat');
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
  const back = { looks_back: true, growing: false, changes: [] };
  assert.equal(metricsHeading(false, { ...back, looks_back: false }, 71), 'Metrics so far');
  assert.match(metricsHeading(false, back, 71), /71\.0 s/);
  assert.match(metricsHeading(true, back, 71), /whole record/);
  assert.match(parametersNote(false, back, 3, 71), /3\.0 s.*71\.0 s/);
  assert.equal(parametersNote(false, { ...back, looks_back: false }, 71, 71), '');
  assert.equal(parametersNote(true, back, 3, 71), '');
  assert.match(parametersNote(true, { ...back, changes: ['seed=2'] }, 3, 71), /start of the record/);
});
