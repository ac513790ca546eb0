#!/usr/bin/env python3
"""Times isodap on a generated program, as an editor sees it, and holds the figures against their targets.

Speaks with the adapter through pipes. Prints a Markdown table. Exit status: 0 every target met, 1 some missed, 2 could not
measure.
"""

import argparse
import random
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import editor
import material
from compare import on_one_processor

BLOCKS_PER_SECOND = 500_000
STEP_MS = 5.0
PAUSE_MS = 20.0
MATERIAL_STEP_MS = 50.0
STEPS = 200
PLACES = 20
PAUSES = 20
# A run goes on for as long as it takes.
LONGEST_RUN_S = 3600


class Refused(editor.CannotMeasure):
    """What the adapter has answered to a request that it does not grant."""


class Adapter(editor.Client):
    """An adapter; its events are kept where a caller waits for them."""

    def __init__(self, program):
        super().__init__(program)
        self.seq = 0
        self.request("initialize", adapterID="isocnc")

    def take(self, arrived, message):
        if message["type"] == "response" or message.get("event") in ("stopped", "terminated", "initialized"):
            super().take(arrived, message)

    def request(self, command, **arguments):
        self.seq += 1
        seq = self.seq
        self.send({"seq": seq, "type": "request", "command": command, "arguments": arguments})
        answer = self.wait(lambda each: each["type"] == "response" and each["request_seq"] == seq, LONGEST_RUN_S)[1]
        if not answer["success"]:
            raise Refused(f"{command}: {answer['message']}")
        return answer.get("body")

    def event(self, *names):
        """The next of these events, and when it was there."""
        arrived, message = self.wait(lambda message: message.get("event") in names, LONGEST_RUN_S)
        return arrived, message["event"]

    def run(self, command, **arguments):
        """A request that lets the program go on, until it stops; seconds."""
        begin = time.perf_counter()
        self.request(command, threadId=1, **arguments)
        return self.event("stopped", "terminated")[0] - begin

    def end(self):
        self.request("disconnect")
        self.process.wait(10)


def launched(program, file, **arguments):
    adapter = Adapter(program)
    adapter.request("launch", program=str(file), **arguments)
    adapter.event("initialized")
    return adapter


def run_seconds(program, file, breakpoints=()):
    adapter = launched(program, file)
    adapter.request("setBreakpoints", source={"path": str(file)}, breakpoints=list(breakpoints))
    seconds = adapter.run("configurationDone")
    adapter.end()
    return seconds


def many_breakpoints(lines):
    """A thousand in lines; all have a condition, so that the run goes on, and ten of them a longer one."""
    chosen = random.Random(editor.SEED).sample(range(10, lines), 1000)
    longer = [{"line": line, "condition": "Z < 0 && S > 0 && V30 == 1"} for line in chosen[:10]]
    return longer + [{"line": line, "condition": "V30 == 1"} for line in chosen[10:]]


