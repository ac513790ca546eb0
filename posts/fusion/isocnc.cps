/*
 * Post-processor of Autodesk Fusion for ISOCNC: docs/posts.md.
 *
 * UNTRIED: it has never run in Fusion. A test runs it with a stand-in of Fusion's functions, on the cases of posts/kit.
 * Before the first part, post the cases of the kit with it and compare them with isodiff.
 */

description = "ISOCNC (untried)";
vendor = "ISOCNC";
legal = "MIT License";
certificationLevel = 2;
minimumRevision = 45702;
longDescription = "Milling in three axes, on tilted work planes and in five axes for ISOCNC routers. Untried in Fusion.";

extension = "iso";
setCodePage("utf-8");

capabilities = CAPABILITY_MILLING;
tolerance = spatial(0.002, MM);
minimumChordLength = spatial(0.01, MM);
minimumCircularRadius = spatial(0.01, MM);
maximumCircularRadius = spatial(10000, MM);
minimumCircularSweep = toRad(0.01);
maximumCircularSweep = toRad(360);
allowHelicalMoves = true;
allowedCircularPlanes = 7; // XY, ZX and YZ.

properties = {
  origin: {
    title: "Workpiece zero",
    description: "X,Y,Z in machine coordinates, mm; or: machine",
    type: "string",
    value: "",
    scope: "post"
  },
  head: {title: "Head", description: "First digit of the T", type: "integer", value: 0, scope: "post"},
  holder: {title: "Holder", description: "Second and third digit of the T", type: "integer", value: 0, scope: "post"},
  safeZ: {
    title: "Safe Z",
    description: "Where B and C may turn, in the workpiece frame, mm",
    type: "string",
    value: "",
    scope: "post"
  },
  flood: {title: "Flood", description: "M function of the machine", type: "integer", value: 8, scope: "post"},
  mist: {title: "Mist", description: "M function of the machine", type: "integer", value: 7, scope: "post"},
  coolantOff: {title: "Coolant off", description: "M function of the machine", type: "integer", value: 9, scope: "post"},
  stop: {title: "Stop", description: "M function that stops the program; 0: none", type: "integer", value: 0, scope: "post"}
};

// What the control has in force, as far as the program has written it.
var tool_in_spindle = "";
var spindle_speed = 0;
var spindle_code = 0;
var coolant_on = false;
var motion_code = -1;
var plane_code = 17;
var feed_text = "";
var five_axes = false;
var face_mounted = false;
var tilted = false;
var turns_axes = false;
var written = {}; // Coordinates as text, by axis.
var at_c = 0; // Degrees, not wrapped.

function digits(value, places) {
  var text = value.toFixed(places);
  if (text.indexOf(".") >= 0) {
    text = text.replace(/0+$/, "").replace(/\.$/, "");
  }
  return text === "-0" ? "0" : text;
}

function lengthText(value) {
  return digits(value, unit === IN ? 4 : 3);
}

function fail(reason) {
  error("isocnc: " + reason);
}

/** A property that is X,Y,Z in mm, in units of the program. */
function pointOf(text) {
  var parts = text.split(",");
  var point = [];
  for (var i = 0; i < parts.length; ++i) {
    point.push(parts[i].replace(/\s/g, "") === "" ? NaN : Number(parts[i]));
  }
  if (point.length !== 3 || !isFinite(point[0] + point[1] + point[2])) {
    fail("the workpiece zero is not X,Y,Z: " + text);
    return [0, 0, 0];
  }
  var scale = unit === IN ? 1 / 25.4 : 1;
  return [point[0] * scale, point[1] * scale, point[2] * scale];
}

function safeHeight() {
  var text = String(getProperty("safeZ"));
  if (text === "" || !isFinite(Number(text))) {
    fail("for tilted work planes, say with Safe Z how high the tool goes before B and C turn");
  }
  return Number(text) / (unit === IN ? 25.4 : 1);
}

