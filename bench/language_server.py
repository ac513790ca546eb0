#!/usr/bin/env python3
"""Times isols on generated programs, as an editor sees it, and holds the figures against their targets.

Speaks with the server through pipes. Prints a Markdown table. Exit status: 0 every target met, 1 some missed, 2 could not
measure.
"""

import argparse
import json
import random
import re
import tempfile
import time
from pathlib import Path

import compare
import editor

KINDS = [*compare.CLEAN_KINDS, *compare.PATH_KINDS, "errors"]

OPEN_S = 0.5
EDIT_P50_MS = 1.0
EDIT_P99_MS = 5.0
REQUEST_P99_MS = 5.0
BYTES_PER_LINE = 200
VERIFIED_S = 0.3
NEAREST_P99_MS = 50.0

VERIFIED_KINDS = ["short", "fiveaxis"]
VERIFIED_LINES = 10_000
VERIFIED_EDITS = 9
PAUSE_S = 1.0  # The pause in typing after which isols verifies a program.


class Server(editor.Client):
    """A server, and what it takes."""

    def __init__(self, program):
        super().__init__(program)
        self.next_id = 1
        self.request("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        self.notify("initialized", {})

    def send(self, message):
        super().send({"jsonrpc": "2.0", **message})

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def request(self, method, params):
        """Seconds until the answer."""
        request = self.next_id
        self.next_id += 1
        start = time.perf_counter()
        self.send({"id": request, "method": method, "params": params})
        arrived, message = self.wait(lambda each: each.get("id") == request)
        if "error" in message:
            raise editor.CannotMeasure(f"{method}: {message['error']}")
        return arrived - start

    @staticmethod
    def are_diagnostics(message, uri, version):
        params = message.get("params")
        is_published = message.get("method") == "textDocument/publishDiagnostics"
        return is_published and params["uri"] == uri and params.get("version") == version

    def wait_for_diagnostics(self, uri, version):
        return self.wait(lambda each: self.are_diagnostics(each, uri, version))[0]

    def has_diagnostics(self, uri, version):
        with self.changed:
            return any(self.are_diagnostics(message, uri, version) for _, message in self.messages)

    def open(self, uri, text):
        """Sends a document; the time at which that began."""
        document = {"uri": uri, "languageId": "isocnc", "version": 1, "text": text}
        body = json.dumps({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}})
        start = time.perf_counter()
        self.send_bytes(body.encode())
        return start

    def stop(self):
        self.request("shutdown", None)
        self.notify("exit", None)
        self.process.wait(timeout=60)


def percentile(times, share):
    return 1000 * sorted(times)[min(len(times) - 1, int(share * len(times)))]


def replaced_digit(line, choices):
    """Where a digit stands on a line, and another one for it; None where there is none."""
    digits = [match.start() for match in re.finditer(r"(?<=[0-9.])[0-9]", line) if line[0] in "XYGN"]
    return (choices.choice(digits), choices.choice("123456789")) if digits else None


def digit_edits(uri, lines, end, count):
    """`count` versions from 2 on, each with the change of one digit in any line before `end`."""
    choices = random.Random(editor.SEED)
    version = 1
    while version <= count:
        number = choices.randrange(end)
        edit = replaced_digit(lines[number], choices)
        if not edit:
            continue
        column, digit = edit
        version += 1
        place = {"start": {"line": number, "character": column}, "end": {"line": number, "character": column + 1}}
        yield version, {
            "textDocument": {"uri": uri, "version": version},
            "contentChanges": [{"range": place, "text": digit}],
        }


def edit_times(server, uri, lines, count):
    """Seconds from one changed digit to the diagnostics, anywhere in the program."""
    times = []
    for version, change in digit_edits(uri, lines, len(lines), count):
        start = time.perf_counter()
        server.notify("textDocument/didChange", change)
        times.append(server.wait_for_diagnostics(uri, version) - start)
    return times


REQUESTS = {
    "hover": "textDocument/hover",
    "completion": "textDocument/completion",
    "tokens": "textDocument/semanticTokens/range",
}
SCREEN = 60  # Lines.


def request_times(server, uri, lines, goes_on):
    """Seconds that requests take, by name, one after another anywhere in the program, as long as `goes_on(so many)`."""
    choices = random.Random(editor.SEED)
    times = {name: [] for name in REQUESTS}
    while goes_on(len(times["tokens"])):
        for name, method in REQUESTS.items():
            number = choices.randrange(len(lines))
            start = {"line": number, "character": choices.randrange(1 + len(lines[number]))}
            screen = {"start": start, "end": {"line": number + SCREEN, "character": 0}}
            place = {"range": screen} if name == "tokens" else {"position": start}
            times[name].append(server.request(method, {"textDocument": {"uri": uri}, **place}))
    return times


