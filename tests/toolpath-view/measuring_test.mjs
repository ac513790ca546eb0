// Measurements and what a filter hides, in closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { recordingOf, viewModule } from './run.mjs';
import { sceneRecording } from './scene.mjs';

const { arcCenter, measured } = await viewModule('measuring');
const { hiddenSteps, noFilter, sectionsOf } = await viewModule('filter');
const { Toolpath } = await viewModule('toolpath');

const facts = { home: [0, 0, 0, 0, 0], tools: [{ name: null }, { name: 'T1' }, { name: 'T2' }] };
const pathOf = (...moves) => new Toolpath(recordingOf(facts, moves.map((move) => ({ tool: 1, seconds: 0.1, ...move }))));
/** Points at even angles, from the first on. */
const turned = (place, from, to, count = 24) => Array.from({ length: count }, (_, i) => place(from + ((i + 1) / count) * (to - from), (i + 1) / count));

test('distance, differences and angle are those of the places', () => {
  assert.deepEqual(measured([1, 2, 3], [4, 6, -9]), { distance: 13, delta: [3, 4, -12], angle: (Math.atan2(4, 3) * 180) / Math.PI });
  assert.equal(measured([0, 0, 0], [-5, 0, 1]).angle, 180);
  assert.equal(measured([1, 1, 5], [1, 1, -5]).angle, null);
});

for (const [name, place, center] of [
  ['a full circle', (a) => [50 + 20 * Math.cos(a), 30 + 20 * Math.sin(a), -3, 0, 0], [50, 30, -3]],
  ['a helix', (a, part) => [50 + 20 * Math.cos(a), 30 + 20 * Math.sin(a), -8 * part, 0, 0], [50, 30, -8]],
  ['a circle in XZ', (a) => [50 + 20 * Math.cos(a), 7, 30 + 20 * Math.sin(a), 0, 0], [50, 7, 30]],
])
  test(`${name} has its center`, () => {
    const path = pathOf({ line: 1, kind: 0, points: [place(0, 0)] }, { line: 2, kind: 2, points: turned(place, 0, 2 * Math.PI) });
    const found = arcCenter(path, 1);
    assert.ok(found && Math.hypot(...found.map((value, i) => value - center[i])) < 0.005, `${found}`);
  });

test('what is no arc has no center', () => {
  const path = pathOf(
    { line: 1, kind: 1, points: turned((a) => [Math.cos(a) * 9, Math.sin(a) * 9, 0, 0, 0], 0, 3) },
    { line: 2, kind: 2, points: [[5, 5, 0, 0, 0]] },
    { line: 3, kind: 2, points: [[6, 6, 0, 0, 0], [7, 7, 0, 0, 0], [8, 8, 0, 0, 0]] },
    { line: 4, kind: 2, points: turned((a) => [40 * Math.cos(a), 9 * Math.sin(a), 0, 0, 0], 0, 6) },
  );
  for (let step = 0; step < path.stepCount; ++step) assert.equal(arcCenter(path, step), null, `line ${step + 1}`);
});

test('sections go from tool change to tool change, and a filter hides whole ones', () => {
  const at = (x) => [[x, 0, 0, 0, 0]];
  const path = pathOf(
    ...[1, 1, 2, 2, 1].map((tool, i) => ({ line: i + 1, kind: 1, tool, points: at(i + 1) })),
  );
  assert.deepEqual(sectionsOf(path), [
    { start: 0, end: 2, tool: 1 },
    { start: 2, end: 4, tool: 2 },
    { start: 4, end: 5, tool: 1 },
  ]);
  assert.equal(hiddenSteps(path, noFilter), null);
  assert.deepEqual([...hiddenSteps(path, { ...noFilter, tools: new Set(['T1']) })], [1, 1, 0, 0, 1]);
  assert.deepEqual([...hiddenSteps(path, { ...noFilter, sections: new Set([1, 2]) })], [0, 0, 1, 1, 1]);
  assert.deepEqual([...hiddenSteps(path, { ...noFilter, lines: [[1, 1], [4, 9]] })], [0, 1, 0, 0, 1]);
  assert.deepEqual([...hiddenSteps(path, { ...noFilter, tools: new Set(['T2']), lines: [[0, 0]] })], [1, 0, 1, 1, 0]);
});

test('a mesh is read as it is written, without what is left of a triangle', async () => {
  const { trianglesOf } = await viewModule('scene');
  const mesh = sceneRecording('head').facts.scene.bodies.find((body) => body.mesh).mesh.positions;
  assert.equal(trianglesOf(mesh).length, 36);
  assert.deepEqual([...trianglesOf(mesh).slice(0, 3)], [300, 0, -20]);
  assert.equal(trianglesOf(Buffer.from(new Float32Array(14).buffer).toString('base64')).length, 9);
});
