// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { eventText, eventsNear, isContact, nextEvent, ticksOf } = await source('events');
const { History } = await source('history');
const events = [1, 2, 2.01, 5].map((t_s) => ({ t_s, kind: t_s === 5 ? 'goal_reached' : 'contact_wall' }));

test('events near a time are named and counted', () => {
  assert.deepEqual(eventsNear(events, 2, 0.1), ['2 × contact with a wall']);
  assert.deepEqual(eventsNear(events, 5, 0.1), ['goal reached']);
  assert.deepEqual(eventsNear(events, 3.5, 0.1), []);
});

test('an event says what it was with', () => {
  assert.equal(eventText({ kind: 'contact_obstacle', body: 3 }), 'contact with obstacle 3');
  assert.equal(eventText({ kind: 'robots_unseen', body: 2 }), '2 robots unseen');
  assert.equal(eventText({ kind: 'hold_begins', body: 0 }), 'hold begins');
  assert.deepEqual([events[0], events[3]].map(isContact), [true, false]);
});

test('one goes from event to event', () => {
  assert.equal(nextEvent(events, 1, 1).t_s, 2);
  assert.equal(nextEvent(events, 2.01, -1).t_s, 2);
  assert.equal(nextEvent(events, 5, 1), undefined);
  assert.equal(nextEvent(events, 1, -1), undefined);
});

test('ticks are round, within the range and not too many', () => {
  assert.deepEqual(ticksOf(0, 10, 5), [0, 2, 4, 6, 8, 10]);
  for (const [lo, hi] of [
    [0, 0.7],
    [0.1, 71],
    [3, 86400],
    [1e6, 1e6 + 3],
  ])
    for (const most of [3, 10]) {
      const ticks = ticksOf(lo, hi, most);
      assert.ok(ticks.length >= 1 && ticks.length <= most + 1, `${ticks}`);
      assert.ok(ticks.every((one) => one >= lo - 1e-6 && one <= hi + 1e-6));
    }
  assert.deepEqual(ticksOf(3, 3, 5), []);
});

test('the frame nearest to a time, by brute force', () => {
  const history = new History();
  const times = Array.from({ length: 200 }, (_, i) => 0.1 * i + 0.04 * Math.sin(7 * i));
  history.take(['t_s'], Float64Array.from(times), [], true);
  for (let time = -1; time < 22; time += 0.037) {
    const gap = (i) => Math.abs(times[i] - time);
    const least = Math.min(...times.map((_, i) => gap(i)));
    assert.ok(Math.abs(gap(history.nearest(time)) - least) < 1e-12);
  }
  assert.equal(new History().nearest(3), 0);
});

test('rows follow those before, unless they come again', () => {
  const history = new History();
  history.take(['t_s', 'x'], Float64Array.from([0, 1, 0.1, 2]), events.slice(0, 1), true);
  history.take(['t_s', 'x'], Float64Array.from([0.2, 3]), events.slice(1, 2), false);
  assert.deepEqual([history.times, history.column('x'), history.events.length], [[0, 0.1, 0.2], [1, 2, 3], 2]);
  history.take(['t_s', 'x'], Float64Array.from([5, 6]), [], true);
  assert.deepEqual([history.times, history.column('x'), history.events.length], [[5], [6], 0]);
});
