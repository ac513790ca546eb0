#!/usr/bin/env python3
"""Times isolint, isofmt and isorun on generated programs and holds the figures against their targets.

Whole processes are timed, mostly against the bare tokenizer, in pairs that take turns, so that a machine whose speed drifts
does not tilt the ratio. Prints a Markdown table. Exit status: 0 every target met, 1 some missed, 2 could not measure.
"""

import argparse
import contextlib
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

CLEAN_KINDS = ["short", "arcs", "fiveaxis", "incremental", "production"]
BIG_KINDS = ["short", "production"]
PATH_KINDS = ["production-if", "hostile-if"]
RS274_KINDS = ["short", "arcs"]
KINDS = CLEAN_KINDS + PATH_KINDS + ["errors", "tiny", "rs274"]

TOKENIZER_RATIO = 1.5  # CPU of jobs 1 against the tokenizer, on each clean kind.
NO_LOSS_RATIO = 1.05  # Wall time of jobs 2 against jobs 1; "no loss", and the noise of a measurement.
BIG_RATIO = 0.75  # The same at --big lines.
PATH_RATIOS = {"production-if": 1.2, "hostile-if": 3.0}  # CPU against production.
FORMATTER_RATIO = 2.0  # CPU of isofmt against isolint's.
RS274_RATIO = 0.2  # CPU of isorun, planning included, against LinuxCNC's rs274, which only interprets.
ERRORS_RATIO = 30  # CPU against the tokenizer.
ERRORS_MIB = 500
ANONYMOUS_MIB = 32
TINY_LINES = 10
TINY_MS = 10

SEED = 1
FINDINGS = 1  # isolint's exit status when it found errors.


class CannotMeasure(Exception):
    """Something is missing or misbehaves, so that no figure would mean anything."""


@dataclass
class Run:
    """What one process took: seconds, and the maximum MiB. The numbers are the kernel's, from wait4."""

    cpu: float
    wall: float
    resident: float


@dataclass
class Row:
    corpus: str
    what: str
    measured: str
    target: str
    met: bool


def spawn(argv: list[str]) -> int:
    """Starts a process that reads nothing and whose findings and summary go nowhere."""
    streams = [
        (os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0),
        (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0),
        (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0),
    ]
    return os.posix_spawn(argv[0], argv, os.environ, file_actions=streams)


def run(argv: list[str], expected: int = 0) -> Run:
    begin = time.perf_counter()
    _, status, usage = os.wait4(spawn(argv), 0)
    wall = time.perf_counter() - begin
    status = os.waitstatus_to_exitcode(status)
    if status != expected:
        raise CannotMeasure(f"exit status {status} instead of {expected}: {' '.join(argv)}")
    return Run(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024)


def on_one_processor(argv: list[str]) -> list[str]:
    """Programs start no threads there."""
    return ["/usr/bin/taskset", "-c", str(min(os.sched_getaffinity(0))), *argv]


def take_turns(first: list[str], second: list[str], runs: int, expected: int = 0) -> tuple[list[Run], list[Run]]:
    """A, B, A, B, ... after one run of each that does not count. `expected` is the first one's exit status."""
    firsts, seconds = [], []
    for _ in range(runs + 1):
        firsts.append(run(first, expected))
        seconds.append(run(second))
    return firsts[1:], seconds[1:]


def anonymous_peak(argv: list[str]) -> float:
    """The maximum MiB of its own (not the mapped file) that a process held, looked up about once in a millisecond."""
    pid = spawn(argv)
    peak_kib = 0
    while os.waitpid(pid, os.WNOHANG) == (0, 0):
        with contextlib.suppress(OSError):
            for line in Path(f"/proc/{pid}/status").read_text().splitlines():
                if line.startswith("RssAnon:"):
                    peak_kib = max(peak_kib, int(line.split()[1]))
        time.sleep(0.001)
    return peak_kib / 1024


def median_ratio(firsts: list[Run], seconds: list[Run], figure: str) -> tuple[float, str]:
    """The median of the ratios pair by pair, and how it reads in the table."""
    ratio = statistics.median(getattr(a, figure) / max(getattr(b, figure), 1e-6) for a, b in zip(firsts, seconds))
    first, second = (statistics.median(getattr(r, figure) for r in side) * 1000 for side in (firsts, seconds))
    return ratio, f"{ratio:.2f} ({first:.0f} ms / {second:.0f} ms)"


def human(lines: int) -> str:
    return f"{lines // 1_000_000}M" if lines % 1_000_000 == 0 else f"{lines}"


