#!/usr/bin/env python3
"""Commits programs under the hooks of .pre-commit-hooks.yaml, by the real pre-commit.

The hooks come from a repository made of our sources, as `repo:` entries name one. In place of CMake stands a program that
"builds" by copying the programs given; what the script does before and after it is real.

usage: hooks_test.py FOLDER_OF_PROGRAMS. Exit status: 77 where there is no pre-commit.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77
ROOT = Path(__file__).resolve().parents[2]
SOURCES = [".pre-commit-hooks.yaml", "CMakeLists.txt", "analyzer", "cmake", "interpreter", "scripts"]
GOOD = "M06 T101001\nG00 X10\nM02\n"
BAD = "M06 T101001\nG01 X10\nM02\n"  # No F.
FIXABLE = "M06 T101001\nG91 G91\nG00 X10\nM02\n"
FIXED = "M06 T101001\nG91\nG00 X10\nM02\n"
CMAKE = """#!/bin/sh
echo "$@" >>"$BUILD_LOG"
[ ! -e "$BUILD_LOG.fails" ] || { echo no compiler here; exit 1; }
[ "$1" = --build ] || exit 0
sleep 0.5
mkdir -p "$2/bin"
cp "$PROGRAMS/isolint" "$PROGRAMS/isofmt" "$PROGRAMS/isodiff" "$2/bin/"
"""

programs = Path()
scratch = Path()
hooks = Path()  # The repository that the hooks come from.


def environment() -> dict[str, str]:
    return {
        **{name: value for name, value in os.environ.items() if not name.startswith("GIT_")},
        "PATH": f"{scratch / 'bin'}:{os.environ['PATH']}",
        "HOME": str(scratch),
        "XDG_CACHE_HOME": str(scratch / "cache"),
        "PRE_COMMIT_HOME": str(scratch / "pre-commit"),
        "BUILD_LOG": str(scratch / "builds"),
        "PROGRAMS": str(programs),
        "LC_ALL": "C.UTF-8",
        "GIT_CONFIG_NOSYSTEM": "1",
    }


def run(*command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, cwd=cwd, env=environment(), capture_output=True, text=True, timeout=300, check=False
    )


def must(*command: str, cwd: Path) -> str:
    done = run(*command, cwd=cwd)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def make_repository(folder: Path) -> None:
    folder.mkdir(parents=True)
    must("git", "init", "-q", "-b", "main", cwd=folder)
    must("git", "config", "user.name", "Test", cwd=folder)
    must("git", "config", "user.email", "test@localhost", cwd=folder)


def make_hooks() -> None:
    """A repository of our sources as they are now, committed or not, and the stand-in for CMake."""
    make_repository(hooks)
    for name in SOURCES:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, hooks / name)
        else:
            shutil.copy(source, hooks / name)
    must("git", "add", ".", cwd=hooks)
    must("git", "commit", "-q", "-m", "Sources", cwd=hooks)
    stand_in = scratch / "bin" / "cmake"
    stand_in.parent.mkdir()
    stand_in.write_text(CMAKE)
    stand_in.chmod(0o755)


class Hooks(unittest.TestCase):
    def setUp(self) -> None:
        self.shop = Path(tempfile.mkdtemp(dir=scratch, prefix="shop")) / "programs of the shop"
        make_repository(self.shop)

    def use(self, *names: str) -> None:
        """Installs these hooks in the shop's repository."""
        ids = "".join(f"      - id: {name}\n" for name in names)
        revision = must("git", "rev-parse", "HEAD", cwd=hooks).strip()
        (self.shop / ".pre-commit-config.yaml").write_text(
            f"repos:\n  - repo: {hooks}\n    rev: {revision}\n    hooks:\n{ids}"
        )
        must("git", "add", ".pre-commit-config.yaml", cwd=self.shop)
        must("pre-commit", "install", cwd=self.shop)

    def write(self, name: str, text: str) -> None:
        (self.shop / name).parent.mkdir(parents=True, exist_ok=True)
        (self.shop / name).write_text(text)

    def text(self, name: str) -> str:
        return (self.shop / name).read_text()

    def stage(self, name: str, text: str) -> None:
        self.write(name, text)
        must("git", "add", name, cwd=self.shop)

    def commit(self) -> subprocess.CompletedProcess[str]:
        return run("git", "commit", "-m", "Programs", cwd=self.shop)

    def commits(self) -> int:
        return len(run("git", "rev-list", "HEAD", cwd=self.shop).stdout.splitlines())

    def test_a_bad_program_is_refused_and_a_good_one_passes(self) -> None:
        for hook in ("isolint", "isolint-system"):
            with self.subTest(hook=hook):
                before = self.commits()
                self.use(hook)
                self.stage("parts/bad one.ISO", BAD)
                refused = self.commit()
                self.assertNotEqual(refused.returncode, 0)
                self.assertIn("ISO066", refused.stdout + refused.stderr)
                self.assertEqual(self.commits(), before)
                self.stage("parts/bad one.ISO", GOOD + f"; {before}\n")
                self.assertEqual(self.commit().returncode, 0)
                self.assertEqual(self.commits(), before + 1)

    def test_other_files_are_left_alone(self) -> None:
        self.use("isolint", "isofmt")
        self.stage("notes.txt", BAD)
        self.assertEqual(self.commit().returncode, 0)

    def test_fixes_are_made_and_left_to_be_staged(self) -> None:
        for hook in ("isolint-fix", "isolint-fix-system"):
            with self.subTest(hook=hook):
                self.use(hook)
                name = f"{hook}.iso"
                self.stage(name, FIXABLE)
                self.assertNotEqual(self.commit().returncode, 0)
                self.assertEqual(self.text(name), FIXED)
                must("git", "add", name, cwd=self.shop)
                self.assertEqual(self.commit().returncode, 0)

    def test_programs_are_formatted(self) -> None:
        for hook in ("isofmt", "isofmt-system"):
            with self.subTest(hook=hook):
                self.use(hook)
                name = f"{hook}.nc"
                self.stage(name, GOOD.lower())
                self.assertNotEqual(self.commit().returncode, 0)
                self.assertEqual(self.text(name), GOOD)
                must("git", "add", name, cwd=self.shop)
                self.assertEqual(self.commit().returncode, 0)

    def test_what_programs_do_otherwise_is_shown(self) -> None:
        for hook in ("isodiff", "isodiff-system"):
            with self.subTest(hook=hook):
                name = f"{hook}.iso"
                self.use(hook)
                self.stage(name, GOOD)
                first = self.commit()
                self.assertEqual(first.returncode, 0, first.stdout + first.stderr)
                self.assertIn(f"{name} (new)\n", first.stdout + first.stderr)
                must("git", "mv", name, f"moved {name}", cwd=self.shop)
                self.stage(f"moved {name}", GOOD.replace("X10", "X11"))
                self.write(f"moved {name}", BAD)  # In the work tree alone.
                second = self.commit()
                self.assertEqual(second.returncode, 0, second.stdout + second.stderr)
                self.assertIn(f"{name} -> moved {name}\n", second.stdout + second.stderr)
                self.assertIn("line 2: moved by X1\n", second.stdout + second.stderr)
                self.write(f"moved {name}", GOOD)
                must("git", "add", ".", cwd=self.shop)
                self.commit()

    def test_only_what_is_staged_is_read(self) -> None:
        self.use("isolint")
        self.stage("staged.iso", GOOD)
        self.write("never added.iso", BAD)
        self.write("staged.iso", BAD)  # In the work tree alone.
        done = self.commit()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.text("staged.iso"), BAD)
        self.stage("staged.iso", BAD)
        self.write("staged.iso", GOOD)
        self.assertNotEqual(self.commit().returncode, 0)

    def test_many_programs_are_counted_once(self) -> None:
        self.use("isolint")
        for number in range(200):
            self.write(f"parts/{number}.iso", GOOD)
        self.write("parts/150.iso", BAD)
        must("git", "add", ".", cwd=self.shop)
        done = self.commit()
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual((done.stdout + done.stderr).count("ISO066"), 1)
        self.assertIn("1 error, 0 warnings in 200 files", done.stdout + done.stderr)

    def test_the_configuration_of_the_shop_counts(self) -> None:
        self.use("isolint")
        self.stage("isocnc.json", '{"lint": {"ignore": ["ISO066"]}}\n')
        self.stage("part.iso", BAD)
        self.assertEqual(self.commit().returncode, 0)


