#!/usr/bin/env python3
"""The post-processor for FreeCAD (posts/freecad), on commands that FreeCAD has computed (tests/posts/jobs) and on random ones.

usage: freecad_post_test.py FOLDER_OF_PROGRAMS. Needs no FreeCAD; freecad_test.py makes the jobs anew with it.
"""

import json
import math
import random
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "posts/freecad"))
sys.dont_write_bytecode = True

import events  # noqa: E402
import isocnc_post  # noqa: E402
from freecad_path import FreeCadPath  # noqa: E402

JOBS = sorted((HERE / "jobs").glob("*.json"))
ORIGIN = (350.0, 220.0, -180.0)
USUAL = "--origin 350,220,-180 --head 1 --holder 1"
DIGIT = {"mm": 1e-3, "in": 25.4e-4}

programs = Path()


def post(commands, arguments=USUAL, tool=3, **others):
    """Posts an operation after a tool change and a start of the spindle."""
    start = [["M6", {"T": tool}], ["M3", {"S": 12000}], ["G0", {"X": 0, "Y": 0, "Z": 20}]]
    data = {"operations": [{"label": "test", "commands": start + commands, **others}]}
    return isocnc_post.post(isocnc_post.operations_of_json(data), isocnc_post.parse_options(arguments))


def findings_of(texts):
    """Of isolint, with what the machine shows."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in texts.items():
            (Path(folder) / f"{name}.iso").write_text(text, encoding="utf-8")
        run = subprocess.run(
            [programs / "isolint", "--no-config", "--lang", "en", "--verify", "--format", "concise", folder],
            capture_output=True, text=True, timeout=60, check=False,
        )
    return run.stdout + run.stderr


def tools_of(arguments):
    options = isocnc_post.parse_options(arguments)
    return {number: options.tools.get(number, f"{options.head}{options.holder or 0:02}{number:03}") for number in range(1000)}


def path_of(job):
    """What FreeCAD's commands do, by our own evaluation."""
    options = isocnc_post.parse_options(job["arguments"])
    return FreeCadPath({"G54": options.fixtures["G54"]}, tools_of(job["arguments"]), options.safe_z).run(job["operations"])


class Jobs(unittest.TestCase):
    """What FreeCAD computed for real jobs."""

    def texts(self, more=""):
        for path in JOBS:
            data = json.loads(path.read_text())
            arguments = f"{data['arguments']} {more}"
            operations = isocnc_post.operations_of_json(data)
            yield path.stem, data, arguments, isocnc_post.post(operations, isocnc_post.parse_options(arguments))

    def test_all_kinds_are_there(self):
        self.assertEqual(
            [path.stem for path in JOBS], ["drilling", "engraving", "faces", "helix", "pocket", "profile", "ramp", "surface"]
        )

    def test_isolint_finds_nothing(self):
        for more in ("", "--modal --axis-modal --line-numbers", "--inches", "--arcs radius --home 0,0,0", "--faces g28"):
            with self.subTest(more):
                self.assertEqual(findings_of({name: text for name, _, _, text in self.texts(more)}), "")

    def test_the_path_is_that_of_freecad(self):
        for more in ("", "--modal --axis-modal --line-numbers --no-comments", "--inches", "--arcs radius", "--precision 5", "--faces g28"):
            unit = 1.5 * DIGIT["in" if "inches" in more else "mm"] * (0.01 if "5" in more else 1)
            for name, data, arguments, text in self.texts(more):
                with self.subTest(name, more=more):
                    expected = path_of(data)
                    found = events.of_program(programs / "isorun", text)
                    self.assertGreater(len(found), 20)
                    self.assertEqual(events.difference(expected, found, unit), "")

    def test_the_comparison_notices_a_hundredth(self):
        name, data, arguments, text = next(self.texts())
        path = FreeCadPath({"G54": (350.01, 220.0, -180.0)}, tools_of(arguments))
        found = events.of_program(programs / "isorun", text)
        self.assertIn("expected", events.difference(path.run(data["operations"]), found, 1.5e-3))


