"""A shop's day with the debugger: walks through programs, and what a fresh session shows at the same place."""

import json
import random
import subprocess
import tempfile
from pathlib import Path

from day import Day
from debug_client import DebugClient
from failure import Failure, require
from shop import MACHINES, SETUPS, generated

WALKS_PER_HOUR = 40  # Each in a program of its own, in the same process or a new one.
STEPS = 25  # In a walk.
LIVES_PER_DAY = 4  # Of the process that is restarted again and again.
SHORT_SESSIONS = 4  # For each walk of that process, one of so many is in a process of its own.
WALK_S = 3600 / WALKS_PER_HOUR

MAX_THREADS = 8

FILTERS = ("errors", "warnings", "limits", "contacts", "run", "toolChange", "firstCut")
EXPRESSIONS = ("X", "Z + 1", "XM", "F", "S", "T", "V3,x", "LINE", "TIME", "CLEARANCE", "REMOVED", "MOTION", "nothing", "1 +", "VGPL && 1")


class DebuggerDay(Day):
    def __init__(self, programs: Path, seed: int, hours: float, fault: str, folder: Path):
        super().__init__(programs / "isodap", seed, "debugged", fault, folder, MAX_THREADS)
        self.walks = max(4, round(hours * WALKS_PER_HOUR))
        self.shop.write(self.shop.root / "jobs/isocnc.json", json.dumps(MACHINES[2]).encode())
        self.shop.write(self.shop.root / "jobs/job40-0.setup.json", SETUPS[0])
        self.standard = self.shop.root / "jobs/measured.iso"
        self.shop.write(self.standard, generated(random.Random(seed), 300).encode())
        self.clients: list[DebugClient] = []

    # --- Sessions

    def new_client(self) -> DebugClient:
        client = DebugClient(self.program, self.world, self.environment(), self.next_log())
        self.clients.append(client)
        client.request("initialize", adapterID="isocnc", supportsInvalidatedEvent=True, supportsProgressReporting=True)
        return client

    def launch(self, client: DebugClient, file: Path, **more) -> None:
        """Stops before the first block, without breakpoints."""
        arguments = {"program": str(file), "stopOnEntry": True, **more}
        is_new = not client.has_program
        if is_new:
            client.has_program = True
            client.request("launch", **arguments)
        else:
            client.request("restart", arguments=arguments)
            client.next_stop("restart")
        client.request("setExceptionBreakpoints", filters=[])
        client.request("setFunctionBreakpoints", breakpoints=[])
        client.request("setDataBreakpoints", breakpoints=[])
        client.request("setBreakpoints", source={"path": str(file)}, breakpoints=[])
        if is_new:
            client.request("configurationDone")
            client.next_stop("launch")

    def end(self, client: DebugClient) -> None:
        """In order, or by a crash of the editor."""
        way = self.choices.choice(["disconnect", "disconnect", "closed pipes", "half a message", "while it runs"])
        if way == "disconnect":
            client.request("disconnect")
            expected = 0
        else:
            expected = 1
            if way == "while it runs":
                client.ask("continue", {"threadId": 1})
            elif way == "half a message":
                client.process.stdin.write(b'Content-Length: 70\r\n\r\n{"seq":')
            client.process.stdin.close()
        try:
            status = client.process.wait(60)
        except subprocess.TimeoutExpired:
            raise Failure(f"{way}: the debugger goes on") from None
        require(status == expected, f"{way}: exit status {status}; {client.errors()}")
        require(not client.errors(), f"standard error: {client.errors()}")
        self.clients.remove(client)
        self.count(f"end: {way}")

    # --- Walks

    def state(self, client: DebugClient) -> dict:
        """All that an editor shows of a place."""
        stack = client.request("stackTrace", threadId=1)["stackFrames"]
        shown: dict = {"stack": [[frame["name"], frame["line"]] for frame in stack]}
        for scope in client.request("scopes", frameId=stack[0]["id"])["scopes"]:
            shown[scope["name"]] = self.variables(client, scope["variablesReference"], 3)
        return shown

    def variables(self, client: DebugClient, reference: int, depth: int) -> list:
        found = []
        for each in client.request("variables", variablesReference=reference)["variables"]:
            below = each["variablesReference"]
            found.append([each["name"], each["value"], self.variables(client, below, depth - 1) if below and depth else []])
        return found

    def run(self, client: DebugClient, command: str, **more) -> bool:
        """Whether the program goes on to exist. What the debugger refuses changes nothing."""
        answer = client.respond(command, threadId=1, **more)
        if not answer["success"]:
            self.count(f"refused: {command}")
            return True
        return self.goes_on(client, client.next_stop(command))

    @staticmethod
    def goes_on(client: DebugClient, stop: dict) -> bool:
        return stop["event"] == "stopped" and client.has_program

    def set_breakpoints(self, client: DebugClient, file: Path, lines: int) -> None:
        conditions = ({}, {}, {"condition": "Z < 0"}, {"hitCondition": "%3"}, {"logMessage": "Z is {Z,2}"}, {"condition": "V1 == 2"}, {"condition": "(("})
        chosen = [{"line": self.choices.randrange(1, lines + 3), **self.choices.choice(conditions)} for _ in range(self.choices.randrange(6))]
        client.request("setBreakpoints", source={"path": str(file)}, breakpoints=chosen)
        kind = self.choices.randrange(4)
        if kind == 0:
            client.respond("setFunctionBreakpoints", breakpoints=[{"name": self.choices.choice(["M06", "G29", "T101001", "nothing"])}])
        elif kind == 1:
            client.respond("setDataBreakpoints", breakpoints=[{"dataId": self.choices.choice(["Z = 0", "F", "V1", "CLEARANCE < 5", "INCUT"])}])
        elif kind == 2:
            chosen_filters = self.choices.sample(FILTERS, 2)
            client.respond("setExceptionBreakpoints", filters=chosen_filters)

    def step(self, client: DebugClient, file: Path, lines: int, changes: bool) -> bool:
        kind = self.choices.randrange(14)
        if kind < 3:
            return self.run(client, self.choice_of("next", "stepIn", "stepOut"))
        if kind < 6:
            return self.run(client, "stepBack", **self.choices.choice([{}, {"granularity": "instruction"}]))
        if kind == 6:
            return self.run(client, "reverseContinue")
        if kind == 7:
            return self.run(client, "continue")
        if kind == 8:
            # A pause that comes too late is refused, or has nothing to stop.
            if not client.respond("continue", threadId=1)["success"]:
                return True
            client.respond("pause", threadId=1)
            return self.goes_on(client, client.next_stop("pause"))
        if kind == 9:
            targets = client.request("gotoTargets", source={"path": str(file)}, line=self.choices.randrange(1, lines + 1))["targets"]
            return self.run(client, "goto", targetId=targets[0]["id"]) if targets else True
        if kind == 10:
            self.set_breakpoints(client, file, lines)
        elif kind == 11 and changes:
            self.change_something(client)
        elif kind in (11, 12):
            self.look(client)
        else:
            self.world.jump("real", self.choices.choice([86400, -3600, 0.5]))
            if self.chance(0.3):
                self.world.jump("monotonic", self.choices.choice([1, 3600]))
        return True

    def choice_of(self, *names: str) -> str:
        return self.choices.choice(names)

    def change_something(self, client: DebugClient) -> None:
        """Values and blocks by hand."""
        kind = self.choices.randrange(3)
        if kind == 0:
            client.respond("setExpression", expression=self.choice_of("V1", "V3", "VGPL", "S", "F", "OVERRIDE", "X"), value=self.choice_of("2", "120", "1 + 1", "x"))
        elif kind == 1:
            block = self.choice_of("G00 X5 Y7", "G91", "X3", "M05", "G17 G18", "G909", "difference job40-1.iso")
            if client.respond("evaluate", expression=block, context="repl")["success"] and block.startswith("difference"):
                client.next_stop(block)
        else:
            scopes = client.request("scopes", frameId=1)["scopes"]
            scope = self.choices.choice(scopes)
            found = client.request("variables", variablesReference=scope["variablesReference"])["variables"]
            if found:
                client.respond("setVariable", variablesReference=scope["variablesReference"], name=self.choices.choice(found)["name"], value="3")

    def look(self, client: DebugClient) -> None:
        for expression in self.choices.sample(EXPRESSIONS, 3):
            client.respond("evaluate", expression=expression, context=self.choice_of("watch", "hover"))
        client.respond("completions", text="G0", column=3)
        client.respond("breakpointLocations", source={}, line=1, endLine=20)
        client.respond("loadedSources")
        client.respond("exceptionInfo", threadId=1)
        client.respond("dataBreakpointInfo", name=self.choice_of("X", "V1", "nothing"))
        client.respond("source", source={"sourceReference": 0}, sourceReference=0)
        client.respond("cancel", requestId=1)
        require(not client.respond("isocnc/nothing")["success"], "a request that does not exist is granted")

    def walk(self, client: DebugClient, file: Path, changes: bool) -> None:
        """Steps in any order, until the program ends."""
        lines = self.shop.files[file].count(b"\n") + 1
        for step in range(STEPS):
            self.place = f"{self.place.split(';')[0]}; {file.name}, step {step}"
            if changes and self.chance(0.03):
                self.shop.write(file, self.shop.files[file] + b"; changed meanwhile\n")
            if not self.step(client, file, lines, changes):
                return
            self.world.pass_time(WALK_S / STEPS / 2)

    def compare(self, client: DebugClient, file: Path, launched: dict) -> None:
        """At a block that both can reach, the state after a walk is that of a session that goes straight there."""
        lines = self.shop.files[file].count(b"\n") + 1
        fresh = self.new_client()
        self.launch(fresh, file, **(launched | {"registers": {"V3": 7}} if self.fault == "answer" else launched))
        compared = 0
        for line in sorted(self.choices.randrange(1, lines + 1) for _ in range(8)):
            for each in (client, fresh):
                targets = each.request("gotoTargets", source={"path": str(file)}, line=line)["targets"]
                if not targets:
                    break
                self.run(each, "goto", targetId=targets[0]["id"])
            if not targets:
                continue
            old, new = self.state(client), self.state(fresh)
            # Where the run does not lead, both stay where they are.
            are_there = [targets[0]["line"] in (frame[1] for frame in each["stack"]) for each in (old, new)]
            if not any(are_there):
                continue
            require(old == new, f"not the state of a fresh session at line {line} of {file.name}\nold:   {difference(old, new)}\nfresh: {difference(new, old)}")
            compared += 1
        # A session that has never gone to a line, but block by block, and one backward.
        for command in ("next", "next", "stepBack") if compared else ():
            ends = [self.run(each, command) for each in (client, fresh)]
            require(ends[0] == ends[1], f"{command} ends in one session alone")
            if not ends[0]:
                break
            old, new = self.state(client), self.state(fresh)
            require(old == new, f"{command}: not the state of a fresh session in {file.name}\nold:   {difference(old, new)}\nfresh: {difference(new, old)}")
            compared += 1
        self.counts["states compared"] = self.counts.get("states compared", 0) + compared
        self.end(fresh)

    def measure(self, client: DebugClient) -> None:
        """The memory of the debugger at the start of the same program."""
        self.launch(client, self.standard)
        self.run(client, "continue")
        self.launch(client, self.standard)
        self.flatness.measure(client)

    # --- The day

    def day(self) -> None:
        life = max(2, self.walks // LIVES_PER_DAY) if self.walks > 200 else self.walks
        client = None
        for number in range(self.walks):
            self.choices = random.Random(f"{self.seed}/{number}")
            seconds = round(number * WALK_S)
            self.place = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}, walk {number}"
            if number % life == 0:
                if client:
                    self.flatness.judge()
                    self.end(client)
                client = self.new_client()
                self.launch(client, self.standard)
            file = self.choices.choice([each for each in sorted(self.shop.programs()) if not self.shop.is_on_network(each)])
            launched: dict = {"vgpl": self.choices.randrange(3), "registers": {"V3": self.choices.randrange(5)}}
            session = client
            if number % SHORT_SESSIONS == 0:
                session = self.new_client()
                self.launch(session, file, **launched, **({"speed": 50} if self.chance(0.1) else {}))
            else:
                self.launch(session, file, **launched)
            self.count("walks")
            # What was changed by hand is gone when the program is launched anew; a second walk changes nothing.
            self.walk(session, file, changes=True)
            self.launch(session, file, **launched)
            self.walk(session, file, changes=False)
            if not session.has_program:
                self.launch(session, file, **launched)
            self.compare(session, file, launched)
            if session is client:
                self.measure(client)
            else:
                self.end(session)
            if number % 20 == 19:
                self.shop.check()
        self.flatness.judge()
        self.end(client)
        self.shop.check()
        require(not list(self.temporary.iterdir()), f"temporary files: {list(self.temporary.iterdir())}")
        require(self.world.clock_reads() > 0, "the clocks were not used")

    def summary(self) -> str:
        return "\n".join([*self.flatness.report, "; ".join(f"{name}: {count}" for name, count in sorted(self.counts.items()))])


def difference(a: dict, b: dict) -> str:
    return json.dumps({name: [x for x in value if x not in b.get(name, [])] for name, value in a.items() if value != b.get(name)}, ensure_ascii=False)[:1500]


def run(programs: Path, seed: int, hours: float, fault: str) -> str:
    """What has been done."""
    with tempfile.TemporaryDirectory(prefix="isocnc-soak-") as name:
        day = DebuggerDay(programs, seed, hours, fault, Path(name).resolve())
        try:
            day.day()
        except Exception as problem:
            raise Failure(f"isodap, seed {seed}, at {day.place}: {problem or type(problem).__name__}") from problem
        finally:
            for client in day.clients:
                client.process.kill()
        return day.summary()


