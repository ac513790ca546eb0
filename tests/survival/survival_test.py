#!/usr/bin/env python3
"""Each command that writes, with a disk that is full at every write, and killed at every system call: no file of the user is lost.

usage: survival_test.py BIN_FOLDER. Skipped (77) where there is no strace, or it may not be used.

strace counts what a command asks of the system in a run that goes well. Then it is run again and again, and one of these calls fails, or kills it. After
each run every file is as it was before or as the good run leaves it; nothing else is there, but for a temporary file of a program that was killed. Where the exit status is that
of the good run, everything has been written.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

from compare import on_one_processor  # noqa: E402

EXAMPLES = ROOT / "examples"
PROGRAMS = Path()
# What may fail while a file is written or read, and how.
FAULTS = {
    "ENOSPC": ("write", "writev", "pwrite64", "fsync", "fdatasync", "ftruncate", "fallocate", "openat", "rename", "renameat", "renameat2", "link", "mkdir"),
    "EIO": ("read", "pread64", "getdents64", "write", "fsync", "fdatasync", "close", "rename", "fstat", "newfstatat", "statx", "openat", "readlink", "fchmod"),
}
# What a program that was killed may leave beside a file.
TEMPORARY = re.compile(r"^(.*/)?\..+\.isocnc-[0-9a-f]{8}$")


@dataclass
class Command:
    """A command that writes, with the files that it finds."""

    argv: list[str]
    files: dict[str, bytes]
    status: int = 0  # Of the run that goes well.
    leaves: list[str] = field(default_factory=list)  # Files that it writes, old and new.
    is_report: bool = False  # What it writes is JSON, and may say what could not be read.


def example(name: str) -> bytes:
    return (EXAMPLES / name).read_bytes()


PROGRAM = b"M06 T101001\nS12000 M03\nG00 X0 Y0 Z50\nG01 Z-5 F1000\nX50\nY50\nX0\nG00 Z50\nM02\n"
UNTIDY = b"m06 t101001\n  s12000   m03\ng00 x0 y0 z50\ng01 z-5 f1000\nx50\ng00 z50\nm02\n"
MACHINE = b'{"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "length": 160, "radius": 5, "shape": "flat", "cutLength": 40}], "home": {"z": 400}},\n "setups": [{"paths": ["*.iso"], "stock": {"box": [[-20, -20, -20], [80, 80, 0]]}, "fixtures": []}]}\n'
OLD = b"the work of a week\n"

COMMANDS = {
    "isofmt -i": Command(["isofmt", "-i", "--no-config", "part.iso", "other.iso"], {"part.iso": UNTIDY, "other.iso": UNTIDY + b"; end\n"}, leaves=["part.iso", "other.iso"]),
    "isolint --fix": Command(
        ["isolint", "--fix", "--unsafe-fixes", "--jobs", "1", "."],
        {"pocket.iso": example("broken/pocket.iso"), "door/drilling.iso": example("broken/drilling.iso"), "isocnc.json": b'{"lint": {"ignore": ["W003"]}}'},
        status=1,
        leaves=["pocket.iso", "door/drilling.iso"],
    ),
    "isolint --write-baseline": Command(
        ["isolint", "--write-baseline", "baseline.json", "--no-config", "--jobs", "1", "drilling.iso"],
        {"drilling.iso": example("broken/drilling.iso"), "baseline.json": b'{"version": 1, "findings": []}\n'},
        leaves=["baseline.json"],
    ),
    "isolint --output": Command(
        ["isolint", "--format", "sarif", "--output", "report.sarif", "--no-config", "--jobs", "1", "drilling.iso"],
        {"drilling.iso": example("broken/drilling.iso"), "report.sarif": OLD},
        status=1,
        leaves=["report.sarif"],
        is_report=True,
    ),
    "isorun --trace --samples": Command(
        ["isorun", "--trace", "trace.jsonl", "--samples", "samples.jsonl", "part.iso"],
        {"part.iso": PROGRAM, "isocnc.json": MACHINE, "trace.jsonl": OLD, "samples.jsonl": OLD},
        leaves=["trace.jsonl", "samples.jsonl"],
    ),
    "isorun --plot --stock-out": Command(
        ["isorun", "--plot", "part.svg", "--stock-out", "left.stock", "--verify", "part.iso"],
        {"part.iso": PROGRAM, "isocnc.json": MACHINE, "part.svg": OLD, "left.stock": OLD},
        leaves=["part.svg", "left.stock"],
    ),
    "isorun --sheet": Command(["isorun", "--sheet", "sheet.pdf", "part.iso"], {"part.iso": PROGRAM, "isocnc.json": MACHINE, "sheet.pdf": OLD}, leaves=["sheet.pdf"]),
    "isorun --restart-at": Command(
        ["isorun", "--restart-at", "6", "-o", "rest.iso", "part.iso"], {"part.iso": PROGRAM, "isocnc.json": MACHINE, "rest.iso": OLD}, leaves=["rest.iso"]
    ),
    "isorun --import-tools": Command(
        ["isorun", "--import-tools", "fusion.json", "--map", "map.json", "--write"],
        {name: example(f"tools/{name}") for name in ("fusion.json", "map.json", "isocnc.json")},
        leaves=["isocnc.json"],
    ),
    "isorun --export-tools": Command(["isorun", "--export-tools", "tools.csv"], {"isocnc.json": MACHINE, "tools.csv": OLD}, leaves=["tools.csv"]),
    "isofmt": Command(["isofmt", "--stdout", "--no-config", "part.iso"], {"part.iso": UNTIDY}),
    "isolint": Command(
        ["isolint", "--jobs", "1", "--verify", "part.iso"],
        {"part.iso": PROGRAM, "form.stl": example("setups/form.stl"), "isocnc.json": MACHINE.replace(b'"fixtures": []', b'"fixtures": [{"name": "form", "mesh": "form.stl"}]')},
        status=1,
    ),
    "isorun --outline": Command(["isorun", "--outline", "rectangle", "--clearance", "30", "part.iso"], {"part.iso": PROGRAM, "isocnc.json": MACHINE}),
    "isorun --trace -": Command(["isorun", "--trace", "-", "part.iso"], {"part.iso": PROGRAM, "isocnc.json": MACHINE}),
    "isorun --export-tools -": Command(["isorun", "--export-tools", "-"], {"isocnc.json": MACHINE}),
    "isodiff": Command(["isodiff", "old.iso", "new.iso"], {"old.iso": PROGRAM, "new.iso": PROGRAM.replace(b"X50", b"X60")}, status=1),
    "isodiff -o": Command(
        ["isodiff", "--format", "json", "-o", "changes.json", "old.iso", "new.iso"],
        {"old.iso": PROGRAM, "new.iso": PROGRAM.replace(b"X50", b"X60"), "changes.json": OLD},
        status=1,
        leaves=["changes.json"],
    ),
}


def snapshot(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def is_complete(report: bytes) -> bool:
    try:
        return isinstance(json.loads(report), dict)
    except ValueError:
        return False


@dataclass
class Run:
    status: int
    output: str
    errors: str
    files: dict[str, bytes]


def run(command: Command, strace: list[str]) -> Run:
    """The command in a folder of its own, watched by strace with these options."""
    with tempfile.TemporaryDirectory(prefix="isocnc-survival-") as name:
        folder = Path(name)
        for file, text in command.files.items():
            (folder / file).parent.mkdir(exist_ok=True)
            (folder / file).write_bytes(text)
        # One thread: the same calls in each run.
        argv = on_one_processor(["strace", "-f", "-qq", *strace, str(PROGRAMS / command.argv[0]), *command.argv[1:]])
        done = subprocess.run(argv, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=120, check=False)
        return Run(done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace"), snapshot(folder))


def calls_of(command: Command) -> tuple[Run, list[tuple[str, int]]]:
    """The run that goes well, and its calls from the first on that concerns a file of the folder: each with its number among those of its name."""
    with tempfile.NamedTemporaryFile(suffix=".calls") as log:
        good = run(command, ["-o", log.name])
        names = re.findall(r"^\d* *(?:\[pid +\d+\] )?(\w+)\((.*)$", Path(log.name).read_text(errors="replace"), re.MULTILINE)
    counts: dict[str, int] = {}
    calls = []
    has_begun = False
    for name, arguments in names:
        counts[name] = counts.get(name, 0) + 1
        has_begun |= name != "execve" and any(f'"{file}"' in arguments or f'/{file}"' in arguments for file in command.files)
        if has_begun and name not in ("exit_group", "exit"):
            calls.append((name, counts[name]))
    return good, calls


class Survival(unittest.TestCase):
    def check_files(self, command: Command, good: Run, tried: Run, what: str, may_leave: bool) -> None:
        for name, text in command.files.items():
            self.assertIn(name, tried.files, f"{what}: the file is gone")
            if tried.files[name] not in (text, good.files[name]) and not (command.is_report and is_complete(tried.files[name])):
                self.fail(f"{what}: {name} is neither as before nor as it should be: {tried.files[name][:100]}... {tried.errors}")
        for name, text in tried.files.items():
            if name in command.files:
                continue
            if name in good.files:
                self.assertEqual(text, good.files[name], f"{what}: {name} is written in part")
            elif not (may_leave and TEMPORARY.match(name)):
                self.fail(f"{what}: {name} is left behind")

    def survives(self, command: Command) -> None:
        good, calls = calls_of(command)
        self.assertEqual(good.status, command.status, good.errors)
        for name in command.leaves:
            self.assertNotEqual(good.files[name], command.files.get(name), f"{name} is not written")
        self.assertGreater(len(calls), 10)
        for name, number in calls:
            what = f"{command.argv} killed at {name} {number}"
            killed = run(command, ["-o", "/dev/null", "-e", f"inject={name}:signal=SIGKILL:when={number}"])
            self.check_files(command, good, killed, what, may_leave=True)
        faults = [(error, name, number) for error, names in FAULTS.items() for name, number in calls if name in names]
        self.assertGreater(len(faults), 4)
        for error, name, number in faults:
            what = f"{command.argv}, {error} at {name} {number}"
            failed = run(command, ["-o", "/dev/null", "-e", f"inject={name}:error={error}:when={number}"])
            self.check_files(command, good, failed, what, may_leave=False)
            if failed.status == good.status:
                self.assertEqual({each: failed.files[each] for each in command.leaves}, {each: good.files[each] for each in command.leaves}, f"{what}: nothing is said")
                self.assertEqual(failed.output, good.output, f"{what}: part of the output is missing, and nothing is said")
            else:
                self.assertEqual(failed.status, 2, f"{what}: {failed.errors}")
                is_of_errors = name in ("write", "writev")  # What cannot be said is not said.
                self.assertTrue(failed.errors or is_of_errors, f"{what}: no reason is told")


def add_test(title: str, command: Command) -> None:
    setattr(Survival, f"test_{re.sub(r'[^a-z]+', '_', title)}", lambda self: self.survives(command))


for each_title, each_command in COMMANDS.items():
    add_test(each_title, each_command)


def can_inject() -> bool:
    if not shutil.which("strace"):
        return False
    tried = subprocess.run(["strace", "-qq", "-o", "/dev/null", "-e", "inject=getcwd:error=EIO", "true"], capture_output=True, check=False)
    return tried.returncode == 0


if __name__ == "__main__":
    PROGRAMS = Path(sys.argv.pop(1)).resolve()
    if not can_inject():
        print("skipped: strace is missing, or may not trace")
        sys.exit(77)
    unittest.main()