class RandomCommands(unittest.TestCase):
    """All commands in all modes, with arcs that rounding could turn into others."""

    def commands(self, rng):
        commands, at, plane, relative = [], [0.0, 0.0, 20.0], 17, False
        for _ in range(rng.randint(5, 25)):
            kind = rng.choice(["line", "line", "rapid", "arc", "arc", "arc", "tiny", "plane", "mode", "drill", "dwell", "turn"])
            if kind == "plane":
                plane = rng.choice([17, 18, 19])
                commands.append([f"G{plane}", {}])
            elif kind == "mode":
                relative = not relative
                commands.append(["G91" if relative else "G90", {}])
            elif kind == "dwell":
                commands.append(["G4", {"P": rng.choice([0.25, 1.0, 2.5])}])
            elif kind in ("line", "rapid", "turn"):
                end = [rng.uniform(-80, 80) for _ in range(3)]
                words = self.words(at, end, relative)
                if kind == "turn":
                    words["B"] = 0.0 if relative else rng.uniform(0, 60)
                commands.append(["G0" if kind == "rapid" else "G1", words | ({"F": rng.choice([5, 20, 33.333333])} if kind != "rapid" else {})])
                at = end
            elif kind in ("arc", "tiny"):
                words, at, code = self.arc(rng, at, plane, relative, kind == "tiny")
                commands.append([f"G{code}", words | {"F": 12.5}])
            elif plane == 17 and not relative:
                code = rng.choice([73, 81, 82, 83, 85, 89])
                top = rng.uniform(-5, 30)
                words = {"X": rng.uniform(-50, 50), "Y": rng.uniform(-50, 50), "Z": top - rng.uniform(2, 30), "R": top, "F": 4}
                words |= {"Q": rng.uniform(1.5, 12)} if code in (73, 83) else {}
                words |= {"P": 0.5} if code in (82, 89) else {}
                words |= {"L": 2} if rng.random() < 0.2 else {}
                level = rng.choice([98, 99])
                commands += [[f"G{level}", {}], [f"G{code}", words], ["G80", {}]]
                at = [words["X"], words["Y"], max(at[2], top) if level == 98 else top]
        return commands

    def words(self, at, end, relative):
        return {axis: value - (old if relative else 0.0) for axis, value, old in zip("XYZ", end, at)}

    def arc(self, rng, at, plane, relative, tiny):
        u, v, w = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}[plane]
        code = rng.choice([2, 3])
        radius = 10 ** rng.uniform(-3.5, 0) if tiny else 10 ** rng.uniform(0, 3)
        sweep = rng.choice([math.tau, rng.uniform(1e-6, 1e-3), math.tau - rng.uniform(1e-6, 1e-3), rng.uniform(0.01, 6.27), math.pi])
        angle = rng.uniform(0, math.tau)
        center = (at[u] - radius * math.cos(angle), at[v] - radius * math.sin(angle))
        last = angle + (sweep if code == 3 else -sweep)
        end = list(at)
        if sweep != math.tau:
            end[u], end[v] = center[0] + radius * math.cos(last), center[1] + radius * math.sin(last)
        end[w] += rng.choice([0.0, rng.uniform(-5, 5)])
        words = self.words(at, end, relative)
        if 0.1 < sweep < 6.1 and abs(sweep - math.pi) > 0.3 and rng.random() < 0.3:
            return words | {"R": radius if sweep < math.pi else -radius}, end, code
        return words | {"IJK"[u]: center[0] - at[u], "IJK"[v]: center[1] - at[v]}, end, code

    def test_the_path_is_the_same(self):
        rng = random.Random(24)
        texts = {}
        for number in range(80):
            commands = self.commands(rng)
            more = rng.choice(["", "--inches --precision 5", "--modal --axis-modal", "--arcs radius", "--peck-clearance 1"])
            arguments = f"{USUAL} {more}"
            with self.subTest(number, more=more, commands=commands):
                text = post(commands, arguments)
                texts[f"random{number}"] = text
                start = [["M6", {"T": 3}], ["M3", {"S": 12000}], ["G0", {"X": 0, "Y": 0, "Z": 20}]]
                path = FreeCadPath({"G54": ORIGIN}, tools_of(arguments), peck_clearance=1 if "peck" in more else 0.25)
                expected = path.run([{"commands": start + commands}])
                found = events.of_program(programs / "isorun", text)
                wrong = self.difference(expected, found, 25.4e-5 if "inches" in more else 1e-3)
                self.assertFalse(wrong, wrong)
        self.assertEqual(findings_of(texts), "")

    def test_an_almost_full_turn_stays_one(self):
        """By rounding, its end comes to lie beyond its start."""
        x, y = 0.6506801375236995, -0.42249922666079853
        words = {"X": 0.6513692120051188, "Y": -0.4225006951554523, "I": 0.6513326748481623 - x, "J": -0.2779744105790547 - y}
        commands = [["G1", {"X": x, "Y": y, "F": 5}], ["G2", words]]
        text = post(commands)
        self.assertEqual(len(re.findall("^G02", text, re.MULTILINE)), 2, text)
        start = [["M6", {"T": 3}], ["M3", {"S": 12000}], ["G0", {"X": 0, "Y": 0, "Z": 20}]]
        expected = FreeCadPath({"G54": ORIGIN}, tools_of(USUAL)).run([{"commands": start + commands}])
        wrong = self.difference(expected, events.of_program(programs / "isorun", text), 1e-3)
        self.assertFalse(wrong, wrong)

    def test_fixtures_and_absolute_centers(self):
        commands = [
            ["G55", {}], ["G2", {"X": 0, "Y": 0, "I": 5, "J": 5, "F": 5}], ["G91", {}], ["G1", {"X": 3, "Z": -1, "F": 5}], ["G90", {}],
            ["G90.1", {}], ["G1", {"X": 10, "Y": 20}], ["G3", {"X": 20, "Y": 10, "J": 20, "I": 20}], ["G2", {"X": 40, "Y": 10, "I": 30}], ["G3", {"X": 40, "Y": 30, "J": 20}],
            ["G91.1", {}], ["G54", {}], ["G1", {"X": 1, "Y": 1, "Z": 1}], ["G3", {"X": 3, "Y": 1, "I": 1}],
        ]
        arguments = USUAL + " --fixture G55=300,200,-150"
        with self.assertRaisesRegex(isocnc_post.PostError, "no arc"):
            post(commands, arguments)  # Its start is elsewhere in G55.
        del commands[1]
        start = [["M6", {"T": 3}], ["M3", {"S": 12000}], ["G0", {"X": 0, "Y": 0, "Z": 20}]]
        path = FreeCadPath({"G54": ORIGIN, "G55": (300.0, 200.0, -150.0)}, tools_of(USUAL))
        expected = path.run([{"commands": start + commands}])
        wrong = events.difference(expected, events.of_program(programs / "isorun", post(commands, arguments)), 1.5e-3)
        self.assertFalse(wrong, wrong)

    def difference(self, expected, found, digit):
        """By the path alone where arcs are so small that they were written as lines, and near-full ones as two."""
        return events.difference(*(events.joined(each, 8 * digit) for each in (expected, found)), 3 * digit)


