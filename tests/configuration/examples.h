#pragma once

#include <string_view>

namespace isocnc::configuration {

/// Configurations with nothing wrong.
inline constexpr std::string_view kRightTexts[] = {
    "{}",
    "// Nothing but comments.\n/* and */ { // this\n}",
    R"({"$schema": "isocnc.schema.json", "language": "it"})",
    R"({"machine": {"home": {"x": -350.5, "b": 0, "c": 1e2}, "tolerances": {"arc": 0.05}}})",
    R"({"machine": {"axes": {"X": {"min": -10, "max": 3200}, "B": {"min": -100}, "C": {}}}})",
    R"({"machine": {"maxFeed": 20000, "maxRotarySpeed": 6e3, "maxSpindleSpeed": 18000, "clearance": 2}})",
    R"({"machine": {"rapidMotion": "independent"}})",
    R"({"machine": {"tools": [], "functions": {}}})",
    R"({"machine": {"tools": [{"head": 1, "holder": 1.0, "tool": 999, "name": "\u00d8 8", "length": 80, "radius": 4},
                              {"head": 1, "holder": 2, "tool": 999}]}})",
    R"({"machine": {"functions": {"M1": {}, "M07": {"name": "aria"}, "M100": {}, "M999": {"name": "m"}}}})",
    R"({"machine": {"tools": [
      {"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 5, "shape": "flat", "cornerRadius": 0, "maxDepth": 9},
      {"head": 1, "holder": 1, "tool": 2, "length": 100, "radius": 5, "shape": "ball", "cutLength": 20, "shank": 12},
      {"head": 1, "holder": 1, "tool": 3, "length": 100, "radius": 5, "shape": "bull", "cornerRadius": 5, "body": "a"},
      {"head": 1, "holder": 1, "tool": 4, "length": 100, "radius": 5, "shape": "cone", "tipAngle": 60, "body": "b"},
      {"head": 1, "holder": 1, "tool": 5, "length": 100, "radius": 5, "shape": "drill", "tipAngle": 118},
      {"head": 1, "holder": 1, "tool": 6, "length": 100, "radius": 40, "shape": "disc", "cutLength": 4, "shank": 16},
      {"head": 1, "holder": 1, "tool": 7, "length": 100, "profile": [[0, 0], [0, 6.5], [100, 6.5]]},
      {"head": 1, "holder": 1, "tool": 8, "length": 100, "profile": [[0, 1], [9, 4]], "cutLength": 5, "shank": 8},
      {"head": 1, "holder": 1, "tool": 9, "length": 100, "cutLength": 50, "shank": 8, "body": "b"},
      {"head": 1, "holder": 1, "tool": 10, "cutLength": 50}],
      "holders": {"a": [[40, 30, 63]], "b": [[1, 0, 20], [9.5, 20, 20]]}, "nose": [[80, 0, 150]]}})",
    R"({"machine": {"kinematics": {"type": "table"}, "nose": [[1, 2, 3], [4, 5, 6]], "bodies": [
      {"name": "a", "on": "B", "box": [[0, 0, 0], [0, 0, 0]]}, {"name": "a", "on": "C", "mesh": "a/b..c/d.stl"},
      {"name": "c", "cylinder": {"at": [1, 2, 3], "height": 0.1, "diameter": 1e5}, "at": [-1, -2, -3]}]}})",
    R"({"setups": []})",
    R"({"setups": [{"paths": ["*"]}, {"paths": ["a/"], "frame": "machine", "clearance": 0, "resolution": 0.25,
      "stock": {"mesh": "./raw.stl"}, "spoilboard": {"top": -18}, "target": {"mesh": "part.stl"}, "fixtures": [
      {"name": "x", "cylinder": {"at": [0, 0, 0], "axis": [0, -0.1, 0], "height": 1, "diameter": 2}},
      {"name": "y", "box": [[-1, -1, -1], [1, 1, 1]]}]}, {"paths": ["b"], "fixtures": [{"name": "z", "mesh": "z"}],
      "spoilboard": {"top": 0, "allow": 1.5, "area": [[0, 0], [1, 1]]}}]})",
    R"({"lint": {"select": ["iso", "W1", "arc-center-mismatch", "ALL"], "ignore": ["W003"], "severity": {"W": "off"}}})",
    R"({"lint": {"files": [{"paths": ["old/**", "*.tmp.iso", "\\!x"], "ignore": ["ALL"]}, {"paths": ["a..b/"]}]}})",
    R"({"lint": {"extensions": [".iso", "out.nc"], "exclude": ["archive/", "[a-c]?.iso"]}})",
    R"({"lint": {"houseRules": [{"id": "a.B-1_", "require": ["M7", "M08"], "before": ["cut", "rapid", "G27"], "message": "x"},
      {"id": "b", "comment": "*", "before": ["end"], "since": ["toolChange"], "message": {"it": "a", "en": "b"}},
      {"id": "c", "forbid": ["M999", "G200", "M06", "M02"], "severity": "info", "message": "c"},
      {"id": "d", "forbid": ["motion"], "after": ["M70"], "until": ["M71", "M71"], "message": "d"},
      {"id": "e", "head": ["G71", "M3"], "message": "e"}, {"id": "f", "end": ["M5", "M05"], "message": "f"},
      {"id": "g", "speedFrom": 100, "speedTo": 100, "message": "g"}, {"id": "h", "speedTo": 1, "message": "h"},
      {"id": "i", "feedFrom": 0.5e1, "forTools": ["T101001", "T*", "T10200*"], "message": "i"},
      {"id": "j", "feedTo": 9, "message": "j"}, {"id": "k", "lowestZ": 0, "severity": "error", "message": "k"}]}})",
    R"({"format": {"wordOrder": true, "decimals": 3, "gDigits": 2, "modal": "fold", "renumber": {}}})",
    R"({"format": {"renumber": {"start": 0, "step": 5, "allLines": true}}})",
};

/// A configuration with a mistake, and what is said of it in English.
struct WrongText {
  std::string_view text;
  std::string_view said;       ///< `LINE:COLUMN: MESSAGE`, one a line.
  bool schema_rejects = true;  ///< Else it takes more than a schema, or is no JSON.
};

inline constexpr bool kSchemaAccepts = false;

inline constexpr WrongText kWrongTexts[] = {
    // Values that are not what they should be.
    {"[]", "1:1: this is a list [ ], and an object { } is needed"},
    {R"({"machine": 3})", "1:13: machine: this is a number, and an object { } is needed"},
    {"{\"language\":\n  null}", "2:3: language: this is null, and text is needed"},
    {R"({"language": "de"})", "1:14: language: de is not one of en, it"},
    {R"({"machine": {"home": {"x": "1"}}})", "1:28: machine.home.x: this is text, and a number is needed"},
    {R"({"machine": {"home": {"x": 1e7}}})", "1:28: machine.home.x: 10000000 is too large: at most 1000000 mm"},
    {R"({"machine": {"home": {"b": -1e7}}})", "1:28: machine.home.b: -10000000 is too small: at least -100000 degrees"},
    {R"({"machine": {"maxFeed": 0}})", "1:25: machine.maxFeed: 0 is too small: at least 1 mm/min"},
    {R"({"machine": {"axes": {"X": {"rapid": 1e-300}}}})",
     "1:38: machine.axes.X.rapid: 1e-300 is too small: at least 1 mm/min"},
    {R"({"machine": {"axes": {"B": {"acceleration": 0.5}}}})",
     "1:45: machine.axes.B.acceleration: 0.5 is too small: at least 1 degrees/s^2"},
    {R"({"machine": {"tolerances": {"arc": 0, "chord": 1e-300, "corner": 1e-5}}})",
     "1:36: machine.tolerances.arc: 0 is too small: at least 1e-06 mm\n"
     "1:48: machine.tolerances.chord: 1e-300 is too small: at least 0.0001 mm\n"
     "1:66: machine.tolerances.corner: 1e-05 is too small: at least 0.0001 mm"},
    {R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "length": 0}]}})",
     "1:70: machine.tools[0].length: 0 is too small: more than 0 mm"},
    {R"({"machine": {"tools": {}}})", "1:23: machine.tools: this is an object { }, and a list [ ] is needed"},
    {R"({"machine": {"tools": [7]}})", "1:24: machine.tools[0]: this is a number, and an object { } is needed"},
    {R"({"machine": {"tools": [{"head": 1, "holder": 0, "tool": 2.5}]}})",
     "1:46: machine.tools[0].holder: 0 is too small: at least 1\n"
     "1:57: machine.tools[0].tool: 2.5 is not a whole number"},
    {R"({"machine": {"tools": [{"head": 1, "tool": 2, "name": ""}]}})",
     "1:24: machine.tools[0]: the key holder is missing\n1:55: machine.tools[0].name: the text is empty"},
    {R"({"machine": {"functions": {"M5": {}}}})",
     "1:28: machine.functions.M5: M5 is not a user M function: those are M1 and M7 to M999"},
    {R"({"machine": {"functions": {"M100": "a"}}})",
     "1:36: machine.functions.M100: this is text, and an object { } is needed"},
    {R"({"lint": {"select": "W1"}})", "1:21: lint.select: this is text, and a list [ ] is needed"},
    {R"({"lint": {"select": [3, "ISO003,W001"]}})",
     "1:22: lint.select[0]: this is a number, and text is needed\n"
     "1:25: lint.select[1]: there is no code ISO003,W001 (isolint --list-rules)"},
    {R"({"lint": {"severity": {"W001": "fatal"}}})",
     "1:32: lint.severity.W001: fatal is not one of error, warning, info, off"},
    {R"({"lint": {"severity": {"W001": 2, "W002": "off"}}})",
     "1:32: lint.severity.W001: this is a number, and text is needed"},
    {R"({"lint": {"files": [{"ignore": []}]}})", "1:21: lint.files[0]: the key paths is missing"},
    {R"({"lint": {"exclude": ["!a", ""]}})",
     "1:23: lint.exclude[0]: !a: a ! means nothing here; write \\! for a name that starts with it\n"
     "1:29: lint.exclude[1]:  is not a path pattern"},
    {R"({"lint": {"exclude": ["../old/", "a/.."]}})",
     "1:23: lint.exclude[0]: ../old/: this file counts only for programs in its folder, or below\n"
     "1:34: lint.exclude[1]: a/..: this file counts only for programs in its folder, or below"},
    {R"({"lint": {"files": [{"paths": []}], "extensions": []}})",
     "1:31: lint.files[0].paths: the list is empty\n1:51: lint.extensions: the list is empty"},
    {R"({"lint": {"extensions": ["*.iso", "."]}})",
     "1:26: lint.extensions[0]: *.iso is not an extension, such as .iso\n"
     "1:35: lint.extensions[1]: . is not an extension, such as .iso"},
    // House rules.
    {R"({"lint": {"houseRules": [{"require": ["M08"]}]}})",
     "1:26: lint.houseRules[0]: the key id is missing\n1:26: lint.houseRules[0]: the key message is missing"},
    {R"({"lint": {"houseRules": [{"id": "a b", "message": 3, "head": []}]}})",
     "1:33: lint.houseRules[0].id: a b: the id of a rule has letters, digits, - . and _ only\n"
     "1:51: lint.houseRules[0].message: this is a number, and text, or an object with it and en is needed\n"
     "1:62: lint.houseRules[0].head: the list is empty"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": {"en": "x", "de": "y"}, "head": ["M5"]}]}})",
     "1:49: lint.houseRules[0].message: the key it is missing\n1:61: lint.houseRules[0].message.de: unknown key"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": {"en": "", "it": 4, "en": "z"}, "head": ["M5"]}]}})",
     "1:56: lint.houseRules[0].message.en: the text is empty\n"
     "1:66: lint.houseRules[0].message.it: this is a number, and text is needed\n"
     "1:69: lint.houseRules[0].message.en: this key stands on line 1 already"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "severity": "off", "head": ["cut", "G999"]}]}})",
     "1:66: lint.houseRules[0].severity: off is not one of error, warning, info\n"
     "1:82: lint.houseRules[0].head[0]: cut is no M such as M05 and no G such as G90\n"
     "1:89: lint.houseRules[0].head[1]: G999 is no M such as M05 and no G such as G90"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "forbid": ["toolchange", "M1000", ""]}]}})",
     "1:65: lint.houseRules[0].forbid[0]: toolchange is none of what a rule can name: an M such as M08, a G such as "
     "G90, "
     "toolChange, motion, rapid, cut, end; did you mean toolChange?\n"
     "1:79: lint.houseRules[0].forbid[1]: M1000 is none of what a rule can name: an M such as M08, a G such as G90, "
     "toolChange, motion, rapid, cut, end\n"
     "1:88: lint.houseRules[0].forbid[2]: the text is empty"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "forbid": ["G00", "G01", "M00", "M08"]}]}})",
     "1:65: lint.houseRules[0].forbid[0]: G00 is a motion: name it motion, rapid or cut\n"
     "1:72: lint.houseRules[0].forbid[1]: G01 is a motion: name it motion, rapid or cut\n"
     "1:79: lint.houseRules[0].forbid[2]: M00 is none of what a rule can name: an M such as M08, a G such as G90, "
     "toolChange, motion, rapid, cut, end",
     kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "lowestZ": 0, "forTools": ["101001", "T1234567", "T*1"]}]}})",
     "1:81: lint.houseRules[0].forTools[0]: 101001 is no tool: T with six digits, or with fewer and a *, as in T101*\n"
     "1:91: lint.houseRules[0].forTools[1]: T1234567 is no tool: T with six digits, or with fewer and a *, as in "
     "T101*\n"
     "1:103: lint.houseRules[0].forTools[2]: T*1 is no tool: T with six digits, or with fewer and a *, as in T101*"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "speedTo": 0, "require": ["M08"]}]}})",
     "1:65: lint.houseRules[0].speedTo: 0 is too small: at least 1 rev/min"},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "require": ["M08"]}]}})",
     "1:65: lint.houseRules[0].require: this needs the key before", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a"}]}})",
     "1:26: lint.houseRules[0]: one of require, forbid, comment, head, end, speedFrom, speedTo, feedFrom, feedTo and "
     "lowestZ is needed",
     kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "head": ["M05"], "feedTo": 9}]}})",
     "1:81: lint.houseRules[0].feedTo: there is head already; a rule has one pattern", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "head": ["M05"], "since": ["cut"]}]}})",
     "1:80: lint.houseRules[0].since: only a rule with require, comment has this", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "forbid": ["M05"], "forTools": ["T*"]}]}})",
     "1:85: lint.houseRules[0].forTools: only a rule with speedFrom, speedTo, feedFrom, feedTo, lowestZ has this",
     kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "forbid": ["M05"], "until": ["M06"]}]}})",
     "1:82: lint.houseRules[0].until: this needs the key after", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "forbid": ["M05", "cut"]}]}})",
     "1:72: lint.houseRules[0].forbid[1]: cut can be forbidden only with the key after", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "require": ["M8", "M3"], "before": ["M03"]}]}})",
     "1:72: lint.houseRules[0].require[1]: M3 stands in before, too, so that the rule says nothing", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "speedFrom": 9, "speedTo": 8}]}})",
     "1:67: lint.houseRules[0].speedFrom: 9 is more than 8", kSchemaAccepts},
    {R"({"lint": {"houseRules": [{"id": "a", "message": "a", "head": ["M05"]}, {"id": "a", "message": "b", "end": ["M05"]}]}})",
     "1:79: lint.houseRules[1].id: a rule before this has the same id", kSchemaAccepts},
    {R"({"format": {"wordOrder": 1}})", "1:26: format.wordOrder: this is a number, and true or false is needed"},
    {R"({"format": {"decimals": 16, "gDigits": 3}})",
     "1:25: format.decimals: 16 is too large: at most 15\n1:40: format.gDigits: 3 is too large: at most 2"},
    {R"({"format": {"modal": "folded"}})",
     "1:22: format.modal: folded is not one of keep, write, fold; did you mean fold?"},
    {R"({"format": {"renumber": {"step": 0}}})", "1:34: format.renumber.step: 0 is too small: at least 1"},
    // Keys.
    {R"({"lintt": {}})", "1:2: lintt: unknown key; did you mean lint?"},
    {R"({"machine": {"axes": {"A": {}}}})", "1:23: machine.axes.A: unknown key"},
    {R"({"machine": {"axes": {"x": {}}}})", "1:23: machine.axes.x: unknown key; did you mean X?"},
    {R"({"machine": {"axes": {"X": {"acc": 1}}}})",
     "1:29: machine.axes.X.acc: unknown key; did you mean acceleration?"},
    {R"({"machine": {"axes": {"X": {"ac": 1}}}})", "1:29: machine.axes.X.ac: unknown key"},
    {R"({"arc": 0.1})", "1:2: arc: unknown key; did you mean machine.tolerances.arc?"},
    {R"({"machine": {"functions": {"M100": {"nam": "a"}}}})",
     "1:37: machine.functions.M100.nam: unknown key; did you mean name?"},
    {"{\"lint\": {},\n\"lint\": {}}", "2:1: lint: this key stands on line 1 already", kSchemaAccepts},
    {"{\"machine\": {\"functions\": {\"M100\": {},\n \"M100\": {}}}}",
     "2:2: machine.functions.M100: this key stands on line 1 already", kSchemaAccepts},
    {R"({"lint": {"severity": {"W1": "off", "W1": "off"}}})",
     "1:37: lint.severity.W1: this key stands on line 1 already", kSchemaAccepts},
    // What takes two values.
    {R"({"machine": {"axes": {"Z": {"max": -1, "min": 0}}}})", "1:36: machine.axes.Z.max: min is more than max",
     kSchemaAccepts},
    {R"({"machine": {"tools": [{"head": 1, "holder": 2, "tool": 3}, {"tool": 3, "head": 1, "holder": 2}]}})",
     "1:61: machine.tools[1]: this tool is listed already", kSchemaAccepts},
    {R"({"machine": {"functions": {"M7": {}, "M07": {}}}})", "1:45: machine.functions.M07: this M is named already",
     kSchemaAccepts},
    // Bodies: what a schema knows.
    {R"({"machine": {"nose": 5, "holders": []}})",
     "1:22: machine.nose: this is a number, and a list [ ] is needed\n"
     "1:36: machine.holders: this is a list [ ], and an object { } is needed"},
    {R"({"machine": {"nose": [], "holders": {"a": 1, "b": [[1, 2]]}}})",
     "1:22: machine.nose: the list is empty\n1:43: machine.holders.a: this is a number, and a list [ ] is needed\n"
     "1:52: machine.holders.b[0]: 3 numbers are needed here: height, lower diameter, upper diameter"},
    {R"({"machine": {"nose": [7, [1, "2", 3], [0, -1, 1e5]]}})",
     "1:23: machine.nose[0]: this is a number, and a list [ ] is needed\n"
     "1:30: machine.nose[1][1]: this is text, and a number is needed\n"
     "1:40: machine.nose[2][0]: 0 is too small: more than 0 mm\n"
     "1:43: machine.nose[2][1]: -1 is too small: at least 0 mm\n"
     "1:47: machine.nose[2][2]: 100000 is too large: at most 10000 mm"},
    {R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "shape": "round", "shank": -4, "tipAngle": 180}]}})",
     "1:69: machine.tools[0].shape: round is not one of flat, ball, bull, cone, drill, disc\n"
     "1:87: machine.tools[0].shank: -4 is too small: more than 0 mm\n"
     "1:103: machine.tools[0].tipAngle: 180 is too large: at most 179 degrees"},
    {R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "profile": [[0, -1]], "maxDepth": 0, "body": ""}]}})",
     "1:76: machine.tools[0].profile[0][1]: -1 is too small: at least 0 mm\n"
     "1:94: machine.tools[0].maxDepth: 0 is too small: more than 0 mm\n"
     "1:105: machine.tools[0].body: the text is empty"},
    {R"({"machine": {"bodies": [{"on": "A", "box": [[0, 0, 0]]}]}})",
     "1:25: machine.bodies[0]: the key name is missing\n1:32: machine.bodies[0].on: A is not one of machine, X, Y, Z, "
     "C, B\n1:44: machine.bodies[0].box: 2 rows are needed here"},
    {R"({"setups": [{"fixtures": [{"name": "a", "cylinder": {"at": [1, 2], "height": 0}}], "frame": "table"}]})",
     "1:13: setups[0]: the key paths is missing\n"
     "1:53: setups[0].fixtures[0].cylinder: the key diameter is missing\n"
     "1:60: setups[0].fixtures[0].cylinder.at: 3 numbers are needed here: x, y, z\n"
     "1:78: setups[0].fixtures[0].cylinder.height: 0 is too small: more than 0 mm\n"
     "1:93: setups[0].frame: table is not one of workpiece, machine"},
    {R"({"setups": [{"paths": ["a"], "target": {}, "spoilboard": {"allow": -1}, "fixture": [], "clearance": -1}]})",
     "1:40: setups[0].target: the key mesh is missing\n1:58: setups[0].spoilboard: the key top is missing\n"
     "1:68: setups[0].spoilboard.allow: -1 is too small: at least 0 mm\n"
     "1:73: setups[0].fixture: unknown key; did you mean fixtures?\n"
     "1:101: setups[0].clearance: -1 is too small: at least 0 mm"},
    {R"({"setups": [{"paths": ["a"], "target": {"mesh": "../a.stl"}, "stock": {"mesh": "/a.stl"}}]})",
     "1:49: setups[0].target.mesh: ../a.stl: the file must be in the folder of this file, or below\n"
     "1:80: setups[0].stock.mesh: /a.stl: the file must be in the folder of this file, or below"},
    {R"({"setups": [{"paths": ["a"], "target": {"mesh": "a\\..\\..\\b"}, "stock": {"mesh": "C:a.stl"}}]})",
     "1:49: setups[0].target.mesh: a\\..\\..\\b: the file must be in the folder of this file, or below\n"
     "1:84: setups[0].stock.mesh: C:a.stl: the file must be in the folder of this file, or below"},
    {R"({"setups": [{"paths": ["a"], "target": {"mesh": ".."}, "stock": {"mesh": ""}}]})",
     "1:49: setups[0].target.mesh: ..: the file must be in the folder of this file, or below\n"
     "1:74: setups[0].stock.mesh: the text is empty"},
    // Bodies: what takes several values.
    {R"({"machine": {"nose": [[5, 0, 0]], "holders": {"a": [[5, 0, 0]]}}})",
     "1:22: machine.nose: these rows enclose nothing\n1:52: machine.holders.a: these rows enclose nothing",
     kSchemaAccepts},
    {R"({"machine": {"bodies": [{"name": "a"}, {"name": "b", "box": [[0, 0, 0], [1, -1, 1]]}]}})",
     "1:25: machine.bodies[0]: one of box, cylinder and mesh is needed\n"
     "1:77: machine.bodies[1].box[1][1]: -1 is less than 0 of the lower corner",
     kSchemaAccepts},
    {R"({"machine": {"bodies": [{"name": "a", "mesh": "a.stl", "box": [[0, 0, 0], [1, 1, 1]]}]}})",
     "1:47: machine.bodies[0].mesh: there is box already; one of them is enough", kSchemaAccepts},
    {R"({"machine": {"bodies": [{"name": "a", "on": "B", "mesh": "a.stl"}], "kinematics": {"type": "three-axis"}}})",
     "1:45: machine.bodies[0].on: a machine with three axes has no B", kSchemaAccepts},
    {R"({"setups": [{"paths": ["a"], "stock": {}, "spoilboard": {"top": 0, "area": [[0, 5], [1, 4]]}}]})",
     "1:39: setups[0].stock: one of box, cylinder, mesh and from is needed\n"
     "1:89: setups[0].spoilboard.area[1][1]: 4 is less than 5 of the lower corner",
     kSchemaAccepts},
    {R"({"setups": [{"paths": ["a"], "stock": {"cylinder": {"at": [0, 0, 0], "axis": [0, 0, 0], "height": 1,
    "diameter": 1}}}]})",
     "1:78: setups[0].stock.cylinder.axis: a direction without a length", kSchemaAccepts},
    // What only the table of codes, and the reader of patterns, knows.
    {R"({"lint": {"ignore": ["ISO31"]}})",
     "1:22: lint.ignore[0]: there is no code ISO31 (isolint --list-rules); did you mean ISO031?", kSchemaAccepts},
    {R"({"lint": {"exclude": ["a[", "/"]}})",
     "1:23: lint.exclude[0]: a[ is not a path pattern\n1:29: lint.exclude[1]: / is not a path pattern", kSchemaAccepts},
    // What is no JSON.
    {"", "1:1: the file ends here, but a bracket is still open or a value missing", kSchemaAccepts},
    {"{\n  \"lint\": {\n", "3:1: the file ends here, but a bracket is still open or a value missing", kSchemaAccepts},
    {R"({"lint": {}, // one, two
})",
     "2:1: there is a comma before this }, with nothing after it", kSchemaAccepts},
    {R"({"lint" {}})", "1:9: { is out of place here", kSchemaAccepts},
    {R"({"lint":: {}})", "1:9: : is out of place here", kSchemaAccepts},
    {R"({lint: {}})", "1:2: lint is out of place here", kSchemaAccepts},
    {R"({} {})", "1:4: nothing may follow the end of the configuration", kSchemaAccepts},
    {"{\"language\": \"en\n\"}", "1:14: a text without its closing quote", kSchemaAccepts},
    {"{\"language\": \"e\tn\"}", "1:14: a tab within a text; write \\t", kSchemaAccepts},
    {R"({"language": "C:\iso"})", "1:14: a backslash that JSON does not know; write \\\\ for a backslash",
     kSchemaAccepts},
    {R"({"machine": {"maxFeed": 1e999}})", "1:25: a number that is too large", kSchemaAccepts},
    {R"({"machine": {"maxFeed": 01}})", "1:26: 1 is out of place here", kSchemaAccepts},
    {R"({"machine": {"maxFeed": 1.}})", "1:25: not a number as JSON writes it", kSchemaAccepts},
    {R"({"machine": {"maxFeed": NaN}})", "1:25: NaN is out of place here", kSchemaAccepts},
    {"{ /* ", "1:3: a comment without its end", kSchemaAccepts},
    {"{ # }", "1:3: # is out of place here", kSchemaAccepts},
    {"{ / }", "1:3: a comment starts with // or /*", kSchemaAccepts},
    {"{} // \xC3\xA8 \xE8", "1:9: this is not UTF-8; save the file as UTF-8", kSchemaAccepts},
    {"{}\r\n\x01", "2:1: a control character, where only text may stand", kSchemaAccepts},
};

}  // namespace isocnc::configuration
