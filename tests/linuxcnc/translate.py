#!/usr/bin/env python3
"""Holds isofmt --from linuxcnc against LinuxCNC's rs274: it runs the original, isorun the translation.

The originals are random programs (foreign_programs.py) and programs that come with LinuxCNC. Ends, centers, planes,
senses and sweeps of all motions, feeds, dwells and the speed of the spindle must be the same, as far as rs274 prints
them, and isolint must find no error in the translation.

Exit status: 0 all the same, 1 something differs, 2 could not compare, 77 skipped, as there is no rs274.
"""

import argparse
import contextlib
import json
import math
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from itertools import zip_longest
from pathlib import Path

from compare import SKIPPED, output_of, tolerance
from events import MOVES_BY, CanonReader, Event, events_of_isorun
from foreign_programs import SYSTEMS, ForeignWriter
from programs import LINEAR, MM_PER_INCH

FOLDER = Path("/usr/share/linuxcnc/ncfiles")
# What of LinuxCNC's own programs is translated whole; with what the translation must be told besides the tools.
OWN_PROGRAMS = ["3dtest.ngc", "arcspiral.ngc", "cds.ngc", "tort.ngc"]
TOOLS = {str(tool): f"101{tool:03}" for tool in range(1, 10)}
MAP = {
    "start": "101999",
    "tools": TOOLS,
    "zeros": {name: [0, 0, 0] for name in SYSTEMS},
    "references": {"G28": [0, 0, 0], "G30": [0, 0, 0]},
    "functions": {f"M{m:02}": f"M{m:02}" for m in (7, 8, 9)} | {"M00": None, "M01": None},
}
COMPARED = ("rapid", "feed", "arc", "dwell")


class UnnumberedReader(CanonReader):
    """Takes the calls of all lines, with or without a number."""

    def read(self, output: str) -> list[Event]:
        for text in output.splitlines():
            call = self.CALL.match(text)
            if call:
                self.take(call[2], call[3].split(", "))
        return self.events

    def take(self, name: str, arguments: list[str]) -> None:
        unit = self.unit
        if name != "PROGRAM_END":
            super().take(name, arguments)
        self.feed *= unit / self.unit  # What was given in the other units stays as fast as it is.


def turns_of(arc: Event) -> list[Event]:
    """One arc for each turn, the whole ones first: rs274 makes several in one call."""
    sweep = arc.values["sweep"]
    whole = math.ceil(abs(sweep) / 360 - 0.002) - 1  # Less is what rs274 has rounded.
    turns, start = [], {axis: arc.values[f"from {axis}"] for axis in LINEAR}
    rise = {axis: arc.values[f"normal {axis}"] * (arc.values[f"to {axis}"] - start[axis]) * 360 / abs(sweep) for axis in LINEAR}
    for _ in range(whole):
        end = {axis: start[axis] + rise[axis] for axis in LINEAR}
        values = arc.values | {f"from {axis}": start[axis] for axis in LINEAR} | {f"to {axis}": end[axis] for axis in LINEAR}
        values |= {f"center {axis}": start[axis] for axis in LINEAR if arc.values[f"normal {axis}"]}
        turns.append(replace(arc, values=values | {"sweep": math.copysign(360, sweep)}))
        start = end
    last = arc.values | {f"from {axis}": start[axis] for axis in LINEAR}
    last |= {f"center {axis}": start[axis] for axis in LINEAR if arc.values[f"normal {axis}"]}
    return [*turns, replace(arc, values=last | {"sweep": sweep - math.copysign(360 * whole, sweep)})]


def events_of_translation(trace: str) -> list[Event]:
    """With an M05 for each M06, which stops the spindle; rs274 prints one by itself."""
    return events_of_isorun(trace.replace('"kind":"tool"', '"kind":"spindle","number":5'))


def compared(events: list[Event], changes_speed_at_once: bool) -> list[Event]:
    """Motions with the spindle's speed, negative for M04, and dwells. Without what moves nothing, and without lines, which
    the translation has others of. `changes_speed_at_once`: an S without M03 or M04 does, where the spindle turns."""
    kept: list[Event] = []
    speed = turns = 0.0
    sense = 0
    for event in events:
        if event.kind == "spindle":
            speed = event.values.get("speed", speed)
            if "number" in event.values:
                sense = {3: 1, 4: -1, 5: 0}[event.values["number"]]
            if changes_speed_at_once or "number" in event.values:
                turns = sense * speed
        if event.kind not in COMPARED:
            continue
        if event.kind in ("rapid", "feed"):
            ends = ([event.values[f"{end} {axis}"] for axis in LINEAR] for end in ("from", "to"))
            if math.dist(*ends) < MOVES_BY:
                continue
        with_spindle = replace(event, line=0, values=event.values | {"spindle": turns})
        kept += turns_of(with_spindle) if event.kind == "arc" else [with_spindle]
    return kept


