// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Keys } = await source('keys');

test('no key of the page acts behind a modal dialog, or without a stream', () => {
  const listeners = {};
  const node = () => ({ setAttribute() {}, append() {}, addEventListener() {}, matches: () => false });
  let modal = null;
  globalThis.window = { addEventListener: (name, listener) => (listeners[name] = listener) };
  globalThis.document = { createElement: node, body: node(), querySelector: () => modal };
  let acts = 0;
  let prevented = 0;
  let isOpen = true;
  new Keys([{ keys: ['Escape'], shown: 'Esc', does: 'something', act: () => ++acts }], true, () => isOpen);
  const press = () => listeners.keydown({ key: 'Escape', target: node(), preventDefault: () => ++prevented });
  press();
  assert.deepEqual([acts, prevented], [1, 1]);
  isOpen = false;
  press();
  assert.deepEqual([acts, prevented], [1, 1]);
  isOpen = true;
  modal = node();
  press();
  assert.deepEqual([acts, prevented], [1, 1], 'and the browser closes the dialog');
});