class Comparison:
    def __init__(self, options: argparse.Namespace, work: Path):
        self.options = options
        self.work = work
        self.isolint = self.program("isolint")
        self.isofmt = self.program("isofmt")
        self.isorun = self.program("isorun")
        self.tokenizer = self.program("isocnc_tokenizer")
        self.generator = self.program("isocnc_corpus")
        self.rows: list[Row] = []

    def program(self, name: str) -> str:
        """The benchmarks' own programs lie in bench/ beside bin/."""
        for folder in (self.options.bin, self.options.bin.parent / "bench"):
            if os.access(folder / name, os.X_OK):
                return str(folder / name)
        raise CannotMeasure(f"{name} is missing: build the release preset first, or name the programs' folder by --bin")

    def corpus(self, kind: str, lines: int) -> str:
        """The generated program, written unless a present one is younger than the generator."""
        file = self.work / f"{kind}-{lines}-{SEED}.iso"
        if not file.exists() or file.stat().st_mtime < os.stat(self.generator).st_mtime:
            unfinished = file.with_suffix(".part")
            with unfinished.open("wb") as out:
                subprocess.run([self.generator, kind, str(lines), str(SEED)], stdout=out, check=True)
            unfinished.rename(file)
        return str(file)

    def check(self, file: str, jobs: int = 1) -> list[str]:
        return [self.isolint, "--jobs", str(jobs), "--no-config", file]

    def must_be_clean(self, file: str) -> None:
        """Where isolint finds something in a clean program, the times would be those of another task."""
        command = [self.isolint, "--format", "concise", "--no-config", file]
        found = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, check=False)
        if found.returncode != 0 or found.stdout:
            first = "\n".join(found.stdout.splitlines()[:5])
            raise CannotMeasure(f"isolint ends with {found.returncode} on the clean program {file}:\n{first}")

    def add(self, corpus: str, what: str, measured: str, value: float, limit: float, unit: str = "") -> None:
        self.rows.append(Row(corpus, what, measured, f"at most {limit:g}{unit}", value <= limit))

    # One method for each question.

    def against_tokenizer(self, kind: str) -> None:
        file = self.corpus(kind, self.options.lines)
        self.must_be_clean(file)
        ratio, text = median_ratio(
            *take_turns(self.check(file), [self.tokenizer, file], self.options.runs), figure="cpu"
        )
        self.add(self.title(kind), "jobs 1 / tokenizer, CPU", text, ratio, TOKENIZER_RATIO)

    def two_jobs(self, kind: str, lines: int, limit: float) -> None:
        file = self.corpus(kind, lines)
        ratio, text = median_ratio(*take_turns(self.check(file, 2), self.check(file), self.options.runs), figure="wall")
        self.add(self.title(kind, lines), "jobs 2 / jobs 1, wall", text, ratio, limit)

    def against_production(self, kind: str) -> None:
        file = self.corpus(kind, self.options.lines)
        production = self.corpus("production", self.options.lines)
        self.must_be_clean(file)
        ratio, text = median_ratio(
            *take_turns(self.check(file), self.check(production), self.options.runs), figure="cpu"
        )
        self.add(self.title(kind), "jobs 1 / the same on production, CPU", text, ratio, PATH_RATIOS[kind])

    def formatter(self, kind: str) -> None:
        file = self.corpus(kind, self.options.lines)
        formatting = [self.isofmt, "--stdout", "--no-config", file]
        ratio, text = median_ratio(*take_turns(formatting, self.check(file), self.options.runs), figure="cpu")
        self.add(self.title(kind), "isofmt / isolint, CPU", text, ratio, FORMATTER_RATIO)

    def memory(self, kind: str, lines: int, jobs: int) -> None:
        peak = anonymous_peak(self.check(self.corpus(kind, lines), jobs))
        self.add(self.title(kind, lines), f"jobs {jobs}, RssAnon", f"{peak:.1f} MiB", peak, ANONYMOUS_MIB, " MiB")

    def errors(self) -> None:
        file = self.corpus("errors", self.options.lines)
        checks, bare = take_turns(self.check(file), [self.tokenizer, file], self.options.runs, expected=FINDINGS)
        ratio, text = median_ratio(checks, bare, figure="cpu")
        resident = max(check.resident for check in checks)
        self.add(self.title("errors"), "jobs 1 / tokenizer, CPU", text, ratio, ERRORS_RATIO)
        self.add(self.title("errors"), "jobs 1, resident", f"{resident:.0f} MiB", resident, ERRORS_MIB, " MiB")

    def against_rs274(self) -> None:
        rs274 = shutil.which("rs274")
        if not rs274:
            print("rs274: skipped, it is not installed (Debian package linuxcnc-uspace)", file=sys.stderr)
            return
        for kind in RS274_KINDS:
            file = self.corpus(kind, self.options.lines)
            running = on_one_processor([self.isorun, "--no-config", file])
            interpreting = [rs274, "-g", self.in_ngc(file)]
            ratio, text = median_ratio(*take_turns(running, interpreting, self.options.runs), figure="cpu")
            self.add(self.title(kind), "isorun / rs274 -g, CPU", text, ratio, RS274_RATIO)

    @staticmethod
    def in_ngc(file: str) -> str:
        """The same program for LinuxCNC: these kinds differ in nothing but what stands at the beginning."""
        ngc = Path(file).with_suffix(".ngc")
        ngc.write_text(Path(file).read_text().replace("M06 T101001", "G17 G21 G90 G94 G90.1", 1))
        return str(ngc)

    def tiny(self) -> None:
        file = self.corpus("short", TINY_LINES)
        command = [self.isolint, "--no-config", file]
        run(command)
        wall = statistics.median(run(command).wall for _ in range(max(self.options.runs, 20))) * 1000
        self.add(f"short, {TINY_LINES} lines", "wall", f"{wall:.1f} ms", wall, TINY_MS, " ms")

    def title(self, kind: str, lines: int = 0) -> str:
        return f"{kind}, {human(lines or self.options.lines)} lines"

    def questions(self, kind: str) -> None:
        print(f"{kind} ...", file=sys.stderr, flush=True)
        if kind == "tiny":
            return self.tiny()
        if kind == "errors":
            return self.errors()
        if kind == "rs274":
            return self.against_rs274()
        if kind in PATH_KINDS:
            self.against_production(kind)
        else:
            self.against_tokenizer(kind)
            self.formatter(kind)
        self.two_jobs(kind, self.options.lines, NO_LOSS_RATIO)
        self.memory(kind, self.options.lines, 1)
        if kind in BIG_KINDS and self.options.big:
            self.two_jobs(kind, self.options.big, BIG_RATIO)
            self.memory(kind, self.options.big, 1)
            self.memory(kind, self.options.big, 2)

    def table(self) -> str:
        head = ["| program | what | measured | target | met |", "|---|---|---|---|---|"]
        body = [
            f"| {row.corpus} | {row.what} | {row.measured} | {row.target} | {'yes' if row.met else '**no**'} |"
            for row in self.rows
        ]
        return "\n".join(head + body)


