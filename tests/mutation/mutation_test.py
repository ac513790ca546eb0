#!/usr/bin/env python3
"""Which small mistakes scripts/mutate finds in a source, and that each is there when it is switched on, and no other."""

import contextlib
import io
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

import covering  # noqa: E402
import explained  # noqa: E402

try:
    import mutants as mutation
except ImportError:
    print("skipped: python3-clang-14 is not installed")
    sys.exit(77)

SOURCE = r"""#include <array>
#include <cstdio>
constexpr int kSize = 3;
static_assert(kSize + 1 == 4);
enum class Kind { First = 1, Second = 2 };
#define SUM(a, b) ((a) + (b))

static void say(const char* what) { std::puts(what); }

static int rank(Kind kind) {
  switch (kind) {
    case Kind::First:
      return 10;
    case Kind::Second:
      break;
  }
  return 20;
}

int main(int count, char**) {
  std::array<int, 2> values{5, 6};
  const char* text = "abc" + 1;
  if (count < 2 && text) say("few");
  double sum = 1.5;
  for (int i = 0; i < 2; ++i) sum += values[static_cast<unsigned>(i)];
  const bool is_large = sum > 2 * kSize;
  std::printf("%g %d %d %s\n", sum, is_large, rank(Kind::Second), text);
  if constexpr (kSize > 2) say("end");
  return SUM(0, 0);
}
"""

FOUND = [
    "8:37: `std::puts(what)` becomes nothing",
    "13:14: `10` becomes `11`",
    "17:10: `20` becomes `21`",
    "21:29: `5` becomes `6`",
    "21:32: `6` becomes `7`",
    "22:30: `1` becomes `2`",
    "23:7: `count < 2` becomes `count <= 2`",
    "23:7: `count < 2 && text` becomes `!(count < 2 && text)`",
    "23:7: `count < 2 && text` becomes `count < 2 || text`",
    "23:15: `2` becomes `3`",
    '23:26: `say("few")` becomes nothing',
    "24:16: `1.5` becomes `1.5 * 1.5`",
    "25:16: `0` becomes `1`",
    "25:19: `i < 2` becomes `i <= 2`",
    "25:23: `2` becomes `3`",
    "25:31: `sum += values[static_cast<unsigned>(i)]` becomes `sum -= values[static_cast<unsigned>(i)]`",
    "26:25: `sum > 2 * kSize` becomes `sum >= 2 * kSize`",
    "26:31: `2` becomes `3`",
    "26:31: `2 * kSize` becomes `2 / kSize`",
    '27:3: `std::printf("%g %d %d %s\\n", sum, is_large, rank(Kind::Se...` becomes nothing',
    '28:28: `say("end")` becomes nothing',
]


def text_of(mutant):
    return str(mutant).removeprefix("a.cpp:")


class Mutants(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name) / "original"
        self.copy = Path(self.folder.name) / "copy"
        for folder in (self.root, self.copy):
            folder.mkdir()
        (self.root / "a.cpp").write_text(SOURCE)
        self.found = mutation.find(self.root, ["a.cpp"], ["-std=c++20"], 1)

    def test_are_what_could_be_a_slip(self):
        self.assertEqual([text_of(each) for each in self.found], FOUND)

    def test_of_limits_of_real_numbers_are_known(self):
        self.assertEqual([text_of(each) for each in self.found if each.is_limit_of_reals], ["26:25: `sum > 2 * kSize` becomes `sum >= 2 * kSize`"])

    def test_of_a_sample_do_not_overlap(self):
        some = mutation.sample(self.found, 1000, 7)
        self.assertGreater(len(some), 8)
        self.assertEqual(some, mutation.sample(self.found, 1000, 7))
        for one, next_one in zip(some, some[1:]):
            self.assertLessEqual(one.end, next_one.begin)
        self.assertEqual(len(mutation.sample(self.found, 3, 7)), 3)

    @unittest.skipIf(shutil.which("g++") is None, "there is no g++")
    def test_are_switched_on_one_at_a_time(self):
        right = "few\n12.5 1 20 bc\nend\n"
        outputs = {
            "8:37: `std::puts(what)` becomes nothing": right.replace("few\n", "").replace("end\n", ""),
            "13:14: `10` becomes `11`": right,
            "17:10: `20` becomes `21`": right.replace("20", "21"),
            "21:29: `5` becomes `6`": right.replace("12.5", "13.5"),
            "22:30: `1` becomes `2`": right.replace("bc", "c"),
            "23:7: `count < 2 && text` becomes `!(count < 2 && text)`": right.replace("few\n", ""),
            "24:16: `1.5` becomes `1.5 * 1.5`": right.replace("12.5", "13.25"),
            "25:19: `i < 2` becomes `i <= 2`": None,  # It may do anything.
            "26:31: `2 * kSize` becomes `2 / kSize`": right,
            '28:28: `say("end")` becomes nothing': right.replace("end\n", ""),
        }
        chosen = [each for each in self.found if text_of(each) in outputs]
        self.assertEqual([text_of(each) for each in chosen], list(outputs))
        compiler = ["g++", "-std=c++20", f"-I{ROOT}"]
        numbered = mutation.those_that_compile(self.root, self.copy, chosen, compiler, 1)
        self.assertEqual(list(numbered), list(range(len(chosen))))
        subprocess.run([*compiler, "a.cpp", "-o", "program"], cwd=self.copy, check=True)

        def output(**variables):
            return subprocess.run([self.copy / "program"], env=variables, capture_output=True, text=True, check=False).stdout

        self.assertEqual(output(), right)
        for number, mutant in numbered.items():
            expected = outputs[text_of(mutant)]
            if expected is not None:
                self.assertEqual(output(ISOCNC_MUTANT=str(number)), expected, text_of(mutant))

        reached = self.copy / "reached"
        reached.write_bytes(bytes(len(chosen)))
        self.assertEqual(output(ISOCNC_REACHED=str(reached)), right)
        never = [text_of(numbered[number]) for number, byte in enumerate(reached.read_bytes()) if not byte]
        self.assertEqual(never, ["13:14: `10` becomes `11`"])

    @unittest.skipIf(shutil.which("g++") is None, "there is no g++")
    def test_that_do_not_compile_are_left_out(self):
        (self.root / "a.cpp").write_text("#include <compare>\nint main(int count, char**) {\n  if ((count <=> 2) < 0) return 1;\n  return count - 1;\n}\n")
        found = mutation.find(self.root, ["a.cpp"], ["-std=c++20"], 1)
        self.assertIn("3:23: `0` becomes `1`", [text_of(each) for each in found])
        chosen = [each for each in found if each.original[0] != "("]
        numbered = mutation.those_that_compile(self.root, self.copy, mutation.sample(chosen, 1000, 1), ["g++", "-std=c++20", f"-I{ROOT}"], 1)
        self.assertEqual({mutant.line for mutant in numbered.values()}, {4})

    @unittest.skipIf(shutil.which("g++") is None, "there is no g++")
    def test_of_a_source_that_does_not_compile_are_told(self):
        (self.root / "a.cpp").write_text('int main(int count, char**) { return count - 1; }\n#include "missing.h"\n')
        found = mutation.find(self.root, ["a.cpp"], ["-std=c++20"], 1)
        self.assertTrue(found)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            numbered = mutation.those_that_compile(self.root, self.copy, mutation.sample(found, 1000, 1), ["g++", "-std=c++20", f"-I{ROOT}"], 1)
        self.assertEqual(numbered, {})
        self.assertIn("a.cpp does not compile", said.getvalue())


