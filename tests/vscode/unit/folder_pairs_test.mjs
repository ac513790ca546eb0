import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { differingPairs } = await module('behavior/folder_pairs');
const folder = (programs) => new Map(Object.entries(programs));

test('programs of two folders are paired by their paths', () => {
  const old = folder({ 'door.iso': 'G00 X1', 'left/door.iso': 'G00 X2', 'frame.iso': 'M02', 'empty.iso': '' });
  const now = folder({ 'door.iso': 'G00 X1', 'left/door.iso': 'G00 X3', 'panel.iso': 'M02' });
  assert.deepEqual(differingPairs(old, now), [
    { path: 'empty.iso', pairing: 'onlyOld' },
    { path: 'frame.iso', pairing: 'onlyOld' },
    { path: 'left/door.iso', pairing: 'changed' },
    { path: 'panel.iso', pairing: 'onlyNew' },
  ]);
  assert.deepEqual(differingPairs(old, old), []);
});
