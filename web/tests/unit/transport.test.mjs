// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Transport } = await source('transport');
const { barView } = await source('bar_view');
const { fasterSpeed } = await source('speeds');
const { History } = await source('history');

/** A session with frames at these times that notes what it is asked. */
function session(times, standing = {}) {
  const history = new History();
  history.take(['t_s'], Float64Array.from(times), [{ t_s: 0.2, kind: 'contact_wall' }], true);
  const asked = [];
  const ask = (request) => Promise.resolve(asked.push(request));
  return {
    history,
    asked,
    ask,
    standing: { plays: false, ended: false, frame: 0, speed: 1, ...standing },
    shown: 0,
    hello: {},
    seek: (frame) => asked.push({ do: 'seek', number: frame }),
  };
}

test('two runs are paused, and the one behind goes on to the time of the other', async () => {
  const [a, b] = [session([0, 0.1, 0.2], { plays: true }), session([0, 0.1], { plays: true })];
  new Transport([a, b]).play();
  await new Promise((resolve) => setTimeout(resolve, 5));
  assert.deepEqual(a.asked, [{ do: 'pause' }]);
  assert.deepEqual(b.asked, [{ do: 'pause' }, { do: 'play', number: 0.2 }]);
});

test('the longest run leads, and all show its time', () => {
  const [a, b] = [session([0, 0.1]), session([0, 0.1, 0.2])];
  const time = new Transport([a, b]);
  time.seek(2);
  assert.deepEqual([a.asked, b.asked], [[{ do: 'seek', number: 1 }], [{ do: 'seek', number: 2 }]]);
  time.seekEvent(1);
  assert.deepEqual(b.asked.at(-1), { do: 'seek', number: 2 });
});

test('the next contact passes over other events', () => {
  const run = session([0, 1, 2, 3]);
  run.history.events = [
    { t_s: 1, kind: 'hold_begins' },
    { t_s: 3, kind: 'contact_wall' },
  ];
  const time = new Transport([run]);
  time.seekContact(1);
  assert.deepEqual(run.asked, [{ do: 'seek', number: 3 }]);
  time.seekContact(-1);
  assert.equal(run.asked.length, 1);
});

test('a run that ended begins again with play; one of a record does not', async () => {
  const run = session([0, 0.1], { ended: true });
  let restarts = 0;
  const time = new Transport([run], async () => ++restarts);
  assert.ok(time.isOver);
  time.play();
  await new Promise((resolve) => setTimeout(resolve, 5));
  assert.equal(restarts, 1);
  assert.equal(new Transport([{ ...run, hello: { playback: true } }], async () => 1).isOver, false);
});

test('the buttons of the bar', () => {
  const standing = { frame: 4, frames: 5, growing: false, speed: 3 };
  const none = { anyPlays: false, allEnded: false, isOver: false };
  assert.deepEqual(
    [barView(none, standing, false, false).play, barView({ ...none, anyPlays: true }, standing, false, false).play],
    ['▶ Play', '❚❚ Pause'],
  );
  assert.equal(barView({ ...none, allEnded: true, isOver: true }, standing, false, false).play, '↻ Restart');
  assert.equal(barView({ ...none, allEnded: true }, standing, false, false).canPlay, false);
  assert.equal(barView({ ...none, allEnded: true }, standing, true, false).canPlay, true);
  assert.equal(barView(none, standing, false, true).isNewest, false);
  assert.equal(barView(none, { ...standing, frame: 3 }, true, false).isNewest, false);
  assert.equal(barView(none, standing, true, false).hasLive, false);
  assert.equal(barView(none, standing, false, false).speed, '1');
});

test('speeds go up and down and end at the fastest', () => {
  assert.deepEqual(
    [
      fasterSpeed(1, 1),
      fasterSpeed(1, -1),
      fasterSpeed(50, 1),
      fasterSpeed(0, 1),
      fasterSpeed(0.1, -1),
      fasterSpeed(3, 1),
    ],
    [2, 0.5, 0, 0, 0.1, 10],
  );
});
