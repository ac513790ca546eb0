#!/usr/bin/env python3
"""How time and memory grow: programs of 10,000 lines to a gigabyte, trees of 10 to 10,000 programs, and what each stage of a line costs.

Prints Markdown tables. With --plot FILE.svg it draws the first two (python3-matplotlib). Instructions are counted by callgrind
(valgrind) and reported by the stage that executes them; without it that table is left out. Exit status: 0, or 2 could not measure.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import compare

LINES = [10_000, 100_000, 1_000_000, 10_000_000]
FILES = [10, 100, 1_000, 10_000]
LINES_OF_A_FILE = 500
GIGABYTE = 1 << 30
COUNTED_LINES = 40_000
STAGES = {  # By the function's own namespace, not those of what it is given; the first that fits.
    "parse": r"^[^(<]*isocnc::(syntax|dialect)::",
    "execute": r"^[^(<]*isocnc::((execution|geometry|configuration)::|analyzer::Checker::check_plain)"
    r"|^(sin|cos|atan2?|hypot|sqrt|acos)|__(sin|cos|atan|hypot)|_fma$",
    "rules, reports, jumps": r"isocnc::analyzer::",
    "read": r"isocnc::(running|support)::|mem(chr|rchr|cpy|move|set)|str(len|cmp)",
}


@dataclass
class Growth:
    """What one command took, on one size."""

    command: str
    what: str
    count: int  # Lines, or files.
    wall: float  # Seconds.
    anonymous: float  # MiB.


class Scale:
    def __init__(self, options: argparse.Namespace, work: Path):
        self.options = options
        self.work = work
        self.programs = compare.Comparison(argparse.Namespace(bin=options.bin, lines=0, runs=1), work)

    def commands(self, target: str, simulates: bool) -> dict[str, list[str]]:
        commands = {
            "isolint": [*self.programs.check(target)[:-1], target],
            "isolint, 2 jobs": [*self.programs.check(target, 2)[:-1], target],
            "isofmt": [self.programs.isofmt, "--check", "--no-config", target],
        }
        if simulates:
            commands["isorun"] = [self.programs.isorun, "--no-config", target]
        return commands

    def measure(self, command: str, argv: list[str], what: str, count: int) -> Growth:
        print(f"{command}, {what}, {count} ...", file=sys.stderr, flush=True)
        wall = min(compare.run(argv).wall for _ in range(self.options.runs if count < LINES[-1] else 1))
        return Growth(command, what, count, wall, compare.anonymous_peak(argv))

    def of_lines(self, kind: str) -> list[Growth]:
        measured = []
        for lines in self.options.lines:
            file = self.programs.corpus(kind, lines)
            for command, argv in self.commands(file, simulates=lines <= LINES[-1]).items():
                measured.append(self.measure(command, argv, kind, lines))
        return measured

    def of_files(self) -> list[Growth]:
        measured = []
        content = Path(self.programs.corpus("production", LINES_OF_A_FILE)).read_bytes()
        for count in self.options.files:
            tree = self.work / f"tree-{count}"
            for i in range(count):
                folder = tree / f"{i // 100:03}"
                folder.mkdir(parents=True, exist_ok=True)
                (folder / f"{i % 100:02}.iso").write_bytes(content)
            for command, argv in self.commands(str(tree), simulates=False).items():
                measured.append(self.measure(command, argv, "files", count))
            shutil.rmtree(tree)
        return measured

    def of_gigabyte(self, kind: str) -> list[Growth]:
        """One file of that size: programs end to end are none, so it is made in one piece."""
        sample = Path(self.programs.corpus(kind, 100_000)).stat().st_size / 100_000
        lines = int(GIGABYTE / sample)
        file = self.programs.corpus(kind, lines)
        measured = [
            self.measure(command, argv, kind, lines) for command, argv in self.commands(file, simulates=False).items()
        ]
        Path(file).unlink()
        return measured

    def stages(self, kind: str) -> dict[str, float]:
        """Instructions a line, by stage."""
        long = self.counted(self.programs.corpus(kind, COUNTED_LINES))
        short = self.counted(self.programs.corpus(kind, COUNTED_LINES // 4))
        return {stage: (long[stage] - short[stage]) / (COUNTED_LINES * 3 / 4) for stage in [*STAGES, "other"]}

    def counted(self, file: str) -> Counter:
        """Instructions of the whole process, by stage: each function's own, without those that it calls."""
        counts = self.work / "callgrind.out"
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", *self.programs.check(file)]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise compare.CannotMeasure(f"exit status {done.returncode}: {' '.join(command)}\n{done.stderr[-500:]}")
        names: dict[str, str] = {}
        total: Counter = Counter()
        stage = "other"
        called = False
        for line in counts.read_text(errors="replace").splitlines():
            if found := re.match(r"fn=\((\d+)\)(?: (.*))?$", line):
                if found[2]:
                    names[found[1]] = found[2]
                name = names.get(found[1], "")
                stage = next((each for each, pattern in STAGES.items() if re.search(pattern, name)), "other")
            elif found := re.match(r"cfn=\((\d+)\) (.*)$", line):
                names[found[1]] = found[2]
            elif line.startswith("calls="):
                called = True
            elif found := re.match(r"[+\-*\d]\S* (\d+)$", line):
                if not called:
                    total[stage] += int(found[1])
                called = False
        return total