def difference(ours: list[Event], theirs: list[Event], unit: float) -> str:
    for place, (our, their) in enumerate(zip_longest(ours, theirs)):
        if our and their and our.kind == their.kind:
            differing = [
                name
                for name, value in our.values.items()
                if not abs(value - their.values[name]) <= tolerance(name, our, unit)
            ]
            if not differing:
                continue
        else:
            differing = ["kind"]
        return f"  event {place}: {', '.join(differing)}\n    isorun: {our or 'nothing'}\n    rs274:  {their or 'nothing'}"
    return ""


class Translation:
    def __init__(self, programs: Path, rs274: str, folder: Path):
        self.programs = programs
        self.rs274 = rs274
        self.folder = folder
        self.map = folder / "map.json"
        self.map.write_text(json.dumps(MAP))
        self.tools = folder / "tool.tbl"
        self.tools.write_text("".join(f"T{tool} P{tool} Z0 D6\n" for tool in TOOLS))
        self.events = 0

    def program(self, name: str) -> str:
        return str(self.programs / name)

    def report(self, source: Path) -> str:
        """What is wrong with the translation; empty when nothing is."""
        translated = self.folder / (source.stem + ".iso")
        options = ["--no-config", "--lang", "en", "--from", "linuxcnc", "--map", str(self.map)]
        run = subprocess.run(
            [self.program("isofmt"), *options, str(source)], capture_output=True, check=False, timeout=120
        )
        translated.write_bytes(run.stdout)
        if run.returncode != 0:
            return f"  isofmt: status {run.returncode}\n" + run.stderr.decode()[:2000]
        found, fails = output_of([self.program("isolint"), "--no-config", "--format", "concise", translated.name], self.folder)
        if fails:
            return f"  isolint: {fails}\n{found[:2000]}"
        trace, ours_fail = output_of([self.program("isorun"), "--no-config", "--lang", "en", "--trace", "-", translated.name], self.folder)
        canon, theirs_fail = output_of([self.rs274, "-t", self.tools.name, "-g", str(source)], self.folder)
        text = source.read_text(errors="replace").upper().replace(" ", "")
        unit = MM_PER_INCH if "G20" in text else 1.0
        ours, theirs = compared(events_of_translation(trace), False), compared(UnnumberedReader().read(canon), True)
        self.events += len(ours)
        reports = [f"  {name} fails: {why}" for name, why in (("isorun", ours_fail), ("rs274", theirs_fail)) if why]
        return "\n".join([*reports, *filter(None, [difference(ours, theirs, unit)])])


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    root = Path(__file__).resolve().parent.parent.parent
    parser.add_argument("programs", type=Path, nargs="?", default=root / "build/release/bin", help="folder of the programs")
    parser.add_argument("--random", type=int, default=60, help="how many random programs, default 60")
    parser.add_argument("--first", type=int, default=1, help="seed of the first, default 1")
    parser.add_argument("--steps", type=int, default=60, help="lines of each, more or less, default 60")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="writes the programs there")
    return parser.parse_args()


def main() -> int:
    options = parse_options()
    rs274 = shutil.which("rs274")
    if not (options.programs / "isofmt").exists():
        print(f"translate.py: {options.programs}/isofmt is missing: build it first", file=sys.stderr)
        return 2
    if not rs274:
        print("skipped: rs274 is not installed (Debian package linuxcnc-uspace)")
        return SKIPPED
    with contextlib.ExitStack() as stack:
        folder = options.keep or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="isocnc-translate-")))
        folder.mkdir(parents=True, exist_ok=True)
        translation = Translation(options.programs.resolve(), rs274, folder)
        sources = [FOLDER / name for name in OWN_PROGRAMS if (FOLDER / name).exists()]
        for seed in range(options.first, options.first + options.random):
            sources.append(folder / f"{seed}.ngc")
            sources[-1].write_text("\n".join(ForeignWriter(seed, options.steps).lines) + "\n")
        failed = 0
        for source in sources:
            report = translation.report(source)
            if report:
                failed += 1
                print(f"{source}\n{report}")
    if failed:
        return 1
    print(f"isorun and rs274 agree: {len(sources)} programs, {translation.events} motions and dwells")
    return 0


if __name__ == "__main__":
    sys.exit(main())
