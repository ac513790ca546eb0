import assert from 'node:assert/strict';
import { test } from 'node:test';
import { module } from '../modules.mjs';

const { stateText } = await module('state_text');
const state = (x, motion) => ({
  inForce: { motion, plane: 17, face: 27, units: 71, distance: 90, feedMode: 94, interpolation: 48, cutterCompensation: 40, profileReduction: 38 },
  position: { x, y: 0, z: null, b: 0, c: 0 },
  machinePosition: null,
  workpieceOrigin: { x: 350, y: 220, z: -185.5 },
  faceMounted: false,
  spindle: { function: 3, speed: 16000 },
  tool: '101001',
  feed: 1500,
});
const lines = (answer) => stateText(answer, 'plate.iso:7', (text) => text).split('\n');
const row = (text, name) => text.find((line) => line.slice(2).startsWith(name));

test('what the line changes is marked', () => {
  const text = lines({ before: state(0, 0), after: state(12.5, 1) });
  assert.equal(text[0], 'plate.iso:7');
  assert.match(row(text, 'motion'), /^\* motion\s+G00\s+G01$/);
  assert.match(row(text, 'position'), /^\* position\s+X0 Y0 Z\? B0 C0\s+X12\.5 Y0 Z\? B0 C0$/);
  assert.match(row(text, 'arc plane'), /^ {2}arc plane\s+G17\s+G17$/);
  assert.match(row(text, 'tool'), /^ {2}tool\s+T101001\s+T101001$/);
});

test('what is not known is shown as such', () => {
  assert.match(row(lines({ before: null, after: state(1, null) }), 'motion'), /\?\s+-$/);
  assert.match(lines({ before: null, after: null }).join(' '), /No path leads here/);
});
