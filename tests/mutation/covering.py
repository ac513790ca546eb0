"""Which tests reach which mutants, and which of these a test notices."""

import collections
import dataclasses
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

# Their own subject is the sources, or a build of them.
LEFT_OUT = {"release", "packages", "reproducible", "architecture", "documentation", "manifold", "pipelines"}
MEMORY = 8 << 30  # Bytes: a mutant may go on for ever.
FILTER_BYTES = 100_000  # A variable of the environment holds 128 KiB at most.


@dataclasses.dataclass(frozen=True)
class Test:
    """A case of GoogleTest, or a whole test of CTest."""

    command: tuple
    folder: str
    environment: tuple
    case: str = ""  # Of GoogleTest.

    @property
    def name(self):
        return f"{Path(self.command[0]).name} {self.case}".strip() if self.case else " ".join(self.command)


@dataclasses.dataclass
class Outcome:
    kind: str = "untried"  # noticed, survived
    by: str = ""  # The tests that noticed, or timed out.
    reaching: int = 0


def run(command, folder, environment, seconds, **variables):
    """Whether a command ends with 0, or as skipped, and how long it took. Each of its processes may take this much processor time, so that a busy machine
    changes no result, and all of it ten times as long, as a process may wait for ever."""
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as temporary:
        process = subprocess.Popen(
            ["prlimit", f"--as={MEMORY}", f"--fsize={MEMORY}", f"--cpu={math.ceil(seconds)}", *command],
            cwd=folder,
            env={**os.environ, **dict(environment), "TMPDIR": temporary, **variables},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            passes = process.wait(10 * seconds) in (0, 77)
        except subprocess.TimeoutExpired:
            passes = False
        try:
            os.killpg(process.pid, signal.SIGKILL)  # With all that it has started.
        except ProcessLookupError:
            pass
        process.wait()
    return passes, time.perf_counter() - begin


class Tests:
    """The tests that pass without any mutant, how long each takes, and what it reaches."""

    def __init__(self, build, mutant_count, jobs, programs=()):
        """`programs`: the names of those that count; without them all."""
        self.seconds = {}
        self.reaching = collections.defaultdict(list)  # By number of mutant.
        with ThreadPoolExecutor(jobs) as pool:
            tests = self.all_of(build, programs)
            for test, passes, seconds, reached in pool.map(lambda test: self.look_at(test, mutant_count), tests):
                if not passes:
                    print(f"mutate: left out, as it fails without a mutant: {test.name}", file=sys.stderr)
                    continue
                self.seconds[test] = seconds
                for mutant in reached:
                    self.reaching[mutant].append(test)
        print(f"mutate: {len(self.seconds)} tests, {sum(self.seconds.values()):.0f} s", flush=True)

    @staticmethod
    def all_of(build, programs):
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, text=True, check=True).stdout
        seen = set()
        for entry in json.loads(listed)["tests"]:
            name = entry["name"].split(".", 1)[0]
            properties = {each["name"]: each["value"] for each in entry["properties"]}
            if name in LEFT_OUT or "command" not in entry or properties.get("DISABLED"):
                continue
            environment = [tuple(each.split("=", 1)) for each in properties.get("ENVIRONMENT", [])]
            folder = properties["WORKING_DIRECTORY"]
            command = tuple(entry["command"])
            if programs and Path(command[0]).name not in programs:
                continue
            if not command[0].endswith("_tests"):
                yield Test(command, folder, tuple(environment))
            elif command[0] not in seen:
                seen.add(command[0])
                yield from Tests.cases_of(command[0], folder)

    @staticmethod
    def cases_of(program, folder):
        listed = subprocess.run([program, "--gtest_list_tests"], cwd=folder, capture_output=True, text=True, check=True).stdout
        suite = ""
        for line in listed.splitlines():
            name = line.split("#", 1)[0].rstrip()
            if not line.startswith(" "):
                suite = name if name.endswith(".") else ""
            elif suite and "DISABLED_" not in name:
                yield Test((program,), folder, (), suite + name.strip())

    @staticmethod
    def look_at(test, mutant_count):
        with tempfile.NamedTemporaryFile() as file:
            file.truncate(mutant_count)
            variables = {"GTEST_FILTER": test.case} if test.case else {}
            passes, seconds = run(test.command, test.folder, test.environment, 900, ISOCNC_REACHED=file.name, **variables)
            reached = [number for number, byte in enumerate(Path(file.name).read_bytes()) if byte]
        return test, passes, seconds, reached


def runs_of(tests, seconds_of, module, seconds):
    """The tests as commands with their variables, expected time and names: those of the module first, then those that take least; all cases of a
    program in one process, as far as the time goes."""
    by_program = collections.defaultdict(list)
    for test in tests:
        by_program[test.command if test.case else test].append(test)

    def rank(those):
        is_own = Path(those[0].command[0]).name.startswith(f"{module}_")
        return not is_own, sum(seconds_of[test] for test in those)

    left = seconds
    for those in sorted(by_program.values(), key=rank):
        chosen = []
        for test in sorted(those, key=lambda test: seconds_of[test]):
            if seconds_of[test] > left or sum(len(each.case) + 1 for each in chosen) > FILTER_BYTES:
                break
            left -= seconds_of[test]
            chosen.append(test)
        if chosen:
            variables = {"GTEST_FILTER": ":".join(test.case for test in chosen), "GTEST_FAIL_FAST": "1"} if chosen[0].case else {}
            yield chosen[0], variables, sum(seconds_of[test] for test in chosen), Path(chosen[0].command[0]).name


def outcome_of(number, mutant, tests, seconds):
    reaching = tests.reaching.get(number, [])
    module = Path(mutant.path).parent.name
    for test, variables, expected, name in runs_of(reaching, tests.seconds, module, seconds):
        passes, _ = run(test.command, test.folder, test.environment, 10 + 5 * expected, ISOCNC_MUTANT=str(number), **variables)
        if not passes:
            return Outcome("noticed", name, len(reaching))
    return Outcome("survived", "", len(reaching))


def outcomes_of(mutants, tests, seconds, jobs):
    """Each mutant with its outcome, as these become known."""
    with ThreadPoolExecutor(jobs) as pool:
        started = {pool.submit(outcome_of, number, mutant, tests, seconds): mutant for number, mutant in mutants.items()}
        for future in as_completed(started):
            yield started[future], future.result()