class Refused(unittest.TestCase):
    """What cannot be said is an exception that names the operation, the command and the reason."""

    CASES = [
        ([["G43", {"H": 1}]], "lengths of its tools"),
        ([["G1", {"X": 1, "A": 30, "F": 5}]], "A is no axis"),
        ([["G1", {"X": 1, "U": 30, "F": 5}]], "U has no meaning"),
        ([["G1", {"X": 1}]], "no feed so far"),
        ([["G1", {"X": 1, "F": -1}]], "not negative"),
        ([["G1", {"X": math.nan, "F": 5}]], "not a number"),
        ([["G2", {"X": 10, "Y": 0, "I": 4, "J": 0, "F": 5}]], "no arc"),
        ([["G2", {"X": 10, "Y": 0, "F": 5}]], "neither center nor radius"),
        ([["G2", {"X": 10, "Y": 0, "R": 4, "F": 5}]], "too small"),
        ([["G2", {"X": 0, "Y": 0, "R": 4, "F": 5}]], "full turn"),
        ([["G3", {"X": 0, "I": 5, "P": 3, "F": 5}]], "more than one turn"),
        ([["G84", {"X": 0, "Z": -5, "R": 2, "F": 5}]], "tapping"),
        ([["G76", {}]], "cycle has no counterpart"),
        ([["G81", {"X": 0, "R": 2, "F": 5}]], "no Z"),
        ([["G81", {"X": 0, "Z": 3, "R": 2, "F": 5}]], "ends above R"),
        ([["G83", {"X": 0, "Z": -3, "R": 2, "Q": 0, "F": 5}]], "no Q"),
        ([["G83", {"X": 0, "Z": -3, "R": 2, "Q": 1, "P": 1, "F": 5}]], "P has no meaning"),
        ([["G73", {"X": 0, "Z": -3, "R": 2, "Q": 1e-9, "F": 5}]], "more than 1000 pecks"),
        ([["G81", {"X": 0, "Z": -3, "R": 2, "L": 2.5, "F": 5}]], "L is from 1 to 100"),
        ([["G81", {"X": 0, "Z": -3, "R": 2, "L": 1e9, "F": 5}]], "L is from 1 to 100"),
        ([["G91", {}], ["G81", {"X": 0, "Z": -3, "R": 2, "F": 5}]], "only in G90"),
        ([["G20", {}]], "--inches"),
        ([["G28", {}]], "--home"),
        ([["G41", {"D": 1}]], "compensate"),
        ([["G53", {}]], "machine coordinates"),
        ([["G92", {"X": 0}]], "--fixture"),
        ([["G93", {}]], "mm/min"),
        ([["G38.2", {"Z": -5}]], "no probing"),
        ([["G55", {}]], "--fixture G55=X,Y,Z"),
        ([["G4", {"P": -1}]], "not negative"),
        ([["M0", {}]], "--stop"),
        ([["M30", {}]], "ends after its last operation"),
        ([["M98", {"P": 3}]], "P has no meaning"),
        ([["M3", {}], ["M6", {"T": 1000}]], "from 1 to 999"),
        ([["M3", {"S": 0}]], "without a speed"),
        ([["G29", {"B": 95}], ["G0", {"X": 0, "Y": 0, "Z": 5}]], "B from -90 to 90"),
        ([["G29", {"B": 90}], ["G0", {"X": 0, "Y": 0, "Z": 5}]], "--safe-z"),
        ([["G24", {"A": 1, "J": 1, "R": -1}]], "right-handed"),
        ([["G24", {"A": 1, "J": 1}]], "versors"),
        ([["O100", {}]], "not known"),
        ([["M3.5", {}]], "not known"),
    ]

    def test_each_has_its_reason(self):
        for commands, reason in self.CASES:
            with self.subTest(commands):
                with self.assertRaises(isocnc_post.PostError) as raised:
                    post(commands)
                self.assertIn(reason, str(raised.exception))
                self.assertTrue(str(raised.exception).startswith("test, command "))

    def test_bad_arguments(self):
        for arguments, reason in (
            ("--origin 1,2", "not X,Y,Z"), ("--origin nan,1,2", "not X,Y,Z"), ("--precision 2", "from 3 to 9"),
            ("--inches --precision 3", "from 4 to 9"), ("--tool 3=12", "not like 3=102003"), ("--head 1", "belong together"),
            ("--head 10 --holder 1", "from 1 to 9"), ("--flood M03", "no M function of the shop"), ("--fixture G53=1,2,3", "not like"),
            ("--preamble 'G17 G91'", "G91 would change"), ("--postamble 'G70'", "G70 would change"), ("--unknown", "unrecognized"),
            ("--origin '", "quotation"), ("--peck-clearance -1", "not a length"),
        ):
            with self.subTest(arguments), self.assertRaises(isocnc_post.PostError) as raised:
                isocnc_post.parse_options(arguments)
            self.assertIn(reason, str(raised.exception))

    def test_files_that_are_no_jobs(self):
        face = {"origin": [0, 0, 0], "i": [1, 0, 0], "j": [0, 1, 0], "k": [0, 0, 1]}
        operation = {"label": "x", "commands": []}
        for data in (
            [], 3, None, {}, {"operations": 3}, {"operations": [3]}, {"operations": [{"label": "x"}]},
            {"operations": [{"commands": [["G0"]]}]}, {"operations": [{"commands": [["G0", {"X": "a"}]]}]}, {"operations": [{"commands": [["G0", 3]]}]},
            {"operations": [operation | {"face": {"origin": [0, 0, 0]}}]}, {"operations": [operation | {"face": face | {"k": [0, 0]}}]},
            {"operations": [operation | {"face": face | {"k": [0, 0, math.inf]}}]}, {"operations": [operation | {"face": face | {"k": [0, 0, 0]}}]},
            {"operations": [operation | {"face": face | {"k": [0, 0, -1]}}]}, {"operations": [operation | {"face": 3}]},
        ):
            with self.subTest(data), self.assertRaises(isocnc_post.PostError):
                isocnc_post.operations_of_json(data)
        with self.assertRaisesRegex(isocnc_post.PostError, "only Flood and Mist"):
            post([], coolant=["Flood"])
        with tempfile.TemporaryDirectory() as folder:
            for text in ("{", "[" * 100000, "\x00\xff", ""):
                file = Path(folder) / "job.json"
                file.write_bytes(text.encode("latin-1"))
                run = subprocess.run(
                    [sys.executable, ROOT / "posts/freecad/isocnc_post.py", file], capture_output=True, text=True, check=False
                )
                self.assertEqual((run.returncode, run.stdout), (1, ""), run.stderr)
                self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_nothing_is_guessed(self):
        with self.assertRaisesRegex(isocnc_post.PostError, "where G54 lies on the machine is not known"):
            post([], "--head 1 --holder 1")
        with self.assertRaisesRegex(isocnc_post.PostError, "tool 3 has no T: give --tool 3=102003"):
            post([], "--origin 1,2,3")
        with self.assertRaisesRegex(isocnc_post.PostError, "before the first tool change"):
            isocnc_post.post([isocnc_post.Operation("x", [("G1", {"X": 1.0, "F": 1.0})])], isocnc_post.parse_options(USUAL))

    def test_two_tools_at_one_place(self):
        change = [["M6", {"T": 2}], ["M3", {"S": 5000}], ["G0", {"X": 5, "Y": 5, "Z": 20}]]
        for more in ("--tool 3=101002", "--tool 3=102003 --tool 2=102003"):
            with self.subTest(more), self.assertRaisesRegex(isocnc_post.PostError, r"tools 3 and 2 are both at T10\d00\d"):
                post(change, f"{USUAL} {more}")
        self.assertIn("M06 T101002", post(change))
        self.assertEqual(post([["M6", {"T": 3}]]).count("M06"), 1)
        self.assertEqual(post([["M6", {"T": 8}], ["M6", {"T": 9}]], USUAL + " --tool 8=000000 --tool 9=000000").count("M06"), 2)

    def test_a_file_is_written_whole_or_not_at_all(self):
        class Item:
            Label = "bad"

            class Path:
                Commands = [type("Command", (), {"Name": "G43", "Parameters": {"H": 1.0}})]

        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "part.iso"
            file.write_text("before")
            with self.assertRaises(isocnc_post.PostError):
                isocnc_post.export([Item], str(file), USUAL)
            self.assertEqual(file.read_text(), "before")