function comment(text) {
  var clean = String(text).replace(/\(/g, "[").replace(/\)/g, "]").replace(/\s+/g, " ").replace(/^ | $/g, "");
  if (clean !== "") {
    writeln("(" + clean + ")");
  }
}

/** After these, the tip is elsewhere, or its coordinates count otherwise. */
function forget() {
  written = {B: written.B, C: written.C};
}

/** The words of the coordinates that change. */
function wordsOf(coordinates) {
  var order = ["X", "Y", "Z", "B", "C"];
  var words = [];
  for (var i = 0; i < order.length; ++i) {
    var axis = order[i];
    if (coordinates[axis] === undefined) {
      continue;
    }
    var text = i < 3 ? lengthText(coordinates[axis]) : digits(coordinates[axis], 4);
    if (written[axis] !== text) {
      words.push(axis + text);
      written[axis] = text;
    }
  }
  return words;
}

function feedWord(feed) {
  var text = digits(feed, 3);
  if (!(feed > 0) || text === "0") {
    fail("a feed move without a feed");
  }
  if (text === feed_text) {
    return [];
  }
  feed_text = text;
  return ["F" + text];
}

function writeMotion(code, words) {
  if (words.length === 0) {
    return;
  }
  var text = (code < 10 ? "G0" : "G") + code;
  writeln([text].concat(words).join(" "));
  motion_code = code;
}

function rapid(coordinates) {
  if (turns_axes && written.B === undefined) {
    coordinates.B = coordinates.B === undefined ? 0 : coordinates.B;
    coordinates.C = coordinates.C === undefined ? 0 : coordinates.C;
  }
  writeMotion(0, wordsOf(coordinates));
}

function feedMove(coordinates, feed) {
  var words = wordsOf(coordinates);
  if (words.length > 0) {
    writeMotion(1, words.concat(feedWord(feed)));
  }
}

function setFiveAxes(wanted) {
  if (five_axes !== wanted) {
    writeln(wanted ? "G49" : "G48");
    five_axes = wanted;
  }
}

function stopSpindle() {
  if (spindle_code) {
    writeln("M05");
    spindle_code = 0;
  }
}

function startSpindle(speed, clockwise) {
  var code = clockwise ? 3 : 4;
  if (!(speed > 0)) {
    fail("the spindle starts without a speed");
  }
  if (spindle_code === code && spindle_speed === speed) {
    return;
  }
  if (spindle_code && spindle_code !== code) {
    stopSpindle();
  }
  writeln("S" + digits(speed, 0) + " M0" + code);
  spindle_code = code;
  spindle_speed = speed;
}

function functionText(name) {
  var number = getProperty(name);
  return (number < 10 ? "M0" : "M") + number;
}

function stopCoolant() {
  if (coolant_on) {
    writeln(functionText("coolantOff"));
    coolant_on = false;
  }
}

function startCoolant(mode) {
  if (mode === COOLANT_OFF) {
    return;
  }
  if (mode !== COOLANT_FLOOD && mode !== COOLANT_MIST) {
    fail("this coolant has no M function; flood and mist have");
  }
  writeln(functionText(mode === COOLANT_FLOOD ? "flood" : "mist"));
  coolant_on = true;
}

// Faces

function dismountFace() {
  if (face_mounted) {
    writeln("G27");
    face_mounted = false;
    forget();
    rapid({Z: safeHeight()});
  }
}

function upright() {
  if (tilted) {
    rapid({Z: safeHeight()});
    rapid({B: 0, C: 0});
    at_c = 0;
    tilted = false;
  }
}

function isWorkpiece(plane) {
  return Math.abs(plane.right.x - 1) + Math.abs(plane.up.y - 1) + Math.abs(plane.forward.z - 1) < 1e-9;
}

function degrees(radians) {
  return radians * 180 / Math.PI;
}

