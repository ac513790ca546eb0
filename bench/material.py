#!/usr/bin/env python3
"""Times isorun --verify on programs that cut a blank, and holds the figures against their targets.

Each program runs on one processor and on all of them, as whole processes that take turns. Prints a Markdown table. Exit
status: 0 every target met, 1 some missed, 2 could not measure.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import editor
from compare import CannotMeasure, on_one_processor, run

FLAT_10 = {"radius": 10, "shape": "flat", "cutLength": 50}
BALL_4 = {"radius": 4, "shape": "ball", "cutLength": 40}
PANEL = [1000, 1000]
GAIN = 1.7  # Of two processors over one, at least.
CUPS = [
    {"name": f"cup {6 * row + column + 1}", "box": [[x, y, -78], [x + 120, y + 120, -18]]}
    for row, y in enumerate((40, 300, 560, 820))
    for column, x in enumerate((20, 180, 340, 500, 660, 820))
]


@dataclass
class Case:
    name: str
    kind: str  # As isocnc_corpus calls it.
    tool: dict
    blank: list  # Its sides along X and Y, mm.
    spacing: float  # mm
    lines: int
    seconds: float | None = None  # At most, of wall time on all processors.
    mib: float | None = None  # At most.
    surrounded: bool = False  # By 24 cups, with holder and nose.


CASES = [
    Case("flat, radius 10, 1 mm", "walk", FLAT_10, PANEL, 0.5, 1_000_000, seconds=5),
    Case("ball, radius 4, 1 mm", "walk", BALL_4, PANEL, 0.5, 1_000_000, seconds=6),
    Case("five axes, ball, radius 4, 1 mm, 24 cups, holder, nose", "walk-five-axes", BALL_4, PANEL, 0.5, 1_000_000, seconds=15, surrounded=True),
    Case("flat, radius 10, 1 mm, 250 x 250 mm at 0.1 mm", "walk-narrow", FLAT_10, [250, 250], 0.1, 100_000, seconds=8),
    Case("table of 3 x 1.5 m, all of it cut", "table", FLAT_10, [3000, 1500], 0.5, 20_000, mib=250),
]


def configuration(case):
    tool = {"head": 1, "holder": 1, "tool": 1, "length": 160, **case.tool}
    machine = {"tools": [tool], "home": {"z": 400}}
    setup = {"paths": ["*.iso"], "stock": {"box": [[0, 0, -18], [*case.blank, 0]]}, "resolution": case.spacing, "fixtures": []}
    if case.surrounded:
        machine["kinematics"] = {"type": "head", "pivot": 180}
        machine["holders"] = {"HSK63": [[50, 40, 50], [30, 50, 63]]}
        machine["nose"] = [[90, 110, 140]]
        tool["body"] = "HSK63"
        setup["fixtures"] = CUPS
    return {"machine": machine, "setups": [setup]}


def prepare(build, folder, case, lines):
    """The command that runs a case."""
    at = Path(folder) / f"{CASES.index(case)}"
    at.mkdir()
    (at / "isocnc.json").write_text(json.dumps(configuration(case)))
    (at / "program.iso").write_bytes(editor.corpus(build, case.kind, lines))
    return [str(build / "bin/isorun"), "--verify", str(at / "program.iso")]


def check(command, case):
    """Stops where a program removes nothing, or where it has a finding: then something else is measured."""
    output = subprocess.run(command, capture_output=True, text=True, check=False)
    if output.returncode != 0 or "cm3 removed" not in output.stdout:
        raise CannotMeasure(f"{case.name}: {output.stderr or output.stdout}")


def measure(build, runs, share, names):
    print("| program | moves | processor time | one processor | all processors | target | gain | memory | target | met |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    are_met = True
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            if names and case.name not in names and case.kind not in names:
                continue
            lines = int(case.lines * share)
            command = prepare(build, folder, case, lines)
            check(command, case)
            alone, together = [], []
            for _ in range(runs):
                alone.append(run(on_one_processor(command)))
                together.append(run(command))
            wall = statistics.median(each.wall for each in together)
            gain = statistics.median(one.wall / all_of_them.wall for one, all_of_them in zip(alone, together))
            mib = max(each.resident for each in alone + together)
            # What a run costs beside its moves would make a part of a program miss a part of the time.
            limit = case.seconds if share == 1 else None
            can_gain = len(os.sched_getaffinity(0)) > 1
            is_fast = limit is None or (wall <= limit and (not can_gain or gain >= GAIN))
            is_met = is_fast and (case.mib is None or mib <= case.mib)
            are_met &= is_met
            print(
                f"| {case.name} | {lines:,} | {statistics.median(each.cpu for each in alone):.2f} s "
                f"| {statistics.median(each.wall for each in alone):.2f} s | {wall:.2f} s "
                f"| {f'at most {limit:g} s' if limit else ''} | {gain:.2f} | {mib:.0f} MiB "
                f"| {f'at most {case.mib:g} MiB' if case.mib else ''} | {'yes' if is_met else '**no**'} |",
                flush=True,
            )
    return are_met


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=editor.BUILD, help="the build to measure")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--share", type=float, default=1, help="the part of each program's lines that is measured")
    parser.add_argument("--only", nargs="*", help="names of cases, or kinds of programs")
    options = parser.parse_args()
    return measure(options.build, options.runs, options.share, options.only)


if __name__ == "__main__":
    editor.run("material.py", main)
