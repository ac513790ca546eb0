#!/usr/bin/env python3
"""The kit that proves post-processors (posts/kit): its cases agree with themselves, and tell a wrong post from a right one.

usage: kit_test.py FOLDER_OF_PROGRAMS. For each case what the steps ask for, worked out here, is what is expected, what isorun
does with the program, and what the posts of this project write for the steps.
"""

import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
KIT = ROOT / "posts/kit"
sys.path.insert(0, str(ROOT / "posts/freecad"))
sys.dont_write_bytecode = True

import cutter_location  # noqa: E402
import events  # noqa: E402
import isocnc_post  # noqa: E402

CASES = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(KIT.glob("*.json")) if ".schema" not in path.name}

programs = Path()


def isodiff(old, new, *options):
    """Its exit status and what it prints, of two programs as texts or paths."""
    command = [programs / "isodiff", "--no-config", "--lang", "en", *options, old, "-"]
    run = subprocess.run(command, input=new, capture_output=True, text=True, timeout=60, check=False)
    return run.returncode, run.stdout + run.stderr


class Cases(unittest.TestCase):
    def test_all_are_there(self):
        self.assertEqual(
            sorted(CASES), ["arcs", "drilling", "faces", "five-axes", "helices", "limits", "lines", "tools"]
        )
        self.assertEqual(sorted(path.stem for path in KIT.glob("*.iso")), sorted(CASES))

    def test_they_follow_the_schema(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("there is no python3-jsonschema")
        validator = jsonschema.Draft202012Validator(json.loads((KIT / "case.schema.json").read_text()))
        for name, case in CASES.items():
            self.assertEqual([name + error.message for error in validator.iter_errors(case)], [])
            self.assertEqual(case["name"], name)
            self.assertTrue(list(validator.iter_errors(case | {"steps": [{"move": "jump", "to": [1, 2, 3]}]})))

    def test_what_is_expected_follows_from_the_steps(self):
        for name, case in CASES.items():
            found, expected = (
                events.of_trace("\n".join(map(json.dumps, each))) for each in (case["expected"], cutter_location.expected_of(case))
            )
            self.assertGreater(len(expected), 10)
            self.assertEqual(events.difference(expected, found, 1e-6), "", name)

    def test_the_program_does_what_is_expected(self):
        for name, case in CASES.items():
            expected = events.of_trace("\n".join(map(json.dumps, case["expected"])))
            found = events.of_program(programs / "isorun", (KIT / f"{name}.iso").read_text(encoding="utf-8"))
            self.assertEqual(events.difference(expected, found, 1.2e-3), "", name)

    def test_isolint_finds_nothing(self):
        run = subprocess.run(
            [programs / "isolint", "--no-config", "--verify", "--format", "concise", KIT], capture_output=True, text=True, check=False
        )
        self.assertEqual(run.stdout + run.stderr, "")

    def test_another_program_is_told_apart(self):
        """Each block changed or left out, each motion another way: isodiff sees it, in every case."""
        for name in CASES:
            program = KIT / f"{name}.iso"
            lines = program.read_text(encoding="utf-8").splitlines()
            changed = 0
            for index, line in enumerate(lines):
                following = [each for each in lines[index + 1 :] if not each.startswith("(")]
                if line.startswith("G00 Z") and following[0].startswith("Z"):
                    continue  # On the way to the next one.
                for wrong in self.wrong_lines(line):
                    text = "\n".join([*lines[:index], *wrong, *lines[index + 1 :]]) + "\n"
                    status, report = isodiff(program, text)
                    self.assertEqual(status, 1, f"{name}: {line} as {wrong}: {report}")
                    changed += 1
            self.assertGreater(changed, 12)

    def wrong_lines(self, line):
        code = line.partition("(")[0]
        match = re.search(r"[XYZ](-?[\d.]+)", code)
        if match and not code.startswith("G24"):
            yield [line[: match.start(1)] + f"{float(match[1]) + 0.5:.9g}" + line[match.end(1) :]]
        if code.startswith(("G02", "G03")):
            yield [("G03" if code.startswith("G02") else "G02") + line[3:]]
        match = re.search(r"F([\d.]+)", code)
        if match:
            yield [line[: match.start(1)] + f"{float(match[1]) * 1.1:g}" + line[match.end(1) :]]
        if code.startswith(("G04", "M0", "S")) and not code.startswith("M02"):
            yield []
        if code.startswith("M06"):
            yield [line.replace("T10", "T20")]


class Posts(unittest.TestCase):
    """The posts of this project hold before their own kit."""

    def test_freecad(self):
        for name, case in CASES.items():
            with self.subTest(name):
                job, arguments = cutter_location.freecad_job_of(case)
                for more in ("", " --arcs radius --modal --axis-modal", " --faces g28"):
                    operations = isocnc_post.operations_of_json(job)
                    text = isocnc_post.post(operations, isocnc_post.parse_options(arguments + more))
                    status, report = isodiff(KIT / f"{name}.iso", text, "--tolerance", "0.002")
                    self.assertEqual(status, 0, f"{report}\n{text}")

    def fusion(self, name, properties):
        command = ["node", HERE / "fusion_stand_in.mjs", ROOT / "posts/fusion/isocnc.cps", KIT / f"{name}.json", json.dumps(properties)]
        return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)

    @unittest.skipUnless(shutil.which("node"), "there is no node")
    def test_fusion_with_a_stand_in(self):
        for name, case in CASES.items():
            with self.subTest(name):
                run = self.fusion(name, {"origin": ",".join(f"{value:g}" for value in case["origin"]), "safeZ": "200"})
                self.assertEqual((run.returncode, run.stderr), (0, ""))
                status, report = isodiff(KIT / f"{name}.iso", run.stdout, "--tolerance", "0.002")
                self.assertEqual(status, 0, f"{report}\n{run.stdout}")

    @unittest.skipUnless(shutil.which("node"), "there is no node")
    def test_fusion_guesses_nothing(self):
        for name, properties, reason in (
            ("lines", {}, "not X,Y,Z"),
            ("faces", {"origin": "350,220,-180"}, "Safe Z"),
            ("faces", {"origin": "350,220,-180", "safeZ": "20"}, "below the start"),
        ):
            with self.subTest(reason):
                run = self.fusion(name, properties)
                self.assertEqual((run.returncode, run.stdout), (1, ""))
                self.assertIn(reason, run.stderr)


if __name__ == "__main__":
    programs = Path(sys.argv.pop(1)).resolve()
    unittest.main()