/** Up, across, B and C, down, and only then into the face. */
function mountFace(plane, origin, start) {
  var i = plane.right;
  var j = plane.up;
  var k = plane.forward;
  if (k.z < -1e-9) {
    fail("a work plane that looks down cannot be reached from above");
  }
  var plain = Math.abs(j.z) < 1e-9;
  var b = plain ? degrees(Math.atan2(-i.z, k.z)) : degrees(Math.acos(Math.min(1, k.z)));
  var c = plain ? degrees(Math.atan2(-j.x, j.y)) : degrees(Math.atan2(k.y, k.x));
  if (start.z > safeHeight()) {
    fail("Safe Z is below the start of a tilted work plane");
  }
  rapid({Z: safeHeight()});
  rapid({X: start.x, Y: start.y});
  rapid(Math.abs(b) > 1e-9 ? {B: b, C: c} : {B: 0, C: 0});
  rapid({Z: start.z});
  var words = ["X" + lengthText(origin.x), "Y" + lengthText(origin.y), "Z" + lengthText(origin.z)];
  if (plain) {
    words.push("B" + digits(b, 6), "C" + digits(c, 6));
  } else {
    var letters = "ABCIJKPQR";
    var values = [i.x, i.y, i.z, j.x, j.y, j.z, k.x, k.y, k.z];
    for (var n = 0; n < 9; ++n) {
      if (digits(values[n], 9) !== "0") {
        words.push(letters.charAt(n) + digits(values[n], 9));
      }
    }
  }
  writeln((plain ? "G29 " : "G24 ") + words.join(" "));
  face_mounted = true;
  tilted = true;
  forget();
}

// What Fusion calls

function onOpen() {
  comment(programName || "");
  comment(programComment || "");
  for (var n = 0; n < getNumberOfSections(); ++n) {
    var section = getSection(n);
    turns_axes = turns_axes || section.isMultiAxis() || !isWorkpiece(section.workPlane);
  }
  writeln("G17 " + (unit === IN ? "G70" : "G71") + " G90 G94");
  var origin = String(getProperty("origin"));
  if (origin !== "machine") {
    var at = pointOf(origin);
    writeln("G92 X" + lengthText(at[0]) + " Y" + lengthText(at[1]) + " Z" + lengthText(at[2]));
  }
}

function toolName() {
  var head = getProperty("head");
  var holder = getProperty("holder");
  if (tool.number >= 100000 && tool.number <= 999999) {
    return String(tool.number);
  }
  if (!(head >= 1 && head <= 9 && holder >= 1 && holder <= 99) || !(tool.number >= 1 && tool.number <= 999)) {
    fail("tool " + tool.number + " has no T: give Head and Holder, or a number of six digits");
  }
  return String(head) + (holder < 10 ? "0" : "") + holder + ("00" + tool.number).slice(-3);
}

function onSection() {
  var section = currentSection;
  if (section.workOffset > 1) {
    fail("only the first work offset has a place on the machine");
  }
  if (hasParameter("operation-comment")) {
    comment(getParameter("operation-comment"));
  }
  var name = toolName();
  var plane = section.workPlane;
  var is_face = !section.isMultiAxis() && !isWorkpiece(plane);
  dismountFace();
  if (name !== tool_in_spindle) {
    upright();
    stopSpindle();
    writeln("M06 T" + name);
    tool_in_spindle = name;
    forget();
  }
  startSpindle(tool.spindleRPM, tool.clockwise);
  startCoolant(tool.coolant);
  var start = section.getInitialPosition();
  if (is_face) {
    mountFace(plane, section.workOrigin, start);
    setTranslation(section.workOrigin);
    setRotation(plane);
    return;
  }
  upright();
  cancelTransformation();
  rapid({Z: start.z});
  rapid({X: start.x, Y: start.y});
  if (section.isMultiAxis()) {
    rapid(tiltOf(section.getGlobalInitialToolAxis()));
    tilted = true;
  }
}

function onSectionEnd() {
  setFiveAxes(false);
  stopCoolant();
}

function onRapid(x, y, z) {
  rapid({X: x, Y: y, Z: z});
}

function onLinear(x, y, z, feed) {
  feedMove({X: x, Y: y, Z: z}, feed);
}

