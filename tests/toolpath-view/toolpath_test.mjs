// What a page holds is what the machine does: compared with isorun's own samples, trace and summary.
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pageOf, recordingIn, root, run, skip, viewModule, write } from './run.mjs';

const probe = run('--plot', write('probe.html', ''), '--no-config', write('probe.iso', 'M02\n'));
if (probe.stderr.includes('npm')) skip('this isorun has no --plot FILE.html');
const { Toolpath, Kind } = await viewModule('toolpath');
const { ProgramText } = await viewModule('program_text');

const examples = readdirSync(join(root, 'examples'))
  .filter((name) => name.endsWith('.iso'))
  .map((name) => join(root, 'examples', name));
const jsonLines = (text) => text.trim().split('\n').map((line) => JSON.parse(line));

/** Rapids that turn B and C, five-axis moves, G49 arcs, exact stops and pauses. */
const fiveAxes = write(
  'five_axes.iso',
  `M06 T101001
G00 X200 Y100 Z50 B60 C170
G00 X-50 B-30 C-100
G49
G01 X100 Y0 Z10 B20 C90 F6000
X0 Y50 B0 G09
G03 X0 Y50 I20 J50 C-90
G04 P0.5
G01 B30
G48
G02 X10 Y60 Z5 R20 F3000
G09
G01 X11
G00 Z100 B0 C0
M02
`,
);
const machine = write(
  'machine.json',
  '{"machine": {"kinematics": {"type": "table"}, "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 120, "radius": 6, "name": "fresa"}]}}',
);

for (const [name, program, ...options] of [
  ...examples.map((each) => [each.slice(root.length), each]),
  ['five axes, head', fiveAxes],
  ['five axes, table', fiveAxes, '--machine', machine],
]) {
  test(`${name}: at any time the tool is where the machine has it`, () => {
    const path = new Toolpath(recordingIn(pageOf(program, ...options)));
    const samples = jsonLines(run('--samples', '-', '--dt', '0.0137', '--no-config', ...options, program).stdout);
    assert.ok(samples.length > 50);
    for (const { t, tip } of samples) {
      const place = path.at(t);
      const off = Math.hypot(...place.tip.map((value, i) => value - tip[i]));
      assert.ok(off < 0.06, `at ${t} s ${place.tip} is ${off} mm beside ${tip}`);
      assert.ok(Math.abs(place.b - tip[3]) < 0.06 && Math.abs(place.c - tip[4]) < 0.06, `at ${t} s`);
    }
    assert.ok(Math.abs(path.seconds - samples.at(-1).t) < 1e-4);
  });

  test(`${name}: each move is a step of its line, tool and feed`, () => {
    const path = new Toolpath(recordingIn(pageOf(program, ...options)));
    const events = jsonLines(run('--trace', '-', '--no-config', ...options, program).stdout);
    const kinds = { rapid: Kind.Rapid, feed: Kind.Feed, arc: Kind.Arc };
    const moves = events.filter((event) => event.kind in kinds);
    const steps = [...path.stepKind.keys()].filter((step) => path.stepKind[step] !== Kind.Wait);
    assert.equal(steps.length, moves.length);
    steps.forEach((step, i) => {
      assert.equal(path.stepLine[step] + 1, moves[i].line);
      assert.equal(path.stepKind[step], kinds[moves[i].kind]);
      assert.ok(Math.abs(path.stepFeed[step] - (moves[i].feed ?? 0)) < 0.001);
      if (moves[i].duration > 1e-3) assert.ok(Math.abs(path.endOf(step) - moves[i].start - moves[i].duration) < 1e-4);
    });
  });
}

test('a place on the path and its time are one', () => {
  const path = new Toolpath(recordingIn(pageOf(fiveAxes)));
  for (let point = 1; point < path.pointCount; ++point) {
    if (path.times[point] - path.times[point - 1] < 1e-3) continue;
    for (const part of [0.1, 0.5, 0.9]) {
      const time = path.timeOn(point, part);
      assert.ok(Math.abs(path.at(time).part - part) < 1e-6 || path.lengthTo(point) < 1e-6, `${point} ${part}`);
    }
  }
});

test('programs without motion, and with none at all, are readable', () => {
  for (const text of ['M02\n', 'G92 X1 Y2 Z3\nM06 T101001\nM02\n']) {
    const path = new Toolpath(recordingIn(pageOf(write('still.iso', text))));
    assert.ok(path.pointCount >= 2);
    assert.deepEqual(path.at(0).tip, [0, 0, 0]);
  }
});

test('coordinates of any size are read', () => {
  const far = write('far.iso', `M06 T101001\nG00 X${'9'.repeat(40)}\nX-${'9'.repeat(40)}\nX1 Y-2 Z3.5\nM02\n`);
  const path = new Toolpath(recordingIn(pageOf(far)));
  assert.ok(path.tips.every(Number.isFinite));
  assert.deepEqual(path.tipOf(path.pointCount - 1).slice(1), [-2, 3.5]);
});

test('lines end at CR, LF and CR LF', () => {
  const program = new ProgramText(new TextEncoder().encode('A\r\nB\rC\n\nD'));
  assert.equal(program.lineCount, 5);
  assert.deepEqual([0, 1, 2, 3, 4].map((line) => program.line(line)), ['A', 'B', 'C', '', 'D']);
});
