"""An editor that speaks with isodap, notes all that comes, and complains where the protocol is broken."""

import json
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))

import editor  # noqa: E402
from failure import Failure, require  # noqa: E402
from language_client import PATIENCE  # noqa: E402
from world import World  # noqa: E402

STOPS = ("stopped", "terminated")


class DebugClient(editor.Client):
    def __init__(self, program: Path, world: World, environment: dict[str, str], log: Path):
        self.world = world
        self.seq = 0
        self.pending: dict[int, str] = {}
        self.answers: dict[int, dict] = {}
        self.stops: list[dict] = []
        self.events: dict[str, int] = {}  # How many of each have come.
        self.output = ""
        self.has_program = False  # Between launch and end.
        self.complaint = ""
        self.ignored_answers = 0
        self.log = log
        self.lock = threading.Lock()
        with open(log, "wb") as errors:
            super().__init__(program, env=environment, stderr=errors)

    def take(self, arrived, message):
        with self.changed:
            if message["type"] == "response" and self.ignored_answers > 0:
                self.ignored_answers -= 1
            elif message["type"] == "response":
                if self.pending.pop(message["request_seq"], None) is None:
                    self.complaint = f"an answer to nothing, or a second one: {json.dumps(message)[:300]}"
                self.answers[message["request_seq"]] = message
            else:
                event = message["event"]
                self.events[event] = self.events.get(event, 0) + 1
                if event == "terminated":
                    self.has_program = False
                if event in STOPS:
                    self.stops.append(message)
                elif event == "output":
                    self.output = (self.output + message["body"]["output"])[-2000:]
            self.changed.notify_all()

    def ask(self, command: str, arguments: dict) -> int:
        with self.changed:
            self.seq += 1
            seq = self.seq
            self.pending[seq] = command
        try:
            with self.lock:
                self.send({"seq": seq, "type": "request", "command": command, "arguments": arguments})
        except OSError as problem:
            raise Failure(f"the debugger takes nothing: {problem}; {self.errors()}") from problem
        return seq

    def wait_until(self, holds, what: str):
        """What `holds` says, once it is true."""
        deadline = time.monotonic() + PATIENCE
        with self.changed:
            while True:
                require(not self.complaint, self.complaint)
                if result := holds():
                    return result
                if self.has_ended:
                    raise Failure(f"the debugger has ended, status {self.process.wait(PATIENCE)}: {what}; {self.errors()}")
                require(time.monotonic() < deadline, f"nothing in {PATIENCE} s: {what}")
                if not self.changed.wait(0.2):
                    self.world.pass_time(60)  # For what runs by the clock.

    def respond(self, command: str, **arguments) -> dict:
        """The answer, whether it grants the request or not."""
        seq = self.ask(command, arguments)
        self.wait_until(lambda: seq in self.answers, f"answer to {command} {arguments}")
        with self.changed:
            return self.answers.pop(seq)

    def request(self, command: str, **arguments) -> dict:
        answer = self.respond(command, **arguments)
        require(answer["success"], f"{command} {arguments}: {answer.get('message')}")
        return answer.get("body") or {}

    def next_stop(self, what: str) -> dict:
        """The event that ends a run."""
        self.wait_until(lambda: self.stops, f"a stop after {what}")
        with self.changed:
            return self.stops.pop(0)

    def errors(self) -> str:
        return self.log.read_text(errors="replace")
