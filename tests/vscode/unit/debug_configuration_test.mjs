import assert from 'node:assert/strict';
import { posix } from 'node:path';
import { test } from 'node:test';
import { module, viewModule } from '../modules.mjs';

const { absolute, completed } = await module('debug_configuration');
const { readPosition } = await viewModule('machine_position');

test('F5 without a configuration runs the open program, and stops at its first block', () => {
  assert.deepEqual(completed({}, '/parts/a.iso', 'Debug'), {
    type: 'isocnc', request: 'launch', name: 'Debug', program: '/parts/a.iso', stopOnEntry: true,
  });
});

test('what is given stays', () => {
  const given = { type: 'isocnc', request: 'launch', name: 'Mine', program: '/b.iso', speed: 2 };
  assert.deepEqual(completed(given, '/parts/a.iso', 'Debug'), { ...given, stopOnEntry: false });
});

test('the file in the editor is the open program, whatever has the focus', () => {
  const given = { type: 'isocnc', request: 'launch', name: 'Mine', program: '${file}' };
  assert.equal(completed(given, '/parts/a.iso', 'Debug').program, '/parts/a.iso');
  assert.equal(completed(given, null, 'Debug').program, '${file}');
  assert.equal(completed({ ...given, program: '${file}.iso' }, '/parts/a.iso', 'Debug').program, '${file}.iso');
});

test('files are named from the folder of the workspace', () => {
  const inParts = (file) => posix.resolve('/parts', file);
  const given = { type: 'isocnc', request: 'launch', name: 'Mine', program: 'a/b.iso', machine: '../isocnc.json' };
  assert.deepEqual(absolute(given, inParts), { ...given, program: '/parts/a/b.iso', machine: '/isocnc.json' });
  assert.deepEqual(absolute({ ...given, program: '/b.iso', machine: '' }, inParts), { ...given, program: '/b.iso', machine: '' });
  assert.deepEqual(absolute(given, undefined), given);
  for (const program of ['c:\\parts\\b.iso', 'vscode-vfs://github/shop/b.iso'])
    assert.equal(absolute({ ...given, program }, inParts).program, program);
  assert.ok(!('machine' in absolute({ type: 'isocnc', request: 'launch', name: 'Mine', program: 'b.iso' }, inParts)));
});

test('there may be nothing to run', () => assert.equal(completed({}, null, 'Debug'), null));

test('the position of the machine is read', () => {
  const tip = { x: 1, y: 2, z: 3, b: 90, c: -5 };
  assert.deepEqual(readPosition({ line: 12, time: 4.5, tip, speed: 0 }), { line: 11, tip: [1, 2, 3], b: 90, c: -5, seconds: 4.5 });
  for (const body of [undefined, null, 5, {}, { line: 1, time: 0 }, { line: 1, time: 0, tip: { ...tip, c: undefined } }, { line: '1', time: 0, tip }, { line: 1, tip }, { line: 1, time: 0, tip: { ...tip, y: NaN } }])
    assert.equal(readPosition(body), null, JSON.stringify(body));
});
