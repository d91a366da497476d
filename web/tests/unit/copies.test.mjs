// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { openAgain } = await source('copies');
const live = { session: 7, hello: { name: '/flights/first.yaml', photo: null } };
const outside = { error: '/flights/first.yaml: no such file in the folders of this lab' };

/** A server that refuses a named file with `refusal` and opens /flights/given.yaml without a file. */
function serve(refusal, names) {
  const asked = [];
  globalThis.fetch = async (path, { method, body }) => {
    asked.push(`${method} ${path} ${body ?? ''}`);
    const answer = (ok, json) => ({ ok, json: async () => json });
    if (method === 'POST')
      return 'file' in JSON.parse(body) ? answer(!refusal, refusal ?? { session: 8 }) : answer(true, { session: 9 });
    return answer(true, { name: names?.[path.split('/').at(-1)] });
  };
  return asked;
}

test('a copy is of the file of its run', async () => {
  const asked = serve(undefined);
  assert.equal(await openAgain(live, []), 8);
  assert.equal(asked.length, 1);
});

test('a refusal of settings opens nothing else', async () => {
  const asked = serve({ error: 'goal_um: outside of the map' });
  await assert.rejects(openAgain(live, ['goal_um=[0, 999]']), /outside of the map/);
  assert.equal(asked.length, 1);
});

test('the experiment of the command line may be outside of the folders', async () => {
  serve(outside, { 7: 'first.yaml', 9: 'first.yaml' });
  assert.equal(await openAgain(live, []), 9);
});

test('a file that is gone is not replaced by the experiment of the command line', async () => {
  const asked = serve(outside, { 7: '/flights/first.yaml', 9: '/flights/given.yaml' });
  await assert.rejects(openAgain(live, []), /no longer in the folders/);
  assert.match(asked.at(-1), /^DELETE \/api\/sessions\/9/);
});