def add_requests(table, program, times):
    for name, each in times.items():
        table.add(program, f"{name}, p99", percentile(each, 0.99), REQUEST_P99_MS, "ms")


def measure_kind(arguments, kind, table):
    text = editor.corpus(arguments.build, kind, arguments.lines).decode()
    lines = text.split("\n")
    server = Server(arguments.build / "bin/isols")
    before = server.anonymous_bytes()
    uri = f"file:///bench/{kind}.iso"
    start = server.open(uri, text)
    opened = server.wait_for_diagnostics(uri, 1) - start
    time.sleep(0.5)  # Until the memory of the message has been given back.
    size = (server.anonymous_bytes() - before - len(text)) / len(lines)
    edits = edit_times(server, uri, lines, arguments.edits)
    requests = request_times(server, uri, lines, lambda done: done < arguments.edits)
    name = f"{kind}, {arguments.lines} lines"
    table.add(name, "open to diagnostics", opened, OPEN_S, "s")
    table.add(name, "edit to diagnostics, p50", percentile(edits, 0.5), EDIT_P50_MS, "ms")
    table.add(name, "edit to diagnostics, p99", percentile(edits, 0.99), EDIT_P99_MS, "ms")
    add_requests(table, name, requests)
    table.add(name, "memory over the text, a line", size, BYTES_PER_LINE, "bytes")
    server.stop()


def measure_together(arguments, table):
    """Several programs open in one server, one of each kind in turn, and edits in one after the other."""
    kinds = [KINDS[i % len(KINDS)] for i in range(arguments.together)]
    texts = {kind: editor.corpus(arguments.build, kind, arguments.lines).decode() for kind in set(kinds)}
    server = Server(arguments.build / "bin/isols")
    before = server.anonymous_bytes()
    opened = []
    for i, kind in enumerate(kinds):
        uri = f"file:///bench/{i}.iso"
        start = server.open(uri, texts[kind])
        opened.append(server.wait_for_diagnostics(uri, 1) - start)
    size = server.anonymous_bytes() - before - sum(len(texts[kind]) for kind in kinds)
    name = f"{len(kinds)} programs of {arguments.lines} lines"
    table.add(name, "open to diagnostics, the slowest", max(opened), OPEN_S, "s")
    table.add(name, "memory over the text, a line", size / (arguments.lines * len(kinds)), BYTES_PER_LINE, "bytes")
    lines = {kind: text.split("\n") for kind, text in texts.items()}
    edits = [digit_edits(f"file:///bench/{i}.iso", lines[kind], len(lines[kind]), arguments.edits) for i, kind in enumerate(kinds)]
    times = {kind: [] for kind in kinds}
    for changes in zip(*edits):
        for kind, (version, change) in zip(kinds, changes):
            start = time.perf_counter()
            server.notify("textDocument/didChange", change)
            times[kind].append(server.wait_for_diagnostics(change["textDocument"]["uri"], version) - start)
    for kind, each in times.items():
        table.add(f"{name}, {kind}", "edit to diagnostics, p50", percentile(each, 0.5), EDIT_P50_MS, "ms")
        table.add(f"{name}, {kind}", "edit to diagnostics, p99", percentile(each, 0.99), EDIT_P99_MS, "ms")
    server.stop()


def measure_beside_big(arguments, table):
    """Requests about one document while a huge one is being opened in another tab."""
    text = editor.corpus(arguments.build, "short", 20_000).decode()
    big = editor.corpus(arguments.build, "short", arguments.big).decode()
    server = Server(arguments.build / "bin/isols")
    uri = "file:///bench/small.iso"
    server.open(uri, text)
    server.wait_for_diagnostics(uri, 1)
    server.open("file:///bench/big.iso", big)
    def is_opening(_):
        return not server.has_diagnostics("file:///bench/big.iso", 1)

    times = request_times(server, uri, text.split("\n"), is_opening)
    add_requests(table, f"short, beside {arguments.big} lines", times)
    server.stop()


def fixture(number, middle, size):
    box = [[m - s / 2 for m, s in zip(middle, size)], [m + s / 2 for m, s in zip(middle, size)]]
    return {"name": f"fixture {number}", "box": box}


