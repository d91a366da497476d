// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { StopRequest } = await source('stop_request');
const { factsOf } = await source('arm_panel');

function pending() {
  let resolve;
  const promise = new Promise((done) => (resolve = done));
  return { promise, resolve };
}
const isOpen = () => false;

test('a stop without an answer in half a second is unanswered, until one answers', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  let changes = 0;
  const request = new StopRequest(() => ++changes);
  const answer = pending();
  const sent = request.send(() => answer.promise, isOpen);
  t.mock.timers.tick(499);
  assert.equal(request.isUnanswered, false);
  t.mock.timers.tick(1);
  assert.equal(request.isUnanswered, true);
  assert.equal(changes, 1);
  answer.resolve();
  await sent;
  assert.equal(request.isUnanswered, false);
});

test('a broken stream does not answer a stop, and an earlier stop not a later one', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const request = new StopRequest(() => undefined);
  const [first, second] = [pending(), pending()];
  const sent = [
    request.send(() => first.promise, isOpen),
    request.send(
      () => second.promise,
      () => true,
    ),
  ];
  t.mock.timers.tick(500);
  first.resolve();
  await sent[0];
  assert.equal(request.isUnanswered, true);
  second.resolve();
  await sent[1];
  assert.equal(request.isUnanswered, true);
  request.hasStopped();
  assert.equal(request.isUnanswered, false);
});

test('a stream that breaks leaves a stop unanswered, also before it is known to be lost', async () => {
  const request = new StopRequest(() => undefined);
  await request.send(() => Promise.resolve({ id: 0 }), isOpen);
  assert.equal(request.isUnanswered, true);
  await request.send(() => Promise.resolve({ id: 7 }), isOpen);
  assert.equal(request.isUnanswered, false);
});

test('the question before the coils are driven names what is real and the largest limits', () => {
  const facts = factsOf({
    name: 'bench',
    coils: ['x', 'y'],
    real_coils: true,
    real_camera: false,
    max_current_a: [2, 3, null],
    max_temperature_c: [null, null],
    field_mt: 8,
    warnings: ['The lens is dirty.'],
  }).join('\n');
  assert.match(facts, /bench: 2 coils are driven by a device, a simulated camera/);
  assert.match(facts, /8 mT; at most 3 A, no limit in °C/);
  assert.match(facts, /lens is dirty/);
  assert.deepEqual(factsOf(undefined), []);
});
