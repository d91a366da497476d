// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Drag } = await source('drag');

test('while a value is on its way the newest waits, and those between are dropped', async () => {
  const sent = [];
  const answers = [];
  const drag = new Drag(
    (key, value) => {
      sent.push([key, value]);
      return new Promise((answer) => answers.push(answer));
    },
    () => Promise.resolve(),
  );
  const settle = () => new Promise((done) => setTimeout(done, 0));
  drag.move('a', 1, 10);
  drag.move('a', 2, 1);
  drag.move('a', 3, 1);
  assert.deepEqual(sent, [['a', 1]]);
  answers.shift()();
  await settle();
  assert.deepEqual(sent.at(-1), ['a', 3]);
  drag.move('a', 4, 3);
  assert.equal(drag.end('a'), 10, 'the value before the drag');
  answers.shift()();
  await settle();
  assert.equal(sent.length, 2, 'what was not sent is dropped');
  assert.equal(drag.end('a'), undefined);
  drag.move('b', 1, 7);
  assert.deepEqual(sent.at(-1), ['b', 1]);
  assert.equal(drag.end('c'), undefined);
  assert.equal(drag.end('b'), 7);
});
