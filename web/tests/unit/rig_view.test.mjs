// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { actOf, barOf, consoleOf, staleWords } = await source('rig_view');
const rig = (state, more = {}) => ({
  type: 'rig',
  state,
  why: '',
  zero_confirmed: null,
  stop_trouble: '',
  folder: '',
  ...more,
});
const holder = { holds: true, free: false, pages: 1 };
const known = { controls: holder, mode: 'autonomous', arms: false, isLost: false, silence: 0, isStopUnanswered: false };
const enabled = ({ buttons }) =>
  Object.keys(buttons)
    .filter((name) => !buttons[name].hidden && !buttons[name].disabled)
    .sort();

test('what can be pressed in each state', () => {
  assert.deepEqual(enabled(consoleOf({ ...known, rig: rig('dry') })), ['arm', 'end', 'hold', 'manual', 'stop']);
  assert.deepEqual(enabled(consoleOf({ ...known, rig: rig('armed') })), ['end', 'hold', 'manual', 'stop']);
  assert.deepEqual(enabled(consoleOf({ ...known, rig: rig('opening') })), ['stop']);
  assert.deepEqual(enabled(consoleOf({ ...known, rig: rig('dry'), arms: true })), ['end', 'hold', 'manual', 'stop']);
  assert.deepEqual(enabled(consoleOf({ ...known, rig: rig('ended') })), ['arm', 'dry']);
  const watches = { ...known, controls: { holds: false, free: false, pages: 2 } };
  assert.deepEqual(enabled(consoleOf({ ...watches, rig: rig('armed') })), ['stop']);
});

test('nothing can be pressed while the connection is broken', () => {
  for (const state of ['dry', 'armed', 'opening', 'ended']) {
    const view = consoleOf({ ...known, rig: rig(state), isLost: true });
    assert.deepEqual(enabled(view), []);
    assert.equal(view.isHot, false);
    assert.equal(view.state, 'lost');
  }
});

test('a zero that is not confirmed is not called coils at zero', () => {
  assert.match(consoleOf({ ...known, rig: rig('ended', { zero_confirmed: false }) }).badge, /not confirmed/);
  assert.match(consoleOf({ ...known, rig: rig('ended', { zero_confirmed: true }) }).badge, /Coils at zero/);
});

test('space and Esc stop what is hot; Esc closes the question of a cold one', () => {
  for (const key of [' ', 'Escape']) for (const asks of [true, false]) assert.equal(actOf(key, true, asks), 'stop');
  assert.equal(actOf('Escape', false, true), 'close');
  for (const [key, hot, asks] of [
    [' ', false, true],
    [' ', false, false],
    ['Escape', false, false],
    ['Enter', true, true],
  ])
    assert.equal(actOf(key, hot, asks), undefined);
});

test('numbers after a stop or a break say of when they are', () => {
  const numbers = rig('armed', { t_s: 12.34, currents_a: [2.2] });
  assert.equal(staleWords(numbers, numbers, false), '');
  assert.match(
    staleWords(rig('ended', { zero_confirmed: true }), numbers, false),
    /before the stop, at 12\.3 s.*confirmed/,
  );
  assert.match(staleWords(rig('ended', { zero_confirmed: false }), numbers, false), /NOT confirmed/);
  assert.match(staleWords(rig('opening'), numbers, false), /run before/);
  assert.match(staleWords(numbers, numbers, true), /Last heard at 12\.3 s/);
});

test('a rig that is not heard is not called armed, and can be stopped', () => {
  const view = consoleOf({ ...known, rig: rig('armed'), silence: 4.2 });
  assert.equal(view.state, 'silent');
  assert.doesNotMatch(view.badge, /ARMED/);
  assert.match(view.words, /Nothing heard for 4 s/);
  assert.equal(view.isHot, true);
  assert.ok(enabled(view).includes('stop'));
  assert.equal(consoleOf({ ...known, rig: rig('armed'), silence: 0.3 }).state, 'armed');
  const numbers = rig('armed', { t_s: 12.34 });
  assert.match(staleWords(numbers, numbers, false, 4.2), /Last heard at 12\.3 s: nothing for 4 s/);
});

test('a stop without an answer calls for the emergency stop', () => {
  for (const isLost of [false, true])
    assert.match(
      consoleOf({ ...known, rig: rig('armed'), isLost, isStopUnanswered: true }).words,
      /^STOP was not answered: use the emergency stop/,
    );
});

test('bars of signed values begin in the middle', () => {
  assert.deepEqual(barOf(5, 10, true), { from: 0.5, to: 0.75 });
  assert.deepEqual(barOf(-20, 10, true), { from: 0, to: 0.5 });
  assert.deepEqual(barOf(5, 10, false), { from: 0, to: 0.5 });
});
