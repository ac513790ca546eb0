#!/usr/bin/env python3
"""Holds one build's programs against another's, on the same generated programs: CPU time in pairs, and instructions.

Instructions are counted by callgrind on shorter programs of the same kind: they are the same from run to run, whatever else the
machine does, so a small change shows that times would hide. Prints a Markdown table. Exit status: 0 nothing takes more than
--more, 1 something does, 2 could not measure.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import compare
from instructions import instructions

KINDS = [*compare.CLEAN_KINDS, *compare.PATH_KINDS]
COMMANDS = {
    "isolint": ["--jobs", "1", "--no-config"],
    "isofmt": ["--stdout", "--no-config"],
    "isorun": ["--no-config"],
}


class Against:
    def __init__(self, options: argparse.Namespace, work: Path):
        self.options = options
        # Both builds read what one generator writes.
        self.programs = compare.Comparison(argparse.Namespace(bin=options.new), work)

    def cpu(self, name: str, file: str) -> tuple[float, str]:
        now, before = ([str(folder / name), *COMMANDS[name], file] for folder in (self.options.new, self.options.old))
        return compare.median_ratio(*compare.take_turns(now, before, self.options.runs), figure="cpu")

    def per_line(self, folder: Path, name: str, kind: str) -> float:
        """Of a line alone: what every start takes is left out."""
        short, long = self.options.counted // 4, self.options.counted
        counted = [
            instructions([str(folder / name), *COMMANDS[name], self.programs.corpus(kind, lines)]) for lines in (short, long)
        ]
        return (counted[1] - counted[0]) / (long - short)

    def row(self, name: str, kind: str) -> tuple[float, str]:
        print(f"{name} on {kind} ...", file=sys.stderr, flush=True)
        ratio, text = self.cpu(name, self.programs.corpus(kind, self.options.lines))
        counted = "-"
        if shutil.which("valgrind"):
            now, before = (self.per_line(folder, name, kind) for folder in (self.options.new, self.options.old))
            ratio = now / before
            counted = f"{ratio:.3f} ({now:.0f} / {before:.0f})"
        return ratio, f"| {name} | {kind} | {text} | {counted} |"


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--old", type=Path, required=True, help="folder of the programs as they were")
    parser.add_argument("--new", type=Path, required=True, help="folder of the programs as they are")
    parser.add_argument("--runs", type=int, default=9, help="counted pairs of runs, default 9")
    parser.add_argument("--lines", type=int, default=1_000_000, help="lines of a timed program, default 1000000")
    parser.add_argument("--counted", type=int, default=40_000, help="lines of a program whose instructions are counted")
    parser.add_argument("--kinds", default=",".join(KINDS), help=f"some of {','.join(KINDS)}")
    parser.add_argument("--more", type=float, default=1.02, help="the ratio that is not to be exceeded, default 1.02")
    options = parser.parse_args()
    unknown = set(options.kinds.split(",")) - set(KINDS)
    if unknown:
        parser.error(f"no kind {', '.join(sorted(unknown))}; there are {', '.join(KINDS)}")
    return options


def main() -> int:
    options = parse_options()
    rows = []
    with tempfile.TemporaryDirectory(prefix="isocnc-bench-") as work:
        try:
            against = Against(options, Path(work))
            rows = [against.row(name, kind) for kind in options.kinds.split(",") for name in COMMANDS]
        except (compare.CannotMeasure, OSError, subprocess.CalledProcessError) as problem:
            print(f"against.py: {problem}", file=sys.stderr)
            return 2
    print("| program | on | CPU, now / before | instructions a line, now / before |\n|---|---|---|---|")
    print("\n".join(text for _, text in rows))
    return 1 if any(ratio > options.more for ratio, _ in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
