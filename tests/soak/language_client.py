"""An editor that speaks with isols, notes all that comes, and complains where the protocol is broken."""

import json
import subprocess
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))

import editor  # noqa: E402
from failure import Failure, require  # noqa: E402

# Seconds. Whoever takes longer hangs.
PATIENCE = 60
CANCELLED = -32800


class LanguageClient(editor.Client):
    patience = PATIENCE

    def __init__(self, program: Path, environment: dict[str, str], log: Path):
        self.lock = threading.Lock()
        self.next_id = 1
        self.pending: dict[int, str] = {}  # Methods by id.
        self.answers: dict[int, dict] = {}
        self.published: dict[str, dict] = {}  # The last parameters of publishDiagnostics by URI.
        self.edits: list[dict] = []  # That the server asks to apply.
        self.registrations: dict[str, dict] = {}
        self.shown_progress: set[str] = set()
        self.complaint = ""
        self.reads = True
        self.ignored_answers = 0
        self.log = log
        with open(log, "wb") as errors:
            super().__init__(program, env=environment, stderr=errors)

    # --- What comes, on the reader's thread

    def take(self, arrived, message):
        if not self.reads:
            self.process.stdout.close()
            sys.exit()  # This thread.
        with self.changed:
            try:
                if "method" not in message:
                    self.take_answer(message)
                elif "id" in message:
                    self.take_request(message)
                else:
                    self.take_notification(message["method"], message["params"])
            except (Failure, KeyError, TypeError) as problem:
                self.complaint = self.complaint or f"{type(problem).__name__} {problem}: {json.dumps(message)[:500]}"
            self.changed.notify_all()

    def take_answer(self, message):
        number = message["id"]
        if self.ignored_answers > 0:
            self.ignored_answers -= 1
            return
        require(number in self.pending, "an answer to nothing, or a second one")
        require(("result" in message) != ("error" in message), "an answer has a result or an error")
        del self.pending[number]
        self.answers[number] = message

    def take_request(self, message):
        method, params = message["method"], message.get("params")
        result = None
        if method == "client/registerCapability":
            for each in params["registrations"]:
                require(each["id"] not in self.registrations, "a capability is registered twice")
                self.registrations[each["id"]] = each
        elif method == "client/unregisterCapability":
            for each in params["unregisterations"]:
                del self.registrations[each["id"]]
        elif method == "workspace/applyEdit":
            self.edits.append(params["edit"])
            result = {"applied": True}
        elif method == "window/workDoneProgress/create":
            require(params["token"] not in self.shown_progress, "a progress is created twice")
            self.shown_progress.add(params["token"])
        elif method == "window/showDocument":
            result = {"success": True}
        else:
            require(method.endswith("/refresh"), "a request that no client knows")
        self.send({"id": message["id"], "result": result})

    def take_notification(self, method, params):
        if method == "textDocument/publishDiagnostics":
            self.published[params["uri"]] = params
        elif method == "$/progress":
            if params["value"].get("kind") == "end":
                self.shown_progress.discard(params["token"])
        elif method == "window/logMessage":
            # The only errors are about messages that are wrong, which the day sends on purpose.
            require("wrong on purpose" in params["message"] or params["type"] > 1, "the server logs an error")
        else:
            require(method == "window/showMessage", "a notification that no client knows")

    # --- What is sent

    def send(self, message):
        self.send_text(json.dumps({"jsonrpc": "2.0", **message}).encode())

    def send_text(self, body: bytes):
        try:
            with self.lock:
                self.send_bytes(body)
        except (OSError, ValueError) as problem:  # ValueError: we have closed it.
            raise Failure(f"the server takes nothing: {problem}; {self.errors()}") from problem

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def ask(self, method, params) -> int:
        with self.changed:
            number = self.next_id
            self.next_id += 1
            self.pending[number] = method
        self.send({"id": number, "method": method, "params": params})
        return number

    def wait_until(self, holds, what: str):
        """What `holds` says, once it is true."""
        deadline = time.monotonic() + self.patience
        with self.changed:
            while True:
                self.check()
                if result := holds():
                    return result
                if self.has_ended:
                    raise Failure(f"the server has ended, status {self.process.wait(PATIENCE)}: {what}; {self.errors()}")
                if not self.changed.wait(max(0.0, deadline - time.monotonic())):
                    raise Failure(f"nothing in {self.patience} s: {what}")

    def answer(self, number: int) -> dict:
        method = self.pending.get(number, "")
        self.wait_until(lambda: number in self.answers, f"answer {number} to {method}")
        with self.changed:
            return self.answers.pop(number)

    def request(self, method, params) -> dict:
        """The answer, with its result or its error."""
        return self.answer(self.ask(method, params))

    def check(self):
        require(not self.complaint, self.complaint)

    def errors(self) -> str:
        return self.log.read_text(errors="replace")

    # --- Its life

    def start(self, params: dict) -> dict:
        answer = self.request("initialize", params)
        require("result" in answer, f"initialize: {answer}")
        self.notify("initialized", {})
        return answer["result"]["capabilities"]

    def wait_for_all_answers(self):
        self.wait_until(lambda: not self.pending, "answers to all requests")
        with self.changed:
            self.answers.clear()

    def status_at_end(self, what: str) -> int:
        try:
            return self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            raise Failure(f"{what}: the server goes on") from None

    def stop(self):
        """In order, as an editor does that is closed."""
        self.request("shutdown", None)
        self.notify("exit", None)
        require(self.status_at_end("exit") == 0, f"exit after shutdown: status {self.process.returncode}; {self.errors()}")
        self.check()
        require(not self.pending, f"no answer to {self.pending}")
        require(not self.errors(), f"standard error: {self.errors()}")
