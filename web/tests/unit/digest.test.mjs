// SPDX-License-Identifier: Apache-2.0
// Plots and marks of long runs: what they show, and how many numbers they read for it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Digest } = await source('digest');
const { History } = await source('history');
const { TimeMarks } = await source('time_marks');

/** A list, and the number of its entries that were read. */
function counted(list) {
  const count = { reads: 0 };
  const proxy = new Proxy(list, {
    get: (target, name) => {
      if (typeof name === 'string' && /^\d+$/.test(name)) ++count.reads;
      return target[name];
    },
  });
  return [proxy, count];
}

const random = (seed) => () => (seed = (seed * 16807) % 2147483647) / 2147483647;

test('a short column is a line through all its values, gaps included', () => {
  const values = [1, NaN, 3, Infinity, 5];
  const line = new Digest(values).line([0, 1, 2, 3, 4], 400, 10);
  assert.deepEqual(line, [
    [0, 1, 2, 3, 4],
    [10, null, 30, null, 50],
  ]);
  assert.deepEqual(new Digest([]).line([], 400), [[], []]);
});

test('a long column is a line of few points that has every extreme value near its time', () => {
  const next = random(7);
  const values = [];
  const times = [];
  const digest = new Digest(values);
  for (const rows of [1, 15, 16, 17, 400, 401, 5000, 40_000, 100_003]) {
    while (values.length < rows) {
      times.push(values.length / 10);
      values.push(next() < 0.01 ? NaN : next());
    }
    const spike = Math.floor(rows * next());
    const before = values[spike];
    const fresh = rows === 100_003 ? digest : new Digest(values);
    if (fresh !== digest) values[spike] = 9;
    const [at, line] = fresh.line(times, 400);
    assert.ok(line.length <= 2 * 400 + 64, `${rows} rows: ${line.length} points`);
    assert.ok(
      at.every((time, i) => i === 0 || time >= at[i - 1]),
      `${rows} rows`,
    );
    assert.ok(at.at(-1) >= times.at(-1) - (2 * times.at(-1)) / 400 - 4);
    if (fresh === digest) continue;
    const highest = line.indexOf(9);
    assert.ok(highest >= 0, `${rows} rows`);
    assert.ok(Math.abs(at[highest] - times[spike]) <= (4 * times.at(-1)) / 400 + 4);
    values[spike] = before;
  }
});

test('after a million rows, new ones are drawn by reading as few numbers as after ten thousand', () => {
  const work = (rows) => {
    const [values, reads] = counted(Array.from({ length: rows }, (_, i) => Math.sin(i / 50)));
    const [times, timeReads] = counted(Array.from({ length: rows }, (_, i) => i / 10));
    const digest = new Digest(values);
    digest.line(times, 800);
    reads.reads = timeReads.reads = 0;
    for (let i = 0; i < 5; ++i) values[rows + i] = times[rows + i] = rows / 10;
    const [at] = digest.line(times, 800);
    return { reads: reads.reads + timeReads.reads, points: at.length };
  };
  const [short, long] = [work(10_000), work(1_000_000)];
  assert.ok(long.reads < 2000, `${long.reads} reads`);
  assert.ok(long.points < 2 * short.points, `${long.points} points, ${short.points} of the short run`);
});

function run(rows, plannedEvery) {
  const history = new History();
  const numbers = new Float64Array(2 * rows);
  for (let i = 0; i < rows; ++i) numbers.set([i / 10, i % plannedEvery === 0 ? 1 : 0], 2 * i);
  history.take(['t_s', 'planned'], numbers, [{ t_s: 0.5, kind: 'contact_wall' }], true);
  return history;
}

test('every planning event and event of a short run has its mark', () => {
  const marks = new TimeMarks();
  const history = run(20, 5);
  assert.deepEqual(marks.of(history, 1000), [
    ['plan', 0],
    ['plan', 5],
    ['plan', 10],
    ['plan', 15],
    ['contact', 5],
  ]);
  const more = Float64Array.from([2.0, 1]);
  history.take(
    ['t_s', 'planned'],
    more,
    [
      { t_s: 1.0, kind: 'goal_reached' },
      { t_s: 0.2, kind: 'odd' },
    ],
    false,
  );
  assert.deepEqual(marks.of(history, 1000).slice(4), [
    ['plan', 20],
    ['contact', 5],
    ['goal', 10],
    ['other', 2],
  ]);
  history.take(['t_s', 'planned'], Float64Array.from([0, 0]), [], true); // it began anew
  assert.deepEqual(marks.of(history, 1000), []);
});

test('marks of a long run are as many as there are places, and lose none of the places', () => {
  const marks = new TimeMarks();
  const history = run(1_000_000, 7);
  assert.equal(marks.of(history, 300).length, 301);
  for (const name of ['t_s', 'planned']) history.columns.set(name, history.columns.get(name));
  const [planned, reads] = counted(history.column('planned'));
  history.columns.set('planned', planned);
  history.take(['t_s', 'planned'], Float64Array.from([1e6, 1]), [], false);
  assert.equal(marks.of(history, 300).length, 301);
  assert.ok(reads.reads < 10, `${reads.reads} reads`);
});