def kinds(text: str) -> list[str]:
    names = text.split(",")
    for name in names:
        if name not in KINDS:
            raise argparse.ArgumentTypeError(f"no kind {name!r}; there are {', '.join(KINDS)}")
    return names


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    root = Path(__file__).resolve().parent.parent
    parser.add_argument("--bin", type=Path, default=root / "build/release/bin", help="folder of the programs")
    parser.add_argument("--work", type=Path, help="folder that keeps the generated programs (else a temporary one)")
    parser.add_argument("--runs", type=int, default=15, help="counted runs of each command, default 15")
    parser.add_argument("--lines", type=int, default=1_000_000, help="lines of a program, default 1000000")
    parser.add_argument("--big", type=int, default=10_000_000, help="lines of a big program, default 10000000; 0: none")
    parser.add_argument("--kinds", type=kinds, default=KINDS, help=f"some of {','.join(KINDS)}")
    options = parser.parse_args()
    if options.runs < 1 or options.lines < 1 or options.big < 0:
        parser.error("--runs and --lines are at least 1, --big is not negative")
    options.bin = options.bin.resolve()
    return options


def main() -> int:
    options = parse_options()
    with contextlib.ExitStack() as stack:
        if options.work:
            options.work.mkdir(parents=True, exist_ok=True)
            work = options.work
        else:
            work = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="isocnc-bench-")))
        try:
            comparison = Comparison(options, work)
            for kind in options.kinds:
                comparison.questions(kind)
        except (CannotMeasure, OSError, subprocess.CalledProcessError) as problem:
            print(f"compare.py: {problem}", file=sys.stderr)
            return 2
    print(f"{os.cpu_count()} processors, medians of {options.runs} runs\n")
    print(comparison.table())
    return 0 if all(row.met for row in comparison.rows) else 1


if __name__ == "__main__":
    sys.exit(main())
