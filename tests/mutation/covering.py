"""Which tests reach which mutants, and which of these a test notices."""

import bisect
import collections
import dataclasses
import hashlib
import itertools
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

LEFT_OUT = "architecture_tests"  # Their own subject is the sources.
MEMORY = 8 << 30  # Bytes: a mutant may go on for ever.
IDLE_SECONDS = 30  # Of a test that waits and does nothing.
QUICK_SECONDS = 1
FILTER_BYTES = 100_000  # A variable of the environment holds 128 KiB at most.


@dataclasses.dataclass(frozen=True)
class Test:
    """A case of GoogleTest. Tests that are no program of GoogleTest take minutes each, and few mutants are noticed by these alone."""

    program: str
    folder: str
    case: str

    @property
    def name(self):
        return f"{Path(self.program).name} {self.case}"


@dataclasses.dataclass
class Outcome:
    kind: str = "untried"  # noticed, survived, explained
    by: str = ""  # The tests that noticed, or timed out.
    reaching: int = 0


def run(program, folder, seconds, **variables):
    """Whether a program ends with 0, or as skipped, and how long it took. Each of its processes may take this much processor time, so that a busy machine
    changes no result, and all of it ten times as long. One that waits for ever is ended sooner."""
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as temporary:
        process = subprocess.Popen(
            ["prlimit", f"--as={MEMORY}", f"--fsize={MEMORY}", f"--cpu={math.ceil(seconds)}", program],
            cwd=folder,
            env={**os.environ, "TMPDIR": temporary, **variables},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        passes = ends_in_time(process, begin + 10 * seconds) and process.returncode in (0, 77)
        try:
            os.killpg(process.pid, signal.SIGKILL)  # With all that it has started.
        except ProcessLookupError:
            pass
        process.wait()
    return passes, time.perf_counter() - begin


def ends_in_time(process, deadline):
    """Waits for a process. False where it still runs at the deadline, or where neither it nor what it has started takes any processor time for long."""
    used = -1
    worked = time.perf_counter()
    while (now := time.perf_counter()) < deadline and now < worked + IDLE_SECONDS:
        try:
            process.wait(1)
            return True
        except subprocess.TimeoutExpired:
            if (ticks := processor_ticks(process.pid)) != used:
                used, worked = ticks, time.perf_counter()
    return False


def processor_ticks(group):
    """What all processes of a group have taken."""
    ticks = 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # It has just ended.
            continue
        if int(fields[2]) == group:
            ticks += sum(map(int, fields[11:15]))
    return ticks


class Tests:
    """The tests that pass without any mutant, how long each takes, and what it reaches."""

    def __init__(self, build, mutant_count, jobs, programs=(), known=None):
        """`programs`: the names of those that count; without them all. `known`: a file with what each program was found to reach, which is right for as long
        as the program is the same to the byte."""
        self.seconds = {}  # Without the start of the program.
        self.reaching = collections.defaultdict(list)  # By number of mutant.
        found = json.loads(known.read_text()) if known and known.is_file() else {}
        with ThreadPoolExecutor(jobs) as pool:
            for program, folder in self.programs_of(build, programs):
                digest = hashlib.sha256(Path(program).read_bytes()).hexdigest()
                if found.get(program, {}).get("digest") != digest:
                    looked = pool.map(lambda test: self.look_at(test, mutant_count), self.cases_of(program, folder))
                    found[program] = {"digest": digest, "cases": list(looked)}
                    if known:
                        known.write_text(json.dumps(found))
                self.add(program, folder, found[program]["cases"])
        print(f"mutate: {len(self.seconds)} tests, {sum(self.seconds.values()):.0f} s", flush=True)

    def add(self, program, folder, cases):
        start = min((seconds for _, passes, seconds, _ in cases if passes), default=0)
        for case, passes, seconds, reached in cases:
            test = Test(program, folder, case)
            if not passes:
                print(f"mutate: left out, as it fails without a mutant: {test.name}", file=sys.stderr)
                continue
            self.seconds[test] = seconds - start
            for mutant in reached:
                self.reaching[mutant].append(test)

    @staticmethod
    def programs_of(build, programs):
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, text=True, check=True).stdout
        found = {}
        for entry in json.loads(listed)["tests"]:
            properties = {each["name"]: each["value"] for each in entry["properties"]}
            if "command" in entry and not properties.get("DISABLED"):
                found[entry["command"][0]] = properties["WORKING_DIRECTORY"]
        for program, folder in found.items():
            name = Path(program).name
            if name.endswith("_tests") and name != LEFT_OUT and (not programs or name in programs):
                yield program, folder

    @staticmethod
    def cases_of(program, folder):
        listed = subprocess.run([program, "--gtest_list_tests"], cwd=folder, capture_output=True, text=True, check=True).stdout
        suite = ""
        for line in listed.splitlines():
            name = line.split("#", 1)[0].rstrip()
            if not line.startswith(" "):
                suite = name if name.endswith(".") else ""
            elif suite and "DISABLED_" not in name:
                yield Test(program, folder, suite + name.strip())

    @staticmethod
    def look_at(test, mutant_count):
        with tempfile.NamedTemporaryFile() as file:
            file.truncate(mutant_count)
            passes, seconds = run(test.program, test.folder, 900, ISOCNC_REACHED=file.name, GTEST_FILTER=test.case)
            reached = [number for number, byte in enumerate(Path(file.name).read_bytes()) if byte]
        return test.case, passes, seconds, reached