class Script(unittest.TestCase):
    """scripts/pre-commit-hook alone."""

    def setUp(self) -> None:
        shutil.rmtree(scratch / "cache", ignore_errors=True)
        for left in scratch.glob("builds*"):
            left.unlink()
        self.part = scratch / "part.iso"
        self.part.write_text(GOOD)

    def start(self, program: str = "isolint") -> subprocess.Popen[str]:
        return subprocess.Popen(
            [hooks / "scripts/pre-commit-hook", program, "--no-config", self.part],
            cwd=scratch,
            env=environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def builds(self) -> int:
        log = scratch / "builds"
        return log.read_text().count("--build") if log.exists() else 0

    def test_runs_side_by_side_build_once(self) -> None:
        runs = [self.start(program) for program in ("isolint", "isofmt", "isolint", "isofmt")]
        for each in runs:
            _, errors = each.communicate(timeout=60)
            self.assertEqual(each.returncode, 0, errors)
        self.assertEqual(self.builds(), 1)
        state = must(hooks / "scripts/pre-commit-hook", "--state", cwd=scratch).strip()
        left = sorted(path.name for path in (scratch / "cache/isocnc/hooks").iterdir())
        self.assertEqual(left, sorted([state, "lock"]))

    def test_other_sources_are_built_again(self) -> None:
        self.start().communicate(timeout=60)
        header = hooks / "interpreter/dialect/codes.h"
        text = header.read_text()
        header.write_text(text + "\n")
        self.start().communicate(timeout=60)
        self.assertEqual(self.builds(), 2)
        header.write_text(text)
        self.start().communicate(timeout=60)
        self.assertEqual(self.builds(), 2)

    def test_a_build_that_fails_is_told_and_tried_again(self) -> None:
        (scratch / "builds.fails").touch()
        failed = self.start()
        _, errors = failed.communicate(timeout=60)
        self.assertEqual(failed.returncode, 2)
        self.assertIn("no compiler here", errors)
        self.assertIn("could not be built", errors)
        (scratch / "builds.fails").unlink()
        again = self.start()
        again.communicate(timeout=60)
        self.assertEqual(again.returncode, 0)

    def test_the_github_action_annotates_and_writes_sarif(self) -> None:
        for name, text in (("good.iso", GOOD), ("bad.iso", BAD)):
            (scratch / name).write_text(text)
            sarif = scratch / f"{name}.sarif"
            done = subprocess.run(
                [hooks / "scripts/check-in-pipeline"],
                cwd=scratch,
                env={**environment(), "PATHS": name, "ARGUMENTS": "--no-config --lang en", "SARIF": str(sarif)},
                capture_output=True,
                text=True,
                timeout=60,
                check=False,
            )
            results = json.loads(sarif.read_text())["runs"][0]["results"]
            bad = text == BAD
            self.assertEqual(done.returncode, 1 if bad else 0, done.stderr)
            self.assertEqual([each["ruleId"] for each in results], ["ISO066"] if bad else [])
            self.assertEqual(done.stdout.startswith(f"::error file={name},line=2"), bad)

    def test_what_is_missing_is_named(self) -> None:
        (scratch / "builds.fails").touch()
        query = scratch / "bin" / "dpkg-query"
        query.write_text("#!/bin/sh\necho installed cmake\n")
        query.chmod(0o755)
        try:
            _, errors = self.start().communicate(timeout=60)
        finally:
            query.unlink()
        self.assertIn("apt-get install build-essential", errors)
        self.assertIn("libeigen3-dev", errors)
        self.assertNotIn("cmake", errors)


if __name__ == "__main__":
    if shutil.which("pre-commit") is None:
        print("skipped: there is no pre-commit")
        sys.exit(SKIPPED)
    programs = Path(sys.argv.pop(1)).resolve()
    with tempfile.TemporaryDirectory(prefix="isocnc-hooks-") as folder:
        scratch = Path(folder)
        hooks = scratch / "isocnc"
        make_hooks()
        for name in ("isolint", "isofmt", "isodiff"):
            (scratch / "bin" / name).symlink_to(programs / name)
        unittest.main()