class Options(unittest.TestCase):
    def test_functions_of_the_shop(self):
        text = post([["M8", {}], ["M0", {}], ["M120", {}]], USUAL + " --flood 'M101 P1=1' --coolant-off M102 --stop 50", coolant="Flood")
        self.assertEqual(re.findall(r"^M(?!0[2356]).*", text, re.MULTILINE), ["M101 P1=1", "M101 P1=1", "M50", "M120", "M102"])
        text = post([["G0", {"Z": 1}]], USUAL + " --flood none --coolant-off none", coolant="Flood")
        self.assertEqual(re.findall(r"M0[^2356]", text), [])

    def test_own_head_and_end(self):
        text = post([], USUAL + r" --preamble '(mine)\nG17 G71 G90' --postamble 'M05\nG200' --line-numbers")
        self.assertTrue(text.startswith("N10 (mine)\nN20 G17 G71 G90\n"))
        self.assertRegex(text, r"N\d+ M05\nN\d+ G200\nN\d+ M02\n$")

    def test_comments(self):
        self.assertIn("(depth [5] è 3)", post([["(depth (5)\nè 3)", {}]]))
        self.assertNotIn("(", post([["(text)", {}]], USUAL + " --no-comments"))

    def test_a_fixture_is_a_g92(self):
        text = post([["G55", {}], ["G0", {"X": 5, "Y": 5, "Z": 20}]], USUAL + " --fixture G55=10,20,-5")
        self.assertIn("G92 X10 Y20 Z-5\nG00 X5 Y5 Z20\n", text)
        self.assertNotIn("G92", post([], "--origin machine --head 1 --holder 1"))

    def test_half_the_rise_of_a_helix_is_no_center(self):
        text = post([["G3", {"X": 10, "Y": 0, "Z": 10, "I": 5, "J": 0, "K": -5, "F": 5}]])
        self.assertIn("G03 X10 Y0 Z10 I5 J0 F300\n", text)

    def test_home_is_reached_from_above(self):
        text = post([], USUAL + " --home 0,10,-20")
        self.assertTrue(text.endswith("M05\nG92 X0 Y0 Z0\nG00 Z-20\nG00 X0 Y10\nM02\n"), text)

    def test_nothing_moves_without_a_tool(self):
        text = isocnc_post.post([], isocnc_post.parse_options(USUAL + " --home 0,0,0"))
        self.assertEqual(text, "G17 G71 G90 G94\nM02\n")
        self.assertEqual(findings_of({"empty": text}), "")

    def test_the_command_without_freecad(self):
        job = HERE / "jobs/pocket.json"
        run = subprocess.run(
            [sys.executable, ROOT / "posts/freecad/isocnc_post.py", job, *shlex.split(USUAL)], capture_output=True, text=True, check=False
        )
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertTrue(run.stdout.endswith("M05\nM02\n"))
        run = subprocess.run([sys.executable, ROOT / "posts/freecad/isocnc_post.py", job], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("G54", run.stderr)


class Faces(unittest.TestCase):
    SAFE = USUAL + " --safe-z 200"
    MOVES = [["G0", {"Z": 40}], ["G0", {"X": 10, "Y": 5}], ["G1", {"Z": -2, "F": 5}], ["G1", {"X": 30}], ["G0", {"Z": 40}]]

    def test_a_custom_operation_may_mount_a_face(self):
        text = post([["G29", {"X": 100, "B": 90, "C": 0}], *self.MOVES, ["G27", {}], ["G0", {"Z": 210}]], self.SAFE)
        self.assertIn("G00 B90 C0\nG00 Z-10\nG29 X100 Y0 Z0 B90 C0\n", text)
        self.assertIn("G27\nG00 Z200\nG00 B0 C0\nG00 Z210\n", text)
        self.assertEqual(findings_of({"face": text}), "")

    def test_a_turned_part_is_a_face(self):
        """FreeCAD's rotation generator turns the part, first about Z, then about X, until the normal looks up."""
        rng = random.Random(1)
        for _ in range(20):
            a, c = rng.uniform(-80, 80), rng.uniform(-170, 170)
            face = isocnc_post.face_of_part({"A": a, "C": c})
            x, y, z = face.k
            x, y = x * math.cos(math.radians(c)) - y * math.sin(math.radians(c)), x * math.sin(math.radians(c)) + y * math.cos(math.radians(c))
            y, z = y * math.cos(math.radians(a)) - z * math.sin(math.radians(a)), y * math.sin(math.radians(a)) + z * math.cos(math.radians(a))
            self.assertLess(math.dist((x, y, z), (0, 0, 1)), 1e-9)
            more = rng.choice(["", " --faces g28"])
            text = post([["G0", {"A": a}], ["G0", {"C": c}], *self.MOVES], self.SAFE + " --rotary part --precision 6" + more)
            found = events.of_program(programs / "isorun", text)
            path = FreeCadPath({"G54": ORIGIN}, tools_of(USUAL), safe_z=200.0)
            at = {"origin": face.origin, "i": face.i, "j": face.j, "k": face.k}
            start = [["M6", {"T": 3}], ["M3", {"S": 12000}], ["G0", {"X": 0, "Y": 0, "Z": 20}]]
            expected = path.run([{"commands": start}, {"commands": self.MOVES, "face": at}])
            self.assertEqual(events.difference(expected, found, 2e-6), "")
            self.assertEqual(findings_of({"part": text}), "")

    def test_a_face_that_looks_up_does_not_turn_the_tool(self):
        text = post([["G29", {"X": 50, "Y": 40, "Z": 5, "C": 30}], *self.MOVES], self.SAFE)
        self.assertRegex(text, r"G00 X[-\d.]+ Y[-\d.]+\nG00 Z45\nG29 X50 Y40 Z5 B0 C30\n")
        self.assertEqual(findings_of({"up": text}), "")

    def test_faces_that_cannot_be_reached(self):
        for commands, reason in (
            ([["G24", {"A": 1, "J": -1, "R": -1}], *self.MOVES], "looks down"),
            ([["G29", {"B": 90}], ["G1", {"Z": 1, "F": 5}]], "begin with rapids"),
            ([["G29", {"Z": 300, "B": 30}], *self.MOVES], "below the start of the face"),
        ):
            with self.subTest(reason), self.assertRaisesRegex(isocnc_post.PostError, reason):
                post(commands, self.SAFE)

    def test_five_axes(self):
        text = post([["G1", {"X": 5, "B": 10, "F": 5}], ["G1", {"X": 9, "B": 20, "C": 5}], ["G1", {"X": 3}]])
        self.assertIn("G49\nG01 X5 B10 F300\nG01 X9 B20 C5\nG01 X3\nG48\n", text)
        self.assertEqual(findings_of({"five": text}), "")
        operation = isocnc_post.Operation("turn", [("M6", {"T": 3}), ("G1", {"X": 5.0, "B": 10.0, "F": 5.0})])
        more = isocnc_post.Operation("flat", [("G1", {"X": 9.0})])
        text = isocnc_post.post([operation, more], isocnc_post.parse_options(USUAL + " --no-comments"))
        self.assertIn("G01 X5 B10 F300\nG48\nG01 X9\n", text)

    def test_a_tool_change_dismounts_the_face(self):
        text = post([["G29", {"B": 90}], *self.MOVES, ["M6", {"T": 4}], ["M3", {"S": 9000}], *self.MOVES], self.SAFE)
        self.assertIn("G00 Z40\nG27\nG00 Z200\nG00 B0 C0\nM05\nM06 T101004\nS9000 M03\nG00 Z200\n", text)
        self.assertEqual(text.count("G29"), 2)
        self.assertEqual(findings_of({"tools": text}), "")


if __name__ == "__main__":
    programs = Path(sys.argv.pop(1)).resolve()
    unittest.main()
