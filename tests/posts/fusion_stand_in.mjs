// Runs posts/fusion/isocnc.cps with a stand-in of the functions of Fusion that it calls, on a case of the kit, and prints the
// program. It shows that the post does what it means to; it does not show that Fusion calls it so.
//   node fusion_stand_in.mjs POST CASE.json [PROPERTIES as JSON]

import { readFileSync } from "node:fs";
import { createContext, runInContext } from "node:vm";

const [postFile, caseFile, given] = process.argv.slice(2);
const program = [];
const kit = JSON.parse(readFileSync(caseFile, "utf8"));
const settings = given ? JSON.parse(given) : {};

const add = (a, b) => a.map((value, n) => value + b[n]);
const scaled = (a, factor) => a.map((value) => value * factor);
const dot = (a, b) => a.reduce((sum, value, n) => sum + value * b[n], 0);
const vector = ([x, y, z]) => ({ x, y, z });
const kWorkpiece = { origin: [0, 0, 0], i: [1, 0, 0], j: [0, 1, 0], k: [0, 0, 1] };

const outward = (frame, point) =>
  add(frame.origin, add(scaled(frame.i, point[0]), add(scaled(frame.j, point[1]), scaled(frame.k, point[2]))));

const axisOf = (b, c) => {
  const [tilt, turn] = [b, c].map((angle) => (angle * Math.PI) / 180);
  return [Math.sin(tilt) * Math.cos(turn), Math.sin(tilt) * Math.sin(turn), Math.cos(tilt)];
};

/// Sections, as Fusion would have them: one for each tool and frame, with the motions after the approach.
function sectionsOf(steps) {
  const sections = [];
  let tool = { number: 0, spindleRPM: 0, clockwise: true, coolant: "off" };
  let frame = kWorkpiece;
  let current = null;
  for (const [index, step] of steps.entries()) {
    if (step.tool) {
      tool = { number: Number(step.tool), spindleRPM: 0, clockwise: true, coolant: "off" };
      current = null;
    } else if (step.spindle !== undefined && !current) {
      tool.spindleRPM = step.spindle;
      tool.clockwise = step.turn !== "counterclockwise";
    } else if (step.coolant && !current) {
      tool.coolant = step.coolant;
    } else if (step.coolant === "off" || step.spindle === 0 || step.approach) {
      continue; // The post's own affair.
    } else if (step.frame !== undefined) {
      frame = step.frame ?? kWorkpiece;
      current = null;
      if (step.frame === null && !steps.slice(index).some((each) => each.move && !each.approach)) break;
    } else {
      if (!current) sections.push((current = { tool, frame, steps: [] }));
      current.steps.push(step);
    }
  }
  return sections;
}

/// Where each motion goes, with all its coordinates; the first two rapids of a section are its initial position.
function motionsOf(section) {
  let at = [null, null, null];
  let [b, c] = [0, 0];
  const all = [];
  for (const step of section.steps) {
    if (step.to) at = step.to.map((value, n) => value ?? at[n]);
    if (step.at) at = [...step.at, step.retract];
    [b, c] = [step.b ?? b, step.c ?? c];
    all.push({ ...step, to: at, axis: axisOf(b, c) });
  }
  return all;
}

let section = null;
const state = { transformed: false };
const sections = sectionsOf(kit.steps).map((each) => ({
  ...each,
  isMulti: each.steps.some((step) => step.move === "feed" && (step.b !== undefined || step.c !== undefined)),
}));
const asSection = (each) => {
  const first = motionsOf(each).find((motion) => !motion.to.includes(null));
  return {
    workOffset: 0,
    workOrigin: vector(each.frame.origin),
    workPlane: { right: vector(each.frame.i), up: vector(each.frame.j), forward: vector(each.frame.k) },
    isMultiAxis: () => each.isMulti,
    getInitialPosition: () => vector(outward(each.frame, first.to)),
    getGlobalInitialToolAxis: () => vector(each.isMulti ? first.axis : each.frame.k),
  };
};

