// SPDX-License-Identifier: Apache-2.0
// Pure parts of a run in a file, and its playing.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { encode } from 'cborg';
import { source } from './source.mjs';

globalThis.window = globalThis;
const { FilePlayer } = await source('file_player');
const { heldAt, readRun } = await source('run_file');

const count = 12;
const since = (from, type, more = {}) => [from, encode({ type, ...more })];
const run = {
  hello: encode({ type: 'hello', name: 'run.h5' }),
  clearance: encode({ type: 'clearance' }),
  rows: encode({
    type: 'rows',
    columns: ['t_s', 'x_um'],
    rows: new Uint8Array(new Float64Array(Array.from({ length: 2 * count }, (_, i) => (i % 2 ? 7 : i / 20))).buffer),
    events: [],
    anew: true,
  }),
  standing: encode({ type: 'standing', frames: count, status: 'solved', changes: [], plays: false }),
  frames: Array.from({ length: count }, (_, number) => encode({ type: 'frame', number, frame: { t_s: number / 10 } })),
  scenario: [since(0, 'scenario', { scenario: { seed: 1 } }), since(5, 'scenario', { scenario: { seed: 2 } })],
  plan: [since(0, 'plan', { plans: 0 }), since(3, 'plan', { plans: 1 }), since(8, 'plan', { plans: 2 })],
  aggregation: [],
  every: 1,
  version: '1',
  hash: 'abc',
};
const settle = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

async function opened() {
  const heard = [];
  const states = [];
  const player = new FilePlayer(run, (state) => states.push(state));
  player.listen((message) => heard.push(message));
  await settle(5);
  const newest = (type) => heard.findLast((one) => one.type === type);
  return { player, heard, states, newest };
}

test('a run is read from base64 of gzip of CBOR', async () => {
  const text = gzipSync(encode(run)).toString('base64');
  assert.equal((await readRun(`\n${text}\n`)).frames.length, count);
  await assert.rejects(readRun(text.slice(0, -40)));
});

test('what holds at a frame is the newest before it', () => {
  assert.equal(heldAt(run.plan, 7), run.plan[1][1]);
  assert.equal(heldAt(run.plan, 8), run.plan[2][1]);
  assert.equal(heldAt([], 3), undefined);
});

test('a player shows any frame with what holds at it', async () => {
  const { player, heard, states, newest } = await opened();
  assert.deepEqual(states, ['open']);
  assert.deepEqual(heard.map((one) => one.type).slice(0, 2), ['hello', 'rows']);
  await player.ask({ do: 'seek', number: 9 });
  assert.deepEqual([newest('frame').number, newest('plan').plans, newest('scenario').scenario.seed], [9, 2, 2]);
  await player.ask({ do: 'seek', number: 4 });
  assert.deepEqual([newest('frame').number, newest('plan').plans, newest('scenario').scenario.seed], [4, 1, 1]);
  await player.ask({ do: 'seek', number: 99 });
  assert.equal(newest('standing').frame, count - 1);
  await player.ask({ do: 'seek', number: -1 });
  assert.equal(newest('standing').frame, 0);
  await player.ask({ do: 'step' });
  assert.equal(newest('standing').frame, 1);
  assert.equal((await player.ask({ do: 'set', key: 'seed', value: '3' })).issues.length, 1);
});

test('a player plays at its speed, ends, and begins again', async () => {
  const { player, newest } = await opened();
  await player.ask({ do: 'speed', number: 2 });
  const began = performance.now();
  await player.ask({ do: 'play' });
  while (newest('standing').plays) await settle(5);
  const took = performance.now() - began;
  assert.ok(took > 500 && took < 1200, `1.1 s at ×2 took ${took} ms`);
  assert.ok(newest('standing').ended);
  await player.ask({ do: 'play' });
  assert.equal(newest('standing').frame, 0);
  await player.ask({ do: 'pause' });
  player.close();
});
