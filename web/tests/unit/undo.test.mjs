// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Undo, restartStep } = await source('undo');
const { moved, Tuned } = await source('tuned');

test('changes are taken back one by one, the last one first', () => {
  const undo = new Undo();
  undo.push({ before: [['a', 1]], restarts: false });
  undo.push({ before: [['b', 2]], restarts: false });
  const now = { a: 5, b: 6 };
  assert.deepEqual(undo.pop(now).before, [['b', 2]]);
  assert.deepEqual(undo.pop(now).before, [['a', 1]]);
  assert.equal(undo.pop(now), undefined);
});

test('a change that was discarded, or whose object is gone, is passed over', () => {
  const undo = new Undo();
  undo.push({ before: [['a', 1]], restarts: false });
  undo.push({ before: [['b', 2]], restarts: false });
  undo.push({ before: [['list.3.x', 7]], restarts: false });
  const now = { a: 5, b: 2, list: [] };
  assert.ok(undo.has(now));
  assert.deepEqual(undo.pop(now).before, [['a', 1]]);
  assert.equal(undo.has(now), false);
});

test('a change that a restart made is the next to be taken back, by a restart', () => {
  const undo = new Undo();
  undo.push({ before: [['a', 1]], restarts: false });
  undo.push(restartStep(['start.x_um=5', 'start.y_um=6', 'odd=1'], { start: { x_um: 1, y_um: 2 } }));
  undo.push(restartStep([], { a: 1 })); // one that changed nothing
  const step = undo.pop({ a: 2, start: { x_um: 5, y_um: 6 } });
  assert.equal(step.restarts, true);
  assert.deepEqual(step.before, [
    ['start.x_um', 1],
    ['start.y_um', 2],
  ]);
});

const disc = (x) => ({ motion: { type: 'still', position_um: [x, 0] } });

test('what was tuned stays with its obstacle when others come and go', () => {
  const before = { obstacles: [disc(1), disc(2), disc(3)] };
  assert.equal(moved('obstacles.1.motion', before, { obstacles: [disc(2), disc(3)] }), 'obstacles.0.motion');
  assert.equal(moved('obstacles.1.motion', before, { obstacles: [disc(1), disc(3)] }), undefined);
  assert.equal(
    moved('obstacles.1.motion', before, { obstacles: [disc(9), ...before.obstacles] }),
    'obstacles.2.motion',
  );
  const changed = { obstacles: [disc(1), { motion: { type: 'straight' } }, disc(3)] };
  assert.equal(moved('obstacles.1.motion', before, changed), 'obstacles.1.motion');
  assert.equal(moved('navigator', before, { obstacles: [] }), 'navigator');
  const twins = { obstacles: [disc(1), disc(1), disc(2)] };
  assert.equal(moved('obstacles.1.motion', twins, { obstacles: [disc(1), disc(1)] }), 'obstacles.1.motion');

  const tuned = new Tuned();
  tuned.keep('obstacles.0.motion', { type: 'still', position_um: [1, 0] });
  tuned.keep('obstacles.1.motion', { type: 'still', position_um: [2, 0] });
  tuned.follow(before, { obstacles: [disc(2), disc(3)] });
  assert.deepEqual(tuned.of('obstacles.0.motion', 'still'), { type: 'still', position_um: [2, 0] });
  assert.equal(tuned.of('obstacles.1.motion', 'still'), undefined);
  assert.equal(tuned.of('obstacles.0.motion', 'straight'), undefined);
});