/** B and C of a tool axis; C goes on the shorter way, and stays where it is under an upright tool. */
function tiltOf(axis) {
  var b = degrees(Math.acos(Math.max(-1, Math.min(1, axis.z))));
  var c = at_c;
  if (b > 1e-6) {
    c = degrees(Math.atan2(axis.y, axis.x));
    c += 360 * Math.round((at_c - c) / 360);
  } else {
    b = 0;
  }
  at_c = c;
  return {B: b, C: c};
}

function onRapid5D(x, y, z, i, j, k) {
  var tilt = tiltOf({x: i, y: j, z: k});
  rapid({X: x, Y: y, Z: z, B: tilt.B, C: tilt.C});
}

function onLinear5D(x, y, z, i, j, k, feed) {
  var tilt = tiltOf({x: i, y: j, z: k});
  if (written.B !== digits(tilt.B, 4) || written.C !== digits(tilt.C, 4)) {
    setFiveAxes(true);
  }
  feedMove({X: x, Y: y, Z: z, B: tilt.B, C: tilt.C}, feed);
}

function onCircular(clockwise, cx, cy, cz, x, y, z, feed) {
  var plane = getCircularPlane();
  var code = plane === PLANE_XY ? 17 : plane === PLANE_ZX ? 18 : plane === PLANE_YZ ? 19 : 0;
  if (code === 0) {
    linearize(tolerance);
    return;
  }
  if (plane_code !== code) {
    writeln("G" + code);
    plane_code = code;
  }
  var ends = {X: x, Y: y, Z: z};
  var centers = {X: ["I", cx], Y: ["J", cy], Z: ["K", cz]};
  var axes = code === 17 ? ["X", "Y"] : code === 18 ? ["X", "Z"] : ["Y", "Z"];
  for (var n = 0; n < 2; ++n) {
    written[axes[n]] = ""; // Both are written, also where they stay.
  }
  var words = wordsOf(ends);
  for (n = 0; n < 2; ++n) {
    words.push(centers[axes[n]][0] + lengthText(centers[axes[n]][1]));
  }
  writeMotion(clockwise ? 2 : 3, words.concat(feedWord(feed)));
}

function onCyclePoint(x, y, z) {
  if (cycleType === "tapping" || cycleType === "left-tapping" || cycleType === "right-tapping") {
    fail("tapping has no counterpart: the control does not couple the spindle to Z");
  }
  expandCyclePoint(x, y, z); // There are no cycles: motions.
}

function onDwell(seconds) {
  if (seconds > 0) {
    writeln("G04 P" + digits(seconds, 3));
  }
}

function onSpindleSpeed(speed) {
  startSpindle(speed, tool.clockwise);
}

function onComment(text) {
  comment(text);
}

function onCommand(command) {
  switch (command) {
  case COMMAND_START_SPINDLE:
    startSpindle(tool.spindleRPM, tool.clockwise);
    return;
  case COMMAND_STOP_SPINDLE:
    stopSpindle();
    return;
  case COMMAND_COOLANT_ON:
    startCoolant(tool.coolant);
    return;
  case COMMAND_COOLANT_OFF:
    stopCoolant();
    return;
  case COMMAND_STOP:
  case COMMAND_OPTIONAL_STOP:
    if (!getProperty("stop")) {
      fail("the dialect has no M that stops the program; give Stop");
    }
    writeln(functionText("stop"));
    return;
  case COMMAND_LOCK_MULTI_AXIS:
  case COMMAND_UNLOCK_MULTI_AXIS:
  case COMMAND_BREAK_CONTROL:
  case COMMAND_TOOL_MEASURE:
    return;
  default:
    fail("a command without a counterpart: " + command);
  }
}

function onRadiusCompensation() {
  if (radiusCompensation !== RADIUS_COMPENSATION_OFF) {
    fail("let Fusion compensate: Compensation type, In computer");
  }
}

function onClose() {
  setFiveAxes(false);
  dismountFace();
  upright();
  stopSpindle();
  writeln("M02");
}
