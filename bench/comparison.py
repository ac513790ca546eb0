#!/usr/bin/env python3
"""Times isodiff on generated programs, and holds it against running both programs, each on one processor.

Prints a Markdown table. Exit status: 0 every target met, 1 some missed, 2 could not measure.
"""

import argparse
import json
import random
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import editor
from compare import on_one_processor

EDITS = 10
RATIO = 2.5


def seconds(*command):
    begin = time.perf_counter()
    result = subprocess.run([str(each) for each in command], stdout=subprocess.PIPE, check=False)
    if result.returncode == 2:
        raise editor.CannotMeasure(" ".join(map(str, command)))
    return time.perf_counter() - begin, result.stdout


def edited(text, rng):
    """The program with edits in motions that stand alone on their lines: digits changed and lines removed."""
    lines = text.split(b"\n")
    places = set()
    while len(places) < EDITS:
        place = rng.randrange(100, len(lines) - 100)
        if lines[place].startswith(b"X") and b"Y" in lines[place] and b"I" not in lines[place] + lines[place + 1]:
            places.add(place)
    for number, place in enumerate(sorted(places, reverse=True)):
        if number % 2:
            del lines[place]
        else:
            x, rest = lines[place].split(b" ", 1)
            lines[place] = b"X%.3f " % (float(x[1:]) + 0.5) + rest
    return b"\n".join(lines)


def row(isodiff, isorun, what, programs, runs, target):
    ratios, both_times, diff_times = [], [], []
    for _ in range(runs):
        alone = sum(seconds(*on_one_processor([isorun, "--no-config", program]))[0] for program in programs)
        compared, output = seconds(isodiff, "--no-config", "--format", "json", *programs)
        ratios.append(compared / alone)
        both_times.append(alone)
        diff_times.append(compared)
    changes = len(json.loads(output)["changes"])
    ratio = statistics.median(ratios)
    is_met = target is None or ratio <= target
    shown = "" if target is None else f"at most {target:g}"
    print(f"| {what} | {changes} | {ratio:.2f} ({statistics.median(diff_times):.2f} s / {statistics.median(both_times):.2f} s) | {shown} | {'yes' if is_met else '**no**'} |")
    return is_met


def measure(options):
    programs = options.build / "bin"
    is_met = True
    print(f"\n{options.lines} lines\n\n| programs | changes | isodiff / both runs | target | met |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for kind in options.kinds.split(","):
            old, new = Path(folder) / f"{kind}.iso", Path(folder) / f"{kind}-new.iso"
            text = editor.corpus(options.build, kind, options.lines)
            old.write_bytes(text)
            new.write_bytes(edited(text, random.Random(editor.SEED)))
            tools = programs / "isodiff", programs / "isorun"
            is_met &= row(*tools, f"`{kind}` and itself", (old, old), options.runs, RATIO)
            is_met &= row(*tools, f"`{kind}`, {EDITS} edits", (old, new), options.runs, RATIO)
            if kind == "fiveaxis":
                continue  # In the other order all motions are rapids that turn B and C, and the run itself takes a minute.
            lines = text.split(b"\n")
            new.write_bytes(b"\n".join(lines[:5] + lines[-5:5:-1] + lines[-4:]))
            is_met &= row(*tools, f"`{kind}` from its end to its start", (old, new), options.runs, None)
    return is_met


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=editor.BUILD, help="the build to measure")
    parser.add_argument("--kinds", default="short,fiveaxis", help="the programs, as isocnc_corpus calls them")
    parser.add_argument("--lines", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=5)
    return measure(parser.parse_args())


if __name__ == "__main__":
    editor.run("comparison.py", main)
