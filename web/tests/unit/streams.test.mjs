// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { Streams } = await source('streams');

test('one of two streams that opens does not hide that the other is broken', () => {
  const both = new Streams();
  assert.ok(both.isOpen); // keys wait for the first answer
  both.take(0, 'lost', 'Run A broke.');
  both.take(1, 'open', '');
  assert.equal(both.state, 'lost');
  assert.equal(both.text, 'Run A broke.');
  both.take(1, 'closed', 'Run B is closed.');
  assert.equal(both.state, 'closed');
  assert.equal(both.text, 'Run A broke. Run B is closed.');
  both.take(0, 'open', '');
  assert.equal(both.text, 'Run B is closed.');
  assert.equal(both.isOpen, false);
  both.take(1, 'open', '');
  assert.ok(both.isOpen);
  assert.equal(both.text, '');
});

test('what both say is said once', () => {
  const both = new Streams();
  both.take(0, 'lost', 'The lab has ended.');
  both.take(1, 'lost', 'The lab has ended.');
  assert.equal(both.text, 'The lab has ended.');
});