const fusion = {
  CAPABILITY_MILLING: 1, MM: 0, IN: 1, unit: 0, PLANE_XY: 0, PLANE_ZX: 1, PLANE_YZ: 2,
  COOLANT_OFF: "off", COOLANT_FLOOD: "flood", COOLANT_MIST: "mist",
  COMMAND_START_SPINDLE: 1, COMMAND_STOP_SPINDLE: 2, COMMAND_COOLANT_ON: 3, COMMAND_COOLANT_OFF: 4, COMMAND_STOP: 5,
  COMMAND_OPTIONAL_STOP: 6, COMMAND_LOCK_MULTI_AXIS: 7, COMMAND_UNLOCK_MULTI_AXIS: 8, COMMAND_BREAK_CONTROL: 9,
  COMMAND_TOOL_MEASURE: 10, RADIUS_COMPENSATION_OFF: 0, radiusCompensation: 0,
  programName: kit.name, programComment: "", cycleType: "drilling",
  setCodePage() {},
  spatial: (value) => value,
  toRad: (angle) => (angle * Math.PI) / 180,
  writeln: (text) => program.push(text),
  error(text) {
    throw new Error(text);
  },
  getProperty: (name) => settings[name] ?? fusion.properties[name].value,
  getNumberOfSections: () => sections.length,
  getSection: (n) => asSection(sections[n]),
  hasParameter: () => false,
  setTranslation: () => (state.transformed = true),
  setRotation: () => (state.transformed = true),
  cancelTransformation: () => (state.transformed = false),
  getCircularPlane: () => state.plane,
  linearize() {
    throw new Error("the stand-in makes no chords");
  },
  expandCyclePoint: (x, y, z) => drill(state.hole, x, y, z),
};

/// As Fusion makes motions of a cycle.
function drill(hole, x, y) {
  const height = (z) => fusion.onRapid(x, y, z);
  const cut = (z) => fusion.onLinear(x, y, z, hole.feed);
  fusion.onRapid(x, y, state.at[2]);
  height(hole.top);
  let depth = hole.top;
  while (depth > hole.bottom) {
    if (depth < hole.top && hole.drill === "peck") height(depth + hole.clearance);
    depth = Math.max(hole.bottom, depth - (hole.step ?? Infinity));
    cut(depth);
    if (depth > hole.bottom) height(hole.drill === "peck" ? hole.top : depth + hole.clearance);
  }
  if (hole.drill === "dwell") fusion.onDwell(hole.dwell);
  height(hole.retract);
}

function play(motion) {
  if (motion.spindle) return fusion.onSpindleSpeed(motion.spindle);
  if (motion.dwell && !motion.drill) return fusion.onDwell(motion.dwell);
  if (motion.to.includes(null)) return undefined; // On the way to the initial position.
  if (motion.drill) {
    state.hole = motion;
    fusion.onCyclePoint(...motion.at, motion.bottom);
  } else if (motion.move === "arc") {
    state.plane = [fusion.PLANE_YZ, fusion.PLANE_ZX, fusion.PLANE_XY][motion.normal.indexOf(1)];
    fusion.onCircular(motion.sweep < 0, ...motion.center, ...motion.to, motion.feed);
  } else if (section.isMulti) {
    if (motion.move === "rapid") fusion.onRapid5D(...motion.to, ...motion.axis);
    else fusion.onLinear5D(...motion.to, ...motion.axis, motion.feed);
  } else if (motion.move === "rapid") {
    fusion.onRapid(...motion.to);
  } else {
    fusion.onLinear(...motion.to, motion.feed);
  }
  state.at = motion.to;
  return undefined;
}

createContext(fusion);
runInContext(readFileSync(postFile, "utf8"), fusion, { filename: postFile });
fusion.onOpen();
for (section of sections) {
  const isFace = Math.abs(dot(section.frame.k, [0, 0, 1]) - 1) > 1e-9;
  fusion.tool = section.tool;
  fusion.currentSection = asSection(section);
  fusion.onSection();
  if (state.transformed !== isFace) throw new Error("the post counts coordinates in another frame than Fusion");
  motionsOf(section).forEach(play);
  fusion.onSectionEnd();
}
fusion.onClose();
process.stdout.write(`${program.join("\n")}\n`);
