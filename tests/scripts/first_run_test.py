#!/usr/bin/env python3
"""Runs scripts/isolint and scripts/isorun as on a fresh clone: they set up, build once, and start the program of their name.

In place of CMake stands a program that "builds" programs which print their name and arguments; setup finds every package installed.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ["CMakeLists.txt", "CMakePresets.json", "cmake/packages.cmake", "interpreter/isorun.cpp", "analyzer/isolint.cpp",
           "toolpath-view/src/main.ts"]  # fmt: skip
CMAKE = """#!/bin/sh
echo "$@" >>"$BUILD_LOG"
[ ! -e "$BUILD_LOG.fails" ] || { echo no compiler here; exit 1; }
[ "$1" = --build ] || exit 0
for program in "$@"; do :; done  # The last argument.
mkdir -p build/release/bin
printf '#!/bin/sh\\necho %s "$@"\\nexit 3\\n' "$program" >"build/release/bin/$program"
chmod +x "build/release/bin/$program"
"""
QUERY = """#!/bin/sh
for package in "$@"; do echo "installed $package"; done
"""


def is_script(path: Path) -> bool:
    return path.read_bytes()[:2] == b"#!"


class Files(unittest.TestCase):
    def test_what_stands_in_scripts_can_be_started(self) -> None:
        scripts = [path for path in (ROOT / "scripts").iterdir() if path.is_file()]
        self.assertGreater(len(scripts), 9)
        for path in scripts:
            with self.subTest(path=path.name):
                self.assertTrue(is_script(path))
                self.assertTrue(os.access(path, os.X_OK))


class FirstRun(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory(prefix="isocnc-first-run-")
        self.addCleanup(holder.cleanup)
        self.scratch = Path(holder.name)
        self.clone = self.scratch / "a clone"
        (self.clone / "scripts").mkdir(parents=True)
        for path in (ROOT / "scripts").iterdir():
            if path.is_file():
                (self.clone / "scripts" / path.name).write_bytes(path.read_bytes())
                (self.clone / "scripts" / path.name).chmod(path.stat().st_mode)
        for name in SOURCES:
            (self.clone / name).parent.mkdir(parents=True, exist_ok=True)
            (self.clone / name).touch()
        for name, text in (("cmake", CMAKE), ("dpkg-query", QUERY), ("apt-get", "#!/bin/sh\nexit 1\n")):
            stand_in = self.scratch / "bin" / name
            stand_in.parent.mkdir(exist_ok=True)
            stand_in.write_text(text)
            stand_in.chmod(0o755)
        self.log = self.scratch / "builds"

    def run_script(self, script: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PATH": f"{self.scratch / 'bin'}:{os.environ['PATH']}", "BUILD_LOG": str(self.log)}
        return subprocess.run(
            [script, *arguments], env=environment, cwd="/", capture_output=True, text=True, timeout=60, check=False
        )

    def builds(self) -> list[str]:
        return [line.split()[-1] for line in self.log.read_text().splitlines() if line.startswith("--build")]

    def test_each_builds_and_starts_the_program_of_its_name(self) -> None:
        for name in ("isolint", "isorun"):
            for _ in range(2):
                done = self.run_script(self.clone / "scripts" / name, "--lang", "it", "a part.iso")
                self.assertEqual((done.stdout, done.returncode), (f"{name} --lang it a part.iso\n", 3), done.stderr)
        self.assertEqual(self.builds(), ["isolint", "isorun"])

    def test_the_first_run_tells_that_it_takes_a_while(self) -> None:
        script = self.clone / "scripts/isolint"
        self.assertIn("some minutes", self.run_script(script).stderr)
        self.assertEqual(self.run_script(script).stderr, "")

    def test_a_link_from_elsewhere_starts_it(self) -> None:
        link = self.scratch / "isorun"
        link.symlink_to(self.clone / "scripts/isorun")
        self.assertEqual(self.run_script(link).stdout, "isorun\n")

    def test_changed_sources_are_built_again(self) -> None:
        script = self.clone / "scripts/isorun"
        self.run_script(script)
        (self.clone / "analyzer/isolint.cpp").write_text("// of isolint alone")
        self.run_script(script)
        self.assertEqual(self.builds(), ["isorun"])
        built = self.clone / "build/release/isorun.built"
        os.utime(self.clone / "interpreter/isorun.cpp", (built.stat().st_mtime + 10,) * 2)
        self.run_script(script)
        self.assertEqual(self.builds(), ["isorun", "isorun"])

    def test_a_build_that_fails_is_told_and_tried_again(self) -> None:
        script = self.clone / "scripts/isolint"
        fails = Path(f"{self.log}.fails")
        fails.touch()
        failed = self.run_script(script, "--version")
        self.assertEqual((failed.stdout, failed.returncode), ("", 2))
        self.assertIn("no compiler here", failed.stderr)
        self.assertIn("isolint: it could not be built", failed.stderr)
        fails.unlink()
        self.assertEqual(self.run_script(script).returncode, 3)

    def test_other_programs_are_refused(self) -> None:
        for arguments in ((), ("isofmt",)):
            done = self.run_script(self.clone / "scripts/build-and-run", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn("it knows isolint and isorun", done.stderr)


if __name__ == "__main__":
    unittest.main()