def count_text(count: int) -> str:
    return f"{count:,}"


def time_text(seconds: float) -> str:
    return f"{1000 * seconds:.0f} ms" if seconds < 10 else f"{seconds:.1f} s"


def table(title: str, measured: list[Growth]) -> str:
    commands = list(dict.fromkeys(each.command for each in measured))
    rows = [f"| {title} | " + " | ".join(commands) + " |", "|---" * (len(commands) + 1) + "|"]
    for what, count in dict.fromkeys((each.what, each.count) for each in measured):
        cells = []
        for command in commands:
            found = [each for each in measured if (each.command, each.what, each.count) == (command, what, count)]
            cells.append(f"{time_text(found[0].wall)}, {found[0].anonymous:.1f} MiB" if found else "")
        rows.append(f"| {what}, {count_text(count)} | " + " | ".join(cells) + " |")
    return "\n".join(rows) + "\n"


def draw(file: Path, lines: list[Growth], files: list[Growth]) -> None:
    try:
        import matplotlib
    except ImportError:
        print(f"scale.py: {file} is not drawn: that takes python3-matplotlib", file=sys.stderr)
        return
    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    plt.rcParams["svg.hashsalt"] = "isocnc"  # The same bytes from the same figures.
    figure, rows = plt.subplots(2, 2, figsize=(10, 7), constrained_layout=True)
    for column, (measured, label) in enumerate([(lines, "lines"), (files, "files")]):
        for command, what in dict.fromkeys((each.command, each.what) for each in measured):
            mine = [each for each in measured if (each.command, each.what) == (command, what)]
            name = command if what == "files" else f"{command}, {what}"
            counts = [each.count for each in mine]
            rows[0][column].plot(counts, [each.wall for each in mine], marker="o", markersize=3, label=name)
            rows[1][column].plot(counts, [each.anonymous for each in mine], marker="o", markersize=3, label=name)
        for axes, unit in zip((rows[0][column], rows[1][column]), ("seconds", "MiB of its own")):
            axes.set(xscale="log", yscale="log", xlabel=label, ylabel=unit)
            axes.grid(alpha=0.3)
        rows[1][column].set_ylim(0.1, 100)
        rows[0][column].legend(fontsize=8)
    figure.savefig(file, metadata={"Date": None})


def parse_options() -> argparse.Namespace:
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", type=Path, default=root / "build/release/bin", help="folder of the programs")
    parser.add_argument("--runs", type=int, default=3, help="runs of each command, of which the shortest counts; one from 10M lines on")
    parser.add_argument("--lines", type=int, nargs="+", default=LINES, help="how many lines the programs have")
    parser.add_argument("--files", type=int, nargs="+", default=FILES, help="how many programs the trees have")
    parser.add_argument("--no-gigabyte", action="store_true", help="no program of a gigabyte")
    parser.add_argument("--plot", type=Path, help="draw how time and memory grow")
    return parser.parse_args()


def main() -> int:
    options = parse_options()
    with tempfile.TemporaryDirectory(prefix="isocnc-scale-") as work:
        try:
            scale = Scale(options, Path(work))
            lines = [*scale.of_lines("short"), *scale.of_lines("production")]
            print(table("program, lines", lines))
            files = scale.of_files()
            print(table(f"tree of programs of {LINES_OF_A_FILE} lines", files))
            if not options.no_gigabyte:
                print(table("a gigabyte, lines", scale.of_gigabyte("production")))
            if shutil.which("valgrind"):
                print("| isolint, instructions a line | " + " | ".join([*STAGES, "other"]) + " |\n" + "|---" * (len(STAGES) + 2) + "|")
                for kind in compare.CLEAN_KINDS:
                    print(f"| {kind} | " + " | ".join(f"{count:.0f}" for count in scale.stages(kind).values()) + " |")
            if options.plot:
                draw(options.plot, lines, files)
        except (compare.CannotMeasure, OSError, subprocess.CalledProcessError) as problem:
            print(f"scale.py: {problem}", file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
