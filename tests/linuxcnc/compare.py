#!/usr/bin/env python3
"""Holds isorun against LinuxCNC's rs274, an interpreter that shares nothing with it, on random programs.

Each program is written in both dialects (programs.py) and run by both. Ends, centers, planes, senses and sweeps of all
motions, feeds, dwells and the spindle must be the same, as far as rs274 prints them: four decimals.

Exit status: 0 all the same, 1 something differs, 2 could not compare, 77 skipped, as there is no rs274.
"""

import argparse
import contextlib
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from events import Event, events_of_isorun, events_of_rs274
from programs import LINEAR, MM_PER_INCH, Writer

SKIPPED = 77
PRINTED = 0.5e-4  # Half of the last digit.
SECONDS_AT_MOST = 120
NOTICED_WITHIN = 20  # Programs.


def output_of(command: list[str], folder: Path) -> tuple[str, str]:
    """What a program prints, and why it failed, if it did."""
    try:
        run = subprocess.run(
            command,
            cwd=folder,
            env={**os.environ, "HOME": str(folder)},  # Where rs274 maps its tool table: two at once would break it.
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=SECONDS_AT_MOST,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return "", f"no end within {SECONDS_AT_MOST} s"
    return run.stdout, "" if run.returncode == 0 else run.stderr.strip() or f"exit status {run.returncode}"


def tolerance(name: str, event: Event, unit: float) -> float:
    """A position of rs274 is the sum of up to three printed numbers: the point and two offsets."""
    position = 3.01 * PRINTED * unit
    if name == "sweep":
        radius = math.dist(*([event.values[f"{place} {axis}"] for axis in LINEAR] for place in ("center", "from")))
        return 4 * math.degrees(position / radius)
    if name == "feed":  # In G93 the length times F, and the length hangs on what the words have been rounded to.
        return 2 * PRINTED * unit + 2e-5 * event.values["feed"]
    if name.startswith("normal"):
        return 1e-6
    return position


@dataclass(frozen=True)
class Difference:
    line: int
    what: str
    of_values: bool  # Both do the same kind of thing, but not the same.


def first_difference(isorun: list[Event], rs274: list[Event], unit: float) -> Difference | None:
    """`unit` is the largest that the program uses: what rs274 prints in inches is coarser."""
    for ours, theirs in zip_longest(isorun, rs274):
        if not ours or not theirs or ours.sort() != theirs.sort():
            return Difference(min(event.line for event in (ours, theirs) if event), "different things happen", False)
        for name, value in ours.values.items():
            if not abs(value - theirs.values[name]) <= tolerance(name, ours, unit):
                return Difference(ours.line, f"{name} differs: {value:.6f} and {theirs.values[name]:.6f}", True)
    return None


@dataclass
class Outcome:
    events: int
    difference: Difference | None
    report: str  # Empty when all is the same.


def unaltered(program: list[str]) -> list[str]:
    return program


class Comparison:
    def __init__(self, isorun: str, rs274: str, folder: Path, steps: int):
        self.isorun = isorun
        self.rs274 = rs274
        self.folder = folder
        self.steps = steps

    def run(self, seed: int, alter: Callable[[list[str]], list[str]] = unaltered) -> Outcome:
        program = Writer(seed, self.steps)
        iso = alter(program.iso)
        tracing = [self.isorun, "--no-config", "--lang", "en", "--trace", "-"]
        trace, ours_fail = self.result_of(tracing, f"{seed}.iso", iso)
        canon, theirs_fail = self.result_of([self.rs274, "-g"], f"{seed}.ngc", program.ngc)
        isorun, rs274 = events_of_isorun(trace), events_of_rs274(canon)
        unit = MM_PER_INCH if any(" G70" in line for line in iso) else 1.0
        difference = first_difference(isorun, rs274, unit)
        report = [f"  {name} fails: {why}" for name, why in (("isorun", ours_fail), ("rs274", theirs_fail)) if why]
        if difference:
            line = difference.line
            sides = shown("isorun", iso, isorun, line) + shown("rs274", program.ngc, rs274, line)
            report = [f"  line {line}: {difference.what}", *sides, *report]
        return Outcome(len(isorun), difference, "\n".join([f"program {seed}", *report]) if report else "")

    def result_of(self, command: list[str], name: str, program: list[str]) -> tuple[str, str]:
        (self.folder / name).write_text("\n".join(program) + "\n")
        return output_of([*command, name], self.folder)


def shown(name: str, program: list[str], events: list[Event], line: int) -> list[str]:
    """The line and what it does, to be read beside the other's."""
    texts = [text for text in program if text.split()[0] == f"N{line}"]
    done = [str(event) for event in events if event.line == line]
    return [f"  {name}:", *(f"    {text}" for text in texts), *(f"      {event}" for event in done or ["nothing"])]


# What an interpreter could get wrong: each of these, done to the ISOCNC programs alone, has to be noticed.


def replaced(pattern: str, replacement: str | Callable[[re.Match], str]) -> Callable[[list[str]], list[str]]:
    return lambda program: [re.sub(pattern, replacement, line) for line in program]


def shifted(letter: str) -> Callable[[list[str]], list[str]]:
    """Little enough for arcs to be still taken for arcs."""
    return replaced(rf"\b{letter}(-?[.\d]+)", lambda word: f"{letter}{float(word[1]) + 0.0005:.6f}")


def other_sense(g: re.Match) -> str:
    return "G03" if g[0] == "G02" else "G02"


def other_sense_in(plane: str) -> Callable[[list[str]], list[str]]:
    def altered(program: list[str]) -> list[str]:
        lines, in_force = [], "G17"
        for line in program:
            in_force = re.findall(r"G1[789]\b", line)[-1:] or in_force
            lines.append(re.sub(r"G0[23]\b", other_sense, line) if plane in in_force else line)
        return lines

    return altered


MISTAKES = {
    "G02 for G03 in G17": other_sense_in("G17"),
    "G02 for G03 in G18": other_sense_in("G18"),
    "G02 for G03 in G19": other_sense_in("G19"),
    "G71 for G70": replaced(r"G70\b", "G71"),
    "G90 for G91": replaced(r"G91\b", "G90"),
    "G94 for G93": replaced(r"G93\b", "G94"),
    "M04 for M03": replaced(r"M03\b", "M04"),
    "F off": replaced(r"\bF([.\d]+)", lambda word: f"F{float(word[1]) + 1:.2f}"),
} | {f"{letter} off": shifted(letter) for letter in "XYZBCIJKRPS"}


def compare(comparison: Comparison, seeds: range) -> bool:
    events = 0
    for seed in seeds:
        outcome = comparison.run(seed)
        if outcome.report:
            print(outcome.report)
            return False
        events += outcome.events
    print(f"isorun and rs274 agree: {len(seeds)} programs, {events} motions and other events")
    return True


def notice(comparison: Comparison, first: int) -> bool:
    seeds = range(first, first + NOTICED_WITHIN)

    def is_noticed(alter: Callable[[list[str]], list[str]]) -> bool:
        """A program that stops at an error proves nothing."""
        differences = (comparison.run(seed, alter).difference for seed in seeds)
        return any(difference and difference.of_values for difference in differences)

    unnoticed = [name for name, alter in MISTAKES.items() if not is_noticed(alter)]
    noticed = len(MISTAKES) - len(unnoticed)
    print(f"{noticed} of {len(MISTAKES)} mistakes are noticed", *unnoticed, sep="\n  not noticed: ")
    return not unnoticed


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    root = Path(__file__).resolve().parent.parent.parent
    parser.add_argument("--isorun", type=Path, default=root / "build/release/bin/isorun", help="the program")
    parser.add_argument("--programs", type=int, default=300, help="how many, default 300")
    parser.add_argument("--first", type=int, default=1, help="seed of the first program, default 1")
    parser.add_argument("--steps", type=int, default=60, help="lines of each, more or less, default 60")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="writes the programs there, SEED.iso and SEED.ngc")
    parser.add_argument("--mistakes", action="store_true", help="is each mistake noticed, when made on one side?")
    return parser.parse_args()


def main() -> int:
    options = parse_options()
    isorun, rs274 = shutil.which(options.isorun.resolve()), shutil.which("rs274")
    if not isorun:
        print(f"compare.py: {options.isorun} is missing: build it first", file=sys.stderr)
        return 2
    if not rs274:
        print("skipped: rs274 is not installed (Debian package linuxcnc-uspace)")
        return SKIPPED
    with contextlib.ExitStack() as stack:
        folder = options.keep or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="isocnc-linuxcnc-")))
        folder.mkdir(parents=True, exist_ok=True)
        comparison = Comparison(isorun, rs274, folder, options.steps)
        if options.mistakes:
            return 0 if notice(comparison, options.first) else 1
        return 0 if compare(comparison, range(options.first, options.first + options.programs)) else 1


if __name__ == "__main__":
    sys.exit(main())
