#!/usr/bin/env python3
"""One isols and one isodap through a day of a shop: their memory stays flat, and they answer as fresh ones do.

usage: soak_test.py BIN_FOLDER [--hours H] [--seed N] [--part server|debugger] [--notices]. Skipped (77) where there is no /proc,
or no C compiler.

A day is 24 simulated hours of random work, the same for the same seed: thousands of opens, edits, folders, configurations and
launches; editors that crash; a clock that jumps; a network's disk that sleeps and fails (world.c). At many moments the answers about
all open programs are compared with those of a fresh process that gets the same texts. --notices plants mistakes, which the test has to find.
"""

import argparse
import os
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import debugger_day  # noqa: E402
import server_day  # noqa: E402
from failure import Failure  # noqa: E402

PARTS = {"server": server_day, "debugger": debugger_day}
# What is planted, and what the test has to say then.
FAULTS = [
    ("server", "leak", "memory grows"),
    ("server", "descriptor", "open files"),
    ("server", "answer", "of a fresh server"),
    ("server", "silence", "answer"),
    ("server", "file", "nobody has written"),
    ("debugger", "leak", "memory grows"),
    ("debugger", "answer", "of a fresh session"),
]


def run(options: argparse.Namespace, part: str, fault: str = "") -> str:
    """What has failed; empty if nothing has."""
    start = time.monotonic()
    try:
        summary = PARTS[part].run(options.programs.resolve(), options.seed, options.hours, fault)
    except Failure as problem:
        return str(problem)
    print(f"{part}, seed {options.seed}, {options.hours:g} hours in {time.monotonic() - start:.0f} s\n{summary}")
    return ""


def notices(options: argparse.Namespace) -> bool:
    missed = False
    for part, fault, words in FAULTS:
        said = run(options, part, fault)
        print(f"{part}, {fault}: {said.splitlines()[0][:200] if said else 'nothing is noticed'}")
        missed |= words not in said
    return not missed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path, help="the folder of isols and isodap")
    parser.add_argument("--hours", type=float, default=24, help="of the day")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--part", choices=PARTS, help="one of the two alone")
    parser.add_argument("--notices", action="store_true", help="plant mistakes, which have to be found")
    options = parser.parse_args()
    if not Path("/proc/self/status").exists() or not shutil.which(os.environ.get("CC", "cc")):
        print("skipped: there is no /proc, or no C compiler")
        return 77
    if options.notices:
        return 0 if notices(options) else 1
    with ThreadPoolExecutor() as side_by_side:
        failures = [each for each in side_by_side.map(lambda part: run(options, part), [options.part] if options.part else PARTS) if each]
    print("\n".join(failures), file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
