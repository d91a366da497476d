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
    1.234: 1.234,
    '0.500': 0.5,
    '1234.500': 1234.5,
  };
  for (const [text, value] of Object.entries(typed)) assert.equal(typedNumber(text).value, value, text);
});

test('what is no number, or could be two, is refused in words', () => {
  for (const text of ['', 'abc', '1e999', '5x', '0x10', 'Infinity', '1.2.3', '1,2,3', '--1', 'e5', '.'])
    assert.match(typedNumber(text).trouble, /number/, text);
  for (const text of ['1,000', '-12,345', '1.234,5', '1,234.5'])
    assert.match(typedNumber(text).trouble, /decimal point/, text);
  assert.match(typedNumber('1.000').trouble, /two numbers: write 1 or 1000\.$/);
  assert.match(typedNumber('-12.500').trouble, /write -12\.5 or -12500\.$/);
  assert.match(typedNumber('1.000.000').trouble, /write 1000000\.$/);
});
