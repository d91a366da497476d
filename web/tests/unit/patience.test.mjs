// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Patience } = await source('patience');
const fine = { type: 'answer', id: 1, issues: [] };
const settled = () => new Promise((resolve) => setImmediate(resolve));

function pending() {
  let resolve;
  const promise = new Promise((done) => (resolve = done));
  return { promise, resolve };
}

test('a late answer is said to be late until it comes', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const texts = [];
  const patience = new Patience((text) => texts.push(text));
  const [soon, slow, slower] = [pending(), pending(), pending()];
  const answers = [soon, slow, slower].map((one) => patience.of(one.promise));
  soon.resolve(fine);
  assert.equal(await answers[0], fine);
  t.mock.timers.tick(2900);
  assert.deepEqual(texts, []);
  t.mock.timers.tick(200);
  assert.equal(texts.length, 1); // once for both
  assert.match(texts[0], /has not answered/);
  slow.resolve(fine);
  assert.equal(await answers[1], fine);
  assert.equal(texts.length, 1);
  slower.resolve(fine);
  await answers[2];
  assert.equal(texts.at(-1), '');
});

test('the wait for an answer that does not come ends with words, and a later one is heard', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const texts = [];
  const patience = new Patience((text) => texts.push(text));
  const one = pending();
  const answer = patience.of(one.promise);
  t.mock.timers.tick(61_000);
  assert.match((await answer).issues[0].text, /No answer/);
  assert.match(texts.at(-1), /has not answered/);
  one.resolve(fine);
  await settled();
  assert.equal(texts.at(-1), '');
});
