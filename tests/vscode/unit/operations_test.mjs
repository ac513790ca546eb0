// What the tree of operations shows of the answer to isocnc/operations.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { description, descriptionOfTool, facts, hiddenLines, stillHidden, toolsOf } = await module('operations/operations');

const texts = {
  operations: '{0} operations', notRun: 'not run', path: 'path', time: 'time', depth: 'deepest', extent: 'cuts in {0}', removed: 'removes', findings: 'findings', lines: 'lines',
};
const operation = (tool, firstLine, lastLine, more = {}) => ({
  line: firstLine + 1, firstLine, lastLine, tool, name: '', removed: null, seconds: 72.04, length: 3400, extents: { X: [0, 40.126], Y: [-5, 5], Z: [-23, 20] }, ...more,
});
const notRun = { seconds: null, length: null, extents: null };
const program = [operation('T1', 4, 9), operation('T2', 10, 19, { name: 'drill' }), operation('T1', 20, 29, { name: 'mill' })];

test('tools are in the order of their first use, with the name that one of their operations has', () => {
  assert.deepEqual(toolsOf(program), [
    { tool: 'T1', name: 'mill', operations: [0, 2] },
    { tool: 'T2', name: 'drill', operations: [1] },
  ]);
  assert.deepEqual(toolsOf([]), []);
});

test('an operation has its time, path and least Z beside it', () => {
  assert.equal(description(program[0], texts), '1:12.0 · 3400 mm · Z-23');
  assert.equal(description(operation('T1', 0, 1, { extents: null }), texts), '1:12.0 · 3400 mm');
  assert.equal(description(operation('T1', 0, 1, notRun), texts), 'not run');
});

test('a tool has the sum, unless one of its operations is not run', () => {
  const [first] = toolsOf(program);
  assert.equal(descriptionOfTool(first, program, texts), '2 operations · 2:24.1');
  assert.equal(descriptionOfTool(first, [program[0], program[1], operation('T1', 20, 29, notRun)], texts), '2 operations');
});

test('the facts leave out what is not known', () => {
  assert.deepEqual(facts({ ...program[0], removed: 12_345 }, 2, texts), [
    ['lines', '5–10'], ['time', '1:12.0'], ['path', '3400 mm'], ['deepest', 'Z-23'], ['cuts in X', '0 … 40.13'], ['cuts in Y', '-5 … 5'], ['cuts in Z', '-23 … 20'],
    ['removes', '12.3 cm3'], ['findings', '2'],
  ]);
  assert.deepEqual(facts(operation('T1', 0, 1, notRun), 0, texts), [['lines', '1–2'], ['time', 'not run']]);
});

test('what is hidden are lines; where one operation alone is shown, also what comes before the first', () => {
  assert.deepEqual(hiddenLines(program, new Set()), []);
  assert.deepEqual(hiddenLines(program, new Set([1])), [[10, 19]]);
  assert.deepEqual(hiddenLines(program, new Set([0, 2])), [[0, 3], [4, 9], [20, 29]]);
  assert.deepEqual(hiddenLines(program, new Set([0, 1, 2])), [[4, 9], [10, 19], [20, 29]]);
  assert.deepEqual(hiddenLines([program[0]], new Set()), []);
});

test('an edit keeps hidden what is still there', () => {
  const longer = program.map((each) => ({ ...each, lastLine: each.lastLine + 1 }));
  assert.deepEqual(stillHidden(program, longer, new Set([1])), new Set([1]));
  assert.deepEqual(stillHidden(program, program.slice(1), new Set([1])), new Set());
  assert.deepEqual(stillHidden(program, [program[1], program[0], program[2]], new Set([1])), new Set());
});
