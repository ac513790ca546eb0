// A program in its surroundings, written by hand: a body of each shape, on each kind of link, and contacts.
import { recordingOf } from './run.mjs';

export const program = `M06 T101001
G00 X100 Y50 Z20
G01 Z0 F3000
G00 X200 B90
G03 X240 Y90 I200 J90
M06 T102002
G00 X0 Y0 Z60 B0
G01 Z-10
M02
`;

/** A tetrahedron, 60 mm high, over the corner at (300, 0, -20). */
const corners = { a: [300, 0, -20], b: [380, 0, -20], c: [300, 80, -20], d: [300, 0, 40] };
const faces = ['acb', 'abd', 'bcd', 'cad'];
const positions = Float32Array.from(faces.flatMap((face) => [...face].flatMap((corner) => corners[corner])));

export const kinematics = {
  threeAxis: { type: 'threeAxis', pivot: 0, spindleFromB: [0, 0, 0], bFromC: [0, 0, 0], bPoint: [0, 0, 0], cPoint: [0, 0, 0] },
  head: { type: 'head', pivot: 150, spindleFromB: [5, 0, 10], bFromC: [20, 0, 0], bPoint: [0, 0, 0], cPoint: [0, 0, 0] },
  table: { type: 'table', pivot: 0, spindleFromB: [0, 0, 0], bFromC: [0, 0, 0], bPoint: [0, 0, -50], cPoint: [10, 0, 0] },
};

export const scene = (machine) => ({
  name: 'setup.json',
  kinematics: kinematics[machine],
  nose: [[0, 30], [40, 45], [120, 45]],
  tools: {
    T101001: {
      length: 100,
      cutter: [[0, 0], [2, 6], [6, 8], [40, 8]],
      shank: [[40, 6], [60, 6]],
      holder: [[60, 20], [80, 20], [80, 30], [100, 30]],
    },
    T102002: { length: 80, cutter: null, shank: null, holder: [[30, 15], [80, 25]] },
  },
  bodies: [
    { name: 'clamp', role: 'fixture', on: 'workpiece', at: [10, 0, 0], box: [[50, -20, -20], [90, 20, 30]] },
    { name: 'cup', role: 'fixture', on: 'workpiece', at: [0, 0, 0], cylinder: { at: [150, 150, -60], axis: [0, 0, 1], height: 40, radius: 30 } },
    { name: 'board', role: 'spoilboard', on: 'workpiece', at: [0, 0, 0], box: [[-50, -60, -80], [420, 240, -60]] },
    { name: 'part', role: 'target', on: 'workpiece', at: [0, 0, 0], mesh: { positions: Buffer.from(positions.buffer).toString('base64') } },
    { name: 'blank', role: 'stock', on: 'workpiece', at: [0, 0, 0], box: [[0, 0, -20], [400, 200, 0]] },
    { name: 'column', role: 'machine', on: 'machine', at: [0, 0, 0], box: [[500, -10, 0], [520, 10, 200]] },
    { name: 'gantry', role: 'machine', on: 'X', at: [0, 0, 0], box: [[-40, -300, 200], [40, 300, 240]] },
    { name: 'motor', role: 'machine', on: machine === 'head' ? 'B' : 'Z', at: [0, 0, 0], box: [[-40, -40, 120], [40, 40, 200]] },
  ],
});

export const contacts = [
  { code: 'E152', severity: 'error', line: 4, endLine: 5, time: 3, endTime: 4.5, tool: 'T101001', who: 'holder', whom: 'clamp', point: [100, 20, 30], distance: -2.5, message: { en: 'the holder of T101001 goes 2.5 mm into clamp <b>', it: 'il portautensile T101001 entra 2.5 mm in clamp <b>' } },
  { code: 'W154', severity: 'warning', line: 8, endLine: 8, time: 7.5, endTime: 8, tool: 'T102002', who: 'nose', whom: 'gantry', point: [40, 0, 200], distance: 1.2, message: { en: 'the nose passes gantry at 1.2 mm', it: 'il naso passa a 1.2 mm da gantry' } },
];
export const certificate = {
  en: 'verified: 6 motions, 1 contact; nothing nearer than 0.01 mm is unseen',
  it: 'verificato: 6 movimenti, 1 contatto; nulla di più vicino di 0.01 mm sfugge',
};

const arc = Array.from({ length: 12 }, (_, i) => {
  const angle = ((i + 1) / 12) * (Math.PI / 2) - Math.PI / 2;
  return [200 + 40 * Math.cos(angle), 90 + 40 * Math.sin(angle), 0, 90, 0];
});
const moves = [
  { line: 2, kind: 0, tool: 1, seconds: 1, points: [[100, 50, 20, 0, 0]] },
  { line: 3, kind: 1, tool: 1, seconds: 1, points: [[100, 50, 0, 0, 0]] },
  { line: 4, kind: 1, tool: 1, seconds: 2, points: [[200, 50, 0, 90, 0]] },
  { line: 5, kind: 2, tool: 1, seconds: 1 / 12, points: arc },
  { line: 7, kind: 0, tool: 2, seconds: 2, points: [[0, 0, 60, 0, 0]] },
  { line: 8, kind: 1, tool: 2, seconds: 1, points: [[0, 0, -10, 0, 0]] },
];

/** With `surroundings` false, the same path without any. */
export function sceneRecording(machine, surroundings = true) {
  const facts = {
    version: 1,
    name: 'scene.iso',
    language: 'en',
    ending: 'end',
    endLine: 8,
    turnsTool: machine !== 'threeAxis',
    home: [0, 0, 100_000, 0, 0],
    tools: [
      { name: null, length: null, radius: null },
      { name: 'T101001 mill', length: 100, radius: 8 },
      { name: 'T102002', length: 80, radius: null },
    ],
    frames: [{ line: 0, origin: [0, 0, 0], i: [1, 0, 0], j: [0, 1, 0], k: [0, 0, 1] }],
    travel: [[-500, 900], [-500, 600], [-250, 500], [-120, 120], [-360, 360]],
  };
  if (surroundings) Object.assign(facts, { scene: scene(machine), contacts, certificate });
  return recordingOf(facts, moves);
}
