import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { numbersOf } = await module('numbers');

for (const [text, least, most, wanted] of [
  ['400', 1, 1, [400]],
  [' -.5 ', 1, 1, [-0.5]],
  ['100, -50', 2, 3, [100, -50]],
  ['100 -50 +3.', 2, 3, [100, -50, 3]],
  ['100', 2, 3, null],
  ['1,2,3,4', 2, 3, null],
  ['1,,2', 2, 3, null],
  ['1,', 1, 2, null],
  ['', 1, 1, null],
  ['1e3', 1, 1, null],
  ['0x10', 1, 1, null],
  ['Infinity', 1, 1, null],
])
  test(`numbers in '${text}'`, () => assert.deepEqual(numbersOf(text, least, most), wanted));
