#!/usr/bin/env python3
"""Holds what programs execute for a line, or for an edit, against the table in docs/performance.md.

usage: instructions_test.py BUILD_FOLDER [--write]

Instructions are the same from run to run, whatever else the machine does: so this says what a change costs, where times could not. The numbers are of
GCC 12's release build on x86-64. One that differs by more than 3 % fails, less as well: then --write puts what was counted into the table, and the commit
says why. Exit status: 0 all hold, 1 some do not, 77 nothing to count with.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

import compare  # noqa: E402
import material  # noqa: E402
from instructions import instructions  # noqa: E402

TABLE = ROOT / "docs/performance.md"
TOLERANCE = 0.03
# | `isolint --jobs 1` | short | 20,000 lines | 1,234 |
ROW = re.compile(r"^\| `(?P<command>[^`]+)` \| (?P<kind>[\w-]+) \| (?P<count>[\d,]+) (?P<unit>lines|edits) \| (?P<each>[\d,]+) \|$", re.MULTILINE)
EDITED_LINES = 20_000


@dataclass
class Case:
    """A row of the table: what is run, on what, and the instructions that each line or edit takes."""

    name: str
    command: list[str]
    kind: str
    count: int
    unit: str
    each: int

    @classmethod
    def of(cls, row: re.Match) -> "Case":
        number = {key: int(row[key].replace(",", "")) for key in ("count", "each")}
        return cls(f"{row['command']} on {row['kind']}", row["command"].split(), row["kind"], number["count"], row["unit"], number["each"])


class Counter:
    def __init__(self, build: Path, work: Path):
        self.build = build
        self.work = work

    def program(self, name: str) -> str:
        return str(next(file for folder in ("bin", "bench") if (file := self.build / folder / name).exists()))

    def corpus(self, case: Case, lines: int) -> Path:
        """A program in a folder of its own, with the machine of bench/material.py where it cuts a blank."""
        folder = Path(tempfile.mkdtemp(dir=self.work))
        file = folder / "program.iso"
        file.write_bytes(subprocess.run([self.program("isocnc_corpus"), case.kind, str(lines), str(compare.SEED)], check=True, capture_output=True).stdout)
        for each in material.CASES:
            if each.kind == case.kind:
                (folder / "isocnc.json").write_text(json.dumps(material.configuration(each)))
                break
        return file

    def executed(self, case: Case, count: int) -> int:
        program, *options = case.command
        if case.unit == "edits":
            command = [self.program(program), *options, str(count), str(self.corpus(case, EDITED_LINES))]
        else:
            command = [self.program(program), *options, str(self.corpus(case, count))]
        return instructions(command)

    def each(self, case: Case) -> int:
        """Of a line or an edit alone: what every start takes is left out."""
        return round((self.executed(case, 2 * case.count) - self.executed(case, case.count)) / case.count)


def main() -> int:
    build, *options = sys.argv[1:]
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed")
        return 77
    text = TABLE.read_text()
    cases = [Case.of(row) for row in ROW.finditer(text)]
    if len(cases) < 10:
        print(f"{TABLE}: only {len(cases)} rows of instructions are found")
        return 1
    counted = {}
    is_wrong = False
    with tempfile.TemporaryDirectory(prefix="isocnc-instructions-") as work:
        counter = Counter(Path(build).resolve(), Path(work))
        for case in cases:
            each = counter.each(case)
            change = each / max(case.each, 1) - 1
            differs = abs(change) > TOLERANCE
            print(f"{'WRONG' if differs else 'ok   '}  {case.name}: {each:,} instructions, {change:+.1%} against the table's {case.each:,}", flush=True)
            counted[case.name] = each
            is_wrong |= differs
    if "--write" in options:
        def rewritten(row: re.Match) -> str:
            case = Case.of(row)
            return row[0].replace(f"| {case.each:,} |", f"| {counted[case.name]:,} |")

        TABLE.write_text(ROW.sub(rewritten, text))
        return 0
    return 1 if is_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