class Explanations(unittest.TestCase):
    TEXT = """
[["a.cpp"]]
place = "if («count < 2» && text) say(\\"few\\");"
changed = "count <= 2"
effect = "nothing"
why = "Nobody counts to 2."
"""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.root / "a.cpp").write_text(SOURCE)

    def test_are_of_the_mutant_at_their_place(self):
        explanations = explained.load(self.TEXT)
        found = mutation.find(self.root, ["a.cpp"], ["-std=c++20"], 1)
        self.assertEqual([text_of(each) for each in explained.of(self.root, found, explanations)], ["23:7: `count < 2` becomes `count <= 2`"])
        self.assertEqual(list(explained.stale(self.root, explanations)), [])

    def test_are_stale_where_their_line_has_changed(self):
        (self.root / "a.cpp").write_text(SOURCE.replace("&& text", "&& *text"))
        self.assertEqual(len(list(explained.stale(self.root, explained.load(self.TEXT)))), 1)

    def test_are_complete_and_given_once(self):
        for wrong in (self.TEXT + self.TEXT, self.TEXT.replace("Nobody counts to 2.", ""), self.TEXT.replace('"nothing"', '"none"')):
            with self.assertRaises(ValueError):
                explained.load(wrong)

    def test_of_this_project_have_their_places(self):
        stale = explained.stale(ROOT, explained.load(explained.FILE.read_text(encoding="utf-8")))
        self.assertEqual([f"{each.path}: {each.place}" for each in stale], [])


class Runs(unittest.TestCase):
    def test_begin_with_what_is_quick(self):
        tests = [covering.Test(program, "", case) for program, case in [("other_tests", "a"), ("own_tests", "b"), ("own_tests", "c"), ("other_tests", "d")]]
        seconds = dict(zip(tests, [0.1, 0.5, 5, 3], strict=True))
        runs = [[test.case for test in chosen] for chosen, _ in covering.runs_of(tests, seconds, "own", 60)]
        self.assertEqual(runs, [["b"], ["a"], ["c"], ["d"]])
        runs = [[test.case for test in chosen] for chosen, _ in covering.runs_of(tests, seconds, "own", 4)]
        self.assertEqual(runs, [["b"], ["a"], ["d"]])

    def test_of_what_waits_for_ever_are_ended(self):
        with unittest.mock.patch.object(covering, "IDLE_SECONDS", 2):
            passes, seconds = covering.run("/bin/cat", "/", 60)  # Whose input is empty.
            self.assertTrue(passes)
            script = Path(self.enterContext(tempfile.TemporaryDirectory())) / "waits"
            script.write_text("#!/bin/sh\nsleep 60\n")
            script.chmod(0o700)
            passes, seconds = covering.run(str(script), "/", 60)
            self.assertFalse(passes)
            self.assertLess(seconds, 30)


if __name__ == "__main__":
    unittest.main()