def surroundings(kind):
    """A machine with a holder and a nose, and 24 fixtures around what the programs do: 12 cups below it, and 12 clamps
    beside it, of which the last one is hit by what `into_a_clamp` adds."""
    is_head = kind == "fiveaxis"
    top, side = (-125, 520) if is_head else (-18, 330)
    cups = [((-225 + 150 * i, -200 + 200 * j, top - 30), (120, 120, 60)) for i in range(4) for j in range(3)]
    rows = [((at, sign * side, 0), (60, 40, 40)) for at in (-200, 0, 200) for sign in (-1, 1)]
    columns = [((sign * side, at, 0), (40, 60, 40)) for at in (-200, 0, 200) for sign in (-1, 1)]
    tool = {"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 5, "shape": "flat", "cutLength": 60, "body": "ER"}
    machine = {
        "kinematics": {"type": "head" if is_head else "three-axis"},
        "home": {"z": 400},
        "tools": [tool],
        "holders": {"ER": [[40, 40, 50]]},
        "nose": [[120, 120, 150]],
    }
    fixtures = [fixture(i + 1, *each) for i, each in enumerate(cups + rows + columns)]
    return {"machine": machine, "setups": [{"paths": ["*.iso"], "frame": "machine", "fixtures": fixtures}]}, side


def into_a_clamp(text, side):
    before, end = text.rsplit("M05", 1)
    return f"{before}G00 Z60 B0 C0\nX{side} Y200\nZ10\nZ60\nM05{end}"


def verified_edit_times(server, uri, lines, count):
    """Seconds from one changed digit to what the machine shows of the new text, without the pause in typing."""

    def are_verified(message):
        if not Server.are_diagnostics(message, uri, version):
            return False
        of_machine = [each for each in message["params"]["diagnostics"] if each["source"] == "isocnc verify"]
        return bool(of_machine) and not any(1 in each.get("tags", []) for each in of_machine)

    version = 1
    server.wait(are_verified)
    times = []
    for version, change in digit_edits(uri, lines, len(lines) - 10, count):
        start = time.perf_counter()
        server.notify("textDocument/didChange", change)
        times.append(server.wait(are_verified)[0] - start - PAUSE_S)
    return times


def measure_verification(arguments, kind, table):
    """What the machine would hit, after an edit; and hovers that say how near a motion comes to it."""
    described, side = surroundings(kind)
    text = into_a_clamp(editor.corpus(arguments.build, kind, VERIFIED_LINES).decode(), side)
    lines = text.split("\n")
    name = f"{kind}, {len(lines)} lines, 24 fixtures"
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "isocnc.json").write_text(json.dumps(described), encoding="ascii")
        server = Server(arguments.build / "bin/isols")
        uri = (Path(folder) / "part.iso").resolve().as_uri()
        server.open(uri, text)
        edits = verified_edit_times(server, uri, lines, VERIFIED_EDITS)
        table.add(name, "edit to what the machine would hit, median", percentile(edits, 0.5) / 1000, VERIFIED_S, "s")
        hovers = []
        choices = random.Random(editor.SEED)
        while len(hovers) < arguments.edits:
            number = choices.randrange(len(lines) - 1)
            if lines[number][:1] not in ("X", "Y", "Z"):
                continue
            place = {"textDocument": {"uri": uri}, "position": {"line": number, "character": 0}}
            hovers.append(server.request("textDocument/hover", place))
        table.add(name, "hover on a motion, p99", percentile(hovers, 0.99), NEAREST_P99_MS, "ms")
        server.stop()


class Table:
    def __init__(self):
        self.missed = False
        print("| program | what | measured | target | met |\n|---|---|---|---|---|")

    def add(self, program, what, measured, target, unit):
        met = measured <= target
        self.missed |= not met
        print(f"| {program} | {what} | {measured:.2f} {unit} | at most {target} {unit} | {'yes' if met else '**no**'} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--verified", default=",".join(VERIFIED_KINDS), help="kinds that are verified with a setup")
    parser.add_argument("--lines", type=int, default=1_000_000)
    parser.add_argument("--big", type=int, default=10_000_000, help="0 leaves the big program out")
    parser.add_argument("--together", type=int, default=10, help="programs open at once; 0 leaves them out")
    parser.add_argument("--edits", type=int, default=400)
    parser.add_argument("--build", type=Path, default=editor.BUILD)
    arguments = parser.parse_args()
    table = Table()
    for kind in filter(None, arguments.kinds.split(",")):
        measure_kind(arguments, kind, table)
    for kind in filter(None, arguments.verified.split(",")):
        measure_verification(arguments, kind, table)
    if arguments.together:
        measure_together(arguments, table)
    if arguments.big:
        measure_beside_big(arguments, table)
    return not table.missed


if __name__ == "__main__":
    editor.run("language_server.py", main)
