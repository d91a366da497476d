// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { source } from './source.mjs';

const { typedNumber } = await source('numbers');

test('numbers as people type them', () => {
  const typed = {
    50.5: 50.5,
    '50,5': 50.5,
    '0,125': 0.125,
    ' 1e-3 ': 0.001,
    '-7': -7,
    '−7': -7,
    '+2.': 2,
    '.5': 0.5,
    ',5': 0.5,
    '1 000': 1000,
  };
  for (const [text, value] of Object.entries(typed)) assert.equal(typedNumber(text).value, value, text);
});

test('what is no number, or could be two, is refused in words', () => {
  for (const text of ['', 'abc', '1e999', '5x', '0x10', 'Infinity', '1.2.3', '1,2,3', '--1', 'e5', '.'])
    assert.match(typedNumber(text).trouble, /number/, text);
  for (const text of ['1,000', '-12,345', '1.234,5', '1,234.5'])
    assert.match(typedNumber(text).trouble, /decimal point/, text);
});
