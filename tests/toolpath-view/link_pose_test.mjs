// Where links are: compared with joints that isorun reports, and with closed forms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { run, viewModule, write } from './run.mjs';
import { kinematics } from './scene.mjs';

const { jointsOf, linkPose, poseBesideWorkpiece, spindleLink, workpieceLink } = await viewModule('link_pose');

/** A matrix in columns, applied to a point. */
function applied({ elements: e }, [x, y, z]) {
  return [0, 1, 2].map((i) => e[i] * x + e[i + 4] * y + e[i + 8] * z + e[i + 12]);
}
function near(found, wanted, within = 1e-9) {
  const off = Math.hypot(...found.map((value, i) => value - wanted[i]));
  assert.ok(off <= within, `${found} is ${off} mm beside ${wanted}`);
}

const program = write('poses.iso', 'M06 T101001\nG00 X200 Y100 Z50 B60 C170\nG49\nG01 X100 Y0 Z10 B-20 C90 F6000\nM02\n');
for (const machine of ['head', 'table']) {
  const description = {
    head: { type: 'head', pivot: 150, spindleFromB: [5, -3, 10], bFromC: [20, 7, -4] },
    table: { type: 'table', bPoint: [30, 5, -50], cPoint: [10, -8, 2] },
  }[machine];
  test(`${machine}: the joints of each pose are isorun's`, () => {
    const named = Object.fromEntries(
      Object.entries(description).map(([key, value]) => [key, Array.isArray(value) ? { x: value[0], y: value[1], z: value[2] } : value]),
    );
    const file = write(`${machine}.json`, JSON.stringify({ machine: { kinematics: named, tools: [{ head: 1, holder: 1, tool: 1, length: 120 }] } }));
    const { stdout, stderr } = run('--samples', '-', '--dt', '0.1', '--no-config', '--machine', file, program);
    assert.ok(stdout, stderr);
    const samples = stdout.trim().split('\n').map((line) => JSON.parse(line));
    let compared = 0;
    for (const { tip, joints } of samples) {
      if (tip.every((value, i) => value === joints[i])) continue; // The tool is not mounted yet.
      const { x, y, z, b, c } = jointsOf({ ...kinematics[machine], ...description }, tip.slice(0, 3), tip[3], tip[4], 120);
      near([x, y, z, b, c], joints, 1e-3);
      ++compared;
    }
    assert.ok(compared > 10);
  });
}

for (const [machine, facts] of Object.entries(kinematics))
  test(`${machine}: the spindle holds the tip, and the workpiece rests`, () => {
    for (const [b, c] of [[0, 0], [90, 0], [35, -110], [-70, 200]]) {
      const tip = [120, -40, 15];
      const joints = jointsOf(facts, tip, b, c, 100);
      near(applied(poseBesideWorkpiece(facts, spindleLink(facts), joints), [0, 0, -100]), tip);
      near(applied(poseBesideWorkpiece(facts, workpieceLink(facts), joints), [1, 2, 3]), [1, 2, 3]);
    }
  });

test('links of linear axes move with their axes and those that carry them', () => {
  const joints = { x: 10, y: 20, z: 30, b: 40, c: 50 };
  for (const facts of Object.values(kinematics))
    for (const [link, wanted] of [['machine', [1, 2, 3]], ['X', [11, 2, 3]], ['Y', [11, 22, 3]], ['Z', [11, 22, 33]]])
      near(applied(linkPose(facts, link, joints), [1, 2, 3]), wanted);
  for (const link of ['B', 'C']) near(applied(linkPose(kinematics.threeAxis, link, joints), [1, 2, 3]), [11, 22, 33]);
});

test('C of a head turns about its axis alone, and B of a table tilts about its own', () => {
  // The C axis is 25 mm beside the spindle: 20 to the B axis, and 5 to the spindle.
  near(applied(linkPose(kinematics.head, 'C', { x: 0, y: 0, z: 0, b: 90, c: 180 }), [0, 0, 0]), [-50, 0, 0]);
  near(applied(linkPose(kinematics.table, 'B', { x: 0, y: 0, z: 0, b: 90, c: 0 }), [0, 0, 0]), [-50, 0, -50]);
  near(applied(linkPose(kinematics.table, 'C', { x: 0, y: 0, z: 0, b: 0, c: 90 }), [0, 0, 0]), [10, 10, 0]);
});
