import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { code, expressionAt, toolChangeBeside } = await module('program_text');

for (const [line, wanted] of [
  ['G01 X1 ; M06', 'G01 X1      '],
  ['(a;b) G01', '      G01'],
  ['G01 (open', 'G01      '],
  ['X1(a)0 ;(c', 'X1   0    '],
])
  test(`the code of ${line}`, () => assert.equal(code(line), wanted));

const program = ['; M06 T1', 'M06 T101001', 'G00 X0 (M06)', 'm 6 T102003', 'M60', 'M065', 'N5 M006T103001', 'M02'];
const beside = (from, direction) => toolChangeBeside(program.length, (i) => program[i], from, direction);

test('tool changes are found as they may be written', () => {
  assert.equal(beside(0, 1), 1);
  assert.equal(beside(1, 1), 3);
  assert.equal(beside(3, 1), 6);
  assert.equal(beside(6, 1), null);
  assert.equal(beside(7, -1), 6);
  assert.equal(beside(6, -1), 3);
  assert.equal(beside(1, -1), null);
});

for (const [line, column, wanted] of [
  ['V1 = 2', 0, 'V1'],
  ['IF v 07 > 2 GOTO N5', 4, 'V7'],
  ['IF V G P L = 1 GOTO N5', 5, 'VGPL'],
  ['G01 X-12.5 Y3', 6, 'X'],
  ['G01 X-12.5 Y3', 12, 'Y'],
  ['G01 X1 F2000', 8, 'F'],
  ['G01 X1', 1, null],
  ['G01 X1 ; V1', 9, null],
  ['', 0, null],
])
  test(`what the debugger is asked in ${line} at ${column}`, () => assert.equal(expressionAt(line, column)?.name ?? null, wanted));
