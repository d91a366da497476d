// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Changes } = await source('changes');
const { combine, at, text, shellWord } = await source('settings');
const scenario = { seed: 1, navigator: { type: 'radar', gap_um: 5 } };

test('changes wait, replace those within them, and go when the scenario has them', () => {
  const changes = new Changes();
  changes.wait('navigator.gap_um', 7, scenario);
  changes.wait('seed', 3, scenario);
  assert.deepEqual(changes.settings(), ['navigator.gap_um=7', 'seed=3']);
  assert.deepEqual(changes.wanted(scenario), { seed: 3, navigator: { type: 'radar', gap_um: 7 } });
  assert.equal(scenario.seed, 1);
  changes.wait('navigator', { type: 'fmt' }, scenario);
  assert.deepEqual(changes.settings(), ['seed=3', 'navigator={"type":"fmt"}']);
  assert.ok(changes.waits('navigator.gap_um') && changes.waits('navigator') && !changes.waits('navigator2'));
  changes.wait('seed', 1, scenario);
  changes.take({ navigator: { type: 'fmt' } });
  assert.equal(changes.count, 0);
});

test('a value that was sent is shown until its answer, unless a later one was sent', () => {
  const changes = new Changes();
  const first = changes.ask('seed', 2);
  const second = changes.ask('seed', 3);
  first();
  assert.equal(changes.wanted(scenario).seed, 3);
  second();
  assert.equal(changes.wanted(scenario).seed, 1);
});

test('a later setting replaces those of its key and within it', () => {
  const all = combine(['a.b=1', 'a.c=2', 'ab=3'], ['a=x', 'ab=4'], ['a.b=5']);
  assert.deepEqual(all, ['a=x', 'ab=4', 'a.b=5']);
});

test('values and words keep their meaning on a command line', () => {
  assert.deepEqual(
    [text('radar'), text('no'), text('two words'), text([1, 2])],
    ['radar', '"no"', '"two words"', '[1,2]'],
  );
  assert.deepEqual([shellWord('seed=3'), shellWord("a='b c'")], ['seed=3', `'a='\\''b c'\\'''`]);
  assert.equal(at({ obstacles: [{ motion: 4 }] }, 'obstacles.0.motion'), 4);
});
