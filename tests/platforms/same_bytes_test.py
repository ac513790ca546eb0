#!/usr/bin/env python3
"""That the programs for another system say the same as those for this one: the same bytes on every golden program and example, and in traces the
same numbers but for the last digit, which the C library's angles may change (docs/platforms.md).

usage: same_bytes_test.py NATIVE OTHER

Both are folders of programs. Those in OTHER may be scripts that run the real ones under Wine or QEMU.
"""

import json
import math
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# What may be said on standard error is the same, too; but for the time of a run, which none of these prints.
COMMANDS = [
    ["isolint", "--no-config", "--select", "ALL", "--format", "json", "{files}"],
    ["isolint", "--no-config", "--select", "ALL", "--lang", "it", "{files}"],
    ["isolint", "--no-config", "--select", "ALL", "--format", "sarif", "{files}"],
    ["isolint", "--no-config", "--unsafe-fixes", "--diff", "{files}"],
    ["isolint", "--no-config", "--statistics", "{folders}"],
    ["isofmt", "--no-config", "--diff", "{files}"],
    # With the setups that the examples have.
    ["isolint", "--verify", "--format", "json", "examples"],
    ["isolint", "--verify", "--lang", "it", "examples"],
]
RUN = ["isorun", "--no-config", "--trace", "-", "{file}"]
COMPARE = ["isodiff", "--no-config", "--format", "json"]


def run(programs: pathlib.Path, command: list[str]) -> tuple[int, bytes, bytes]:
    environment = {key: value for key, value in os.environ.items() if not key.startswith("LC_") and key not in ("LANG", "NO_COLOR")}
    done = subprocess.run([str(programs / command[0]), *command[1:]], cwd=ROOT, env=environment, capture_output=True, timeout=600, check=False)
    return done.returncode, done.stdout, done.stderr


def is_same(here: object, there: object) -> bool:
    """Whether two values of JSON are the same, numbers up to their last digit."""
    if isinstance(here, dict) and isinstance(there, dict):
        return list(here) == list(there) and all(is_same(here[key], there[key]) for key in here)
    if isinstance(here, list) and isinstance(there, list):
        return len(here) == len(there) and all(map(is_same, here, there))
    if isinstance(here, float) and isinstance(there, float):
        return math.isclose(here, there, rel_tol=1e-13, abs_tol=1e-11)
    return type(here) is type(there) and here == there


def is_same_json(here: bytes, there: bytes) -> bool:
    one, other = here.splitlines(), there.splitlines()
    return len(one) == len(other) and all(a == b or is_same(json.loads(a), json.loads(b)) for a, b in zip(one, other))


def differences(native: pathlib.Path, other: pathlib.Path, command: list[str]) -> str | None:
    """A text that tells the first difference, or None."""
    here, there = run(native, command), run(other, command)
    if here == there:
        return None
    if command[0] in ("isorun", "isodiff") and (here[0], here[2]) == (there[0], there[2]) and is_same_json(here[1], there[1]):
        return None
    shown = " ".join(command)[:100]
    for name, one, two in zip(("exit status", "standard output", "standard error"), here, there):
        if one == two:
            continue
        if isinstance(one, int):
            return f"{shown}: {name}: {one} here, {two} there"
        lines = zip(one.splitlines(), two.splitlines())
        at, pair = next(((i, each) for i, each in enumerate(lines, 1) if each[0] != each[1]), (0, (b"", b"")))
        return f"{shown}: {name}: {len(one)} bytes here, {len(two)} there; line {at}:\n  {pair[0][:300]!r}\n  {pair[1][:300]!r}"
    return None


def main() -> int:
    native, other = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    folders = ["examples", "tests/programs"]
    files = sorted(str(path.relative_to(ROOT)) for folder in folders for path in (ROOT / folder).rglob("*.iso"))
    problems = []
    count = 0
    for command in COMMANDS:
        arguments = []
        for each in command:
            arguments += files if each == "{files}" else folders if each == "{folders}" else [each]
        count += 1
        problems.append(differences(native, other, arguments))
    # A start of each program for each file would take minutes: the examples have most of the arithmetic.
    examples = [file for file in files if file.startswith("examples/")]
    others = [file for file in files if not file.startswith("examples/")]
    for file in examples + others[:: len(others) // 20]:
        count += 1
        problems.append(differences(native, other, [file if each == "{file}" else each for each in RUN]))
    # Each example against its twin with a mistake.
    for twin in (file for file in examples if file.startswith("examples/broken/")):
        count += 1
        problems.append(differences(native, other, [*COMPARE, twin.replace("broken/", ""), twin]))
    problems = [problem for problem in problems if problem]
    print("\n".join(problems))
    print(f"{len(files)} programs: {count - len(problems)} passed, {len(problems)} failed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
