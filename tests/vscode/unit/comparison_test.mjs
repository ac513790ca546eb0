// What is shown of a comparison: a lens for each change, and one that sums them up.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { lensesOf, summary } = await module('behavior/comparison');

const texts = { same: 'same', sameUpToError: 'same up to {0} on {1}', one: 'one', many: '{0} differences', time: 'time {0} s' };
const lines = (first, end) => ({ start: { line: first, character: 0 }, end: { line: end, character: 0 } });
const change = (first, end, more = {}) => ({ kind: 'moved', tool: 'T102003', seconds: 0, text: 'moved by Z-0.2', oldRange: lines(0, 1), newRange: lines(first, end), ...more });
const comparison = (changes, more = {}) => ({ same: changes.length === 0, old: { time: 10, error: null }, new: { time: 10, error: null }, changes, ...more });

test('each change has a lens above its first line, and the summary is after that of the first one', () => {
  const made = lensesOf(comparison([change(4, 7, { seconds: 3.14 }), change(9, 9, { tool: null, text: 'removed: M100' })], { new: { time: 13.14, error: null } }), texts, 12);
  assert.deepEqual(made, [
    { line: 4, title: 'T102003: moved by Z-0.2, time +3.1 s' },
    { line: 9, title: 'removed: M100' },
    { line: 4, title: '2 differences, time +3.1 s' },
  ]);
});

test('what is missing at the end is above the last line', () => {
  assert.equal(lensesOf(comparison([change(5, 5)]), texts, 5)[0].line, 4);
  assert.equal(lensesOf(comparison([change(0, 0)]), texts, 0)[0].line, 0);
  assert.deepEqual(lensesOf(comparison([]), texts, 5), [{ line: 0, title: 'same' }]);
});

test('a time that rounds to none is not mentioned', () => {
  assert.equal(summary(comparison([change(1, 2)], { new: { time: 10.04, error: null } }), texts), 'one');
  assert.equal(summary(comparison([change(1, 2)], { new: { time: 8, error: null } }), texts), 'one, time -2.0 s');
});

test('no difference is one up to the error where both stop', () => {
  assert.equal(summary(comparison([]), texts), 'same');
  const stopped = { old: { time: 1, error: { code: 'ISO028', line: 4 } }, new: { time: 1, error: { code: 'ISO028', line: 3 } } };
  assert.equal(summary(comparison([], stopped), texts), 'same up to ISO028 on 4');
});