def runs_of(tests, seconds_of, module, seconds):
    """The tests as lists of cases of one program, and the time that these take: first what is quick in each program, which notices most mutants, then the
    rest; within both, the tests of the module first. `seconds` are for the tests of the module, and as much for the others."""
    by_program = collections.defaultdict(list)
    for test in sorted(tests, key=lambda test: seconds_of[test]):
        by_program[test.program].append(test)
    quick, slow = [], []
    for those in by_program.values():
        sums = list(itertools.accumulate(seconds_of[test] for test in those))
        count = bisect.bisect_right(sums, QUICK_SECONDS)
        quick.append(those[:count])
        slow.append(those[count:])

    def is_own(test):
        return Path(test.program).name.startswith(f"{module}_")

    def rank(those):
        return not is_own(those[0]), sum(seconds_of[test] for test in those)

    left = {True: seconds, False: seconds}
    for those in sorted(filter(None, quick), key=rank) + sorted(filter(None, slow), key=rank):
        chosen = []
        for test in those:
            if seconds_of[test] > left[is_own(test)] or sum(len(each.case) + 1 for each in chosen) > FILTER_BYTES:
                break
            left[is_own(test)] -= seconds_of[test]
            chosen.append(test)
        if chosen:
            yield chosen, sum(seconds_of[test] for test in chosen)


def outcome_of(number, mutant, tests, seconds):
    reaching = tests.reaching.get(number, [])
    module = Path(mutant.path).parent.name
    for chosen, expected in runs_of(reaching, tests.seconds, module, seconds):
        cases = ":".join(test.case for test in chosen)
        variables = {"ISOCNC_MUTANT": str(number), "GTEST_FILTER": cases, "GTEST_FAIL_FAST": "1"}
        passes, _ = run(chosen[0].program, chosen[0].folder, 5 + 3 * expected, **variables)
        if not passes:
            return Outcome("noticed", Path(chosen[0].program).name, len(reaching))
    return Outcome("survived", "", len(reaching))


def outcomes_of(mutants, tests, seconds, jobs):
    """Each mutant with its outcome, as these become known."""
    with ThreadPoolExecutor(jobs) as pool:
        started = {pool.submit(outcome_of, number, mutant, tests, seconds): mutant for number, mutant in mutants.items()}
        for future in as_completed(started):
            yield started[future], future.result()