def step_times(program, file, lines):
    """Of steps on and back, near the end of the program and then anywhere; ms."""
    adapter = launched(program, file, startAtLine=lines - 2 * STEPS)
    adapter.run("configurationDone")
    on = [1000 * adapter.run("next") for _ in range(STEPS)]
    back = [1000 * adapter.run("stepBack") for _ in range(STEPS)]
    for line in random.Random(editor.SEED).sample(range(10, lines - 10), PLACES):
        target = adapter.request("gotoTargets", source={}, line=line)["targets"][0]["id"]
        adapter.run("goto", targetId=target)
        back += [1000 * adapter.run("stepBack") for _ in range(STEPS // PLACES)]
        on += [1000 * adapter.run("next") for _ in range(STEPS // PLACES)]
    adapter.end()
    return on, back


def pause_times(program, file, seconds):
    """Of pauses all along a run that takes so long; ms. A run that has ended before it is paused is begun anew."""
    times = []
    while len(times) < PAUSES:
        adapter = launched(program, file, stopOnEntry=True)
        adapter.run("configurationDone")
        while len(times) < PAUSES:
            adapter.request("continue", threadId=1)
            time.sleep(seconds / (2 * PAUSES))
            begin = time.perf_counter()
            try:
                adapter.request("pause", threadId=1)
                arrived, event = adapter.event("stopped", "terminated")
            except Refused:
                break
            if event == "terminated":
                break
            times.append(1000 * (arrived - begin))
        adapter.end()
    return times


def material_times(build, lines):
    """With a blank that a flat cutter cuts: the first question near the end of the program, seconds; and steps back there and anywhere, each with what the
    motion removes, ms."""
    case = material.CASES[0]
    back = []
    with tempfile.TemporaryDirectory() as folder:
        file = material.prepare(build, folder, case, lines)[-1]
        adapter = launched(build / "bin/isodap", file, startAtLine=lines - 2 * STEPS)
        adapter.run("configurationDone")

        def removed():
            frame = adapter.request("stackTrace", threadId=1)["stackFrames"][0]["id"]
            return adapter.request("evaluate", expression="REMOVED", frameId=frame)["result"]

        begin = time.perf_counter()
        removed()
        first = time.perf_counter() - begin

        def steps_back(count):
            for _ in range(count):
                begin = time.perf_counter()
                adapter.run("stepBack")
                removed()
                back.append(1000 * (time.perf_counter() - begin))

        steps_back(STEPS)
        for line in random.Random(editor.SEED).sample(range(10, lines - 10), PLACES):
            target = adapter.request("gotoTargets", source={}, line=line)["targets"][0]["id"]
            adapter.run("goto", targetId=target)
            removed()
            steps_back(STEPS // PLACES)
        adapter.end()
    return first, back


def row(what, measured, target, is_met):
    print(f"| {what} | {measured} | {target} | {'yes' if is_met else '**no**'} |")
    return is_met


def measure(build, kind, lines):
    programs = build / "bin"
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{kind}.iso"
        file.write_bytes(editor.corpus(build, kind, lines))
        begin = time.perf_counter()
        subprocess.run(on_one_processor([str(programs / "isorun"), "--no-config", str(file)]), stdout=subprocess.DEVNULL, check=False)
        isorun = time.perf_counter() - begin
        isodap = programs / "isodap"
        plain = run_seconds(isodap, file)
        watched = run_seconds(isodap, file, many_breakpoints(lines))
        on, back = step_times(isodap, file, lines)
        pauses = pause_times(isodap, file, plain)
    first, back_in_material = material_times(build, lines)
    print(f"\n{kind}, {lines} lines\n\n| what | measured | target | met |\n|---|---|---|---|")
    return all(
        [
            row("continue / isorun on one processor, wall", f"{plain / isorun:.2f} ({plain:.2f} s / {isorun:.2f} s)", "at most 2", plain <= 2 * isorun),
            row("1000 breakpoints, ten of them longer", f"{lines / watched:,.0f} blocks/s", f"at least {BLOCKS_PER_SECOND:,}", lines / watched >= BLOCKS_PER_SECOND),
            row("step", f"{statistics.median(on):.2f} ms, {max(on):.2f} ms at worst", f"at most {STEP_MS:g} ms", max(on) <= STEP_MS),
            row("step back", f"{statistics.median(back):.2f} ms, {max(back):.2f} ms at worst", f"at most {STEP_MS:g} ms", max(back) <= STEP_MS),
            row("blank: the first question, late in the program", f"{first:.2f} s", "", True),
            row(
                "blank: step back, and what the motion removes",
                f"{statistics.median(back_in_material):.2f} ms, {max(back_in_material):.2f} ms at worst",
                f"at most {MATERIAL_STEP_MS:g} ms",
                max(back_in_material) <= MATERIAL_STEP_MS,
            ),
            row("pause", f"{statistics.median(pauses):.1f} ms, {max(pauses):.1f} ms at worst", f"at most {PAUSE_MS:g} ms", max(pauses) <= PAUSE_MS),
        ]
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=editor.BUILD, help="the build to measure")
    parser.add_argument("--kind", default="short", help="the program, as isocnc_corpus calls it")
    parser.add_argument("--lines", type=int, default=1_000_000)
    options = parser.parse_args()
    return measure(options.build, options.kind, options.lines)


if __name__ == "__main__":
    editor.run("debugger.py", main)
