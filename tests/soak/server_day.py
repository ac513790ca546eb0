"""A shop's day with the language server: what editors and other programs do, and what holds meanwhile."""

import base64
import json
import random
import signal
import subprocess
import tempfile
import time
from pathlib import Path

import world as worlds
from day import Day
from failure import Failure, require
from language_client import CANCELLED, PATIENCE, LanguageClient
from shop import BROKEN, MACHINES, SETUPS, generated
from text_document import TextDocument

SPRINTS_PER_HOUR = 24
SPRINT_S = 3600 / SPRINTS_PER_HOUR
OPERATIONS = 100  # In a sprint.
COMPARED_EVERY = 4  # Sprints.
LIVES_PER_DAY = 4

MAX_THREADS = 40  # 32 that work, and those that read, write and decide.

POSITION_REQUESTS = (
    "hover", "completion", "signatureHelp", "definition", "documentHighlight", "prepareRename", "linkedEditingRange",
)  # fmt: skip
TEXTS = ["G01 X10 Y20 F1000", "g00 z50", "M06 T101001", "S12000 M03", "IF V1 = 2 GOTO N510", "N510 M05", "V3 = 7", "G41", "G40", "(à côté) 😀", "\ufeff", "X=", "\t", "G02 X5 Y5 R3",
         "G92 X0 Y0", "G27", "G91", "G90", "M02", "; isolint: disable W106", "\x00", "Ä", "½", "\ud83d", "\udc00x", "G70", "%"]  # fmt: skip


def range_of(start: dict, end: dict) -> dict:
    return {"start": start, "end": end}


def without_ids(answer):
    """An answer without what differs from server to server."""
    if isinstance(answer, dict):
        return {key: without_ids(each) for key, each in answer.items() if key not in ("resultId", "id")}
    return [without_ids(each) for each in answer] if isinstance(answer, list) else answer


def in_order(answer: dict) -> list[str]:
    """About programs that are read side by side, so that they come in any order."""
    result = answer["result"]
    return sorted(json.dumps(each, sort_keys=True) for each in (result["items"] if isinstance(result, dict) else result))


def patched(data: bytes, change: dict) -> bytes:
    """A stream of isocnc/toolpath after a change of it."""
    new = base64.b64decode(change["data"])
    start = change.get("start")
    return new if start is None else data[:start] + new + data[start + change["removed"] :]


class ServerDay(Day):
    def __init__(self, programs: Path, seed: int, hours: float, fault: str, folder: Path):
        super().__init__(programs / "isols", seed, "shop", fault, folder, MAX_THREADS)
        self.sprints = max(1, round(hours * SPRINTS_PER_HOUR))
        self.sentinel = folder / "sentinel" / "sentinel.iso"
        self.sentinel.parent.mkdir()
        (self.sentinel.parent / "isocnc.json").write_text(json.dumps({"machine": {"axes": {"X": {"min": 0, "max": 10}}}}))
        # The same programs at each measurement.
        self.standard = [TextDocument(self.uri(file), self.text_of(file)) for file in self.choices.sample(sorted(self.shop.programs()), 6)]
        self.standard.append(TextDocument((folder / "shop/jobs/measured.iso").as_uri(), generated(random.Random(seed), 800)))
        self.documents: dict[str, TextDocument] = {}
        self.clients: list[LanguageClient] = []
        self.editor: subprocess.Popen | None = None  # The process of the client, as the server is told.
        self.errors_seen: dict[str, int] = {}
        self.times_waited = 0
        self.settings: dict = {}

    # --- Small things

    def uri(self, file: Path) -> str:
        return file.as_uri()

    def path(self, uri: str) -> Path:
        return self.folder / Path(uri.removeprefix("file://"))

    def text_of(self, file: Path) -> str:
        return self.shop.files[file].decode(errors="replace")

    @property
    def encoding(self) -> str:
        return self.profile["encoding"]

    def open_programs(self) -> list[TextDocument]:
        return [document for uri, document in sorted(self.documents.items()) if uri.endswith(".iso")]

    def any_document(self) -> TextDocument:
        return self.choices.choice(self.open_programs())

    def awake_documents(self) -> list[TextDocument]:
        return [each for each in self.open_programs() if not self.shop.is_on_network(self.path(each.uri))]

    def any_position(self, document: TextDocument) -> dict:
        """Mostly in the text; sometimes in the middle of a character, or outside."""
        line = self.choices.randrange(document.line_count())
        length = document.ends[line] - document.starts[line]
        column = self.choices.randrange(length + 1) + (self.choices.choice([0, 0, 0, 1, 1000]) if self.chance(0.1) else 0)
        return {"line": line + (5000 if self.chance(0.01) else 0), "character": column}

    def any_range(self, document: TextDocument, lines: int) -> dict:
        start = self.any_position(document)
        end = self.any_position(document)
        end["line"] = min(start["line"] + self.choices.randrange(lines), document.line_count() - 1)
        if (end["line"], end["character"]) < (start["line"], start["character"]):
            start, end = end, start
        return range_of(start, end)

    # --- Servers

    def new_profile(self) -> dict:
        choices = self.choices
        is_rich = choices.random() < 0.7
        profile = {"encoding": choices.choice(["utf-8", "utf-16", "utf-16", "utf-32"]), "pulls": choices.random() < 0.6}
        text = {"hover": {"contentFormat": ["markdown"] if is_rich else ["plaintext"]}, "publishDiagnostics": {"relatedInformation": is_rich},
                "completion": {"completionItem": {"snippetSupport": is_rich}}, "rename": {"prepareSupport": is_rich}, "documentSymbol": {"hierarchicalDocumentSymbolSupport": is_rich},
                "codeAction": {"codeActionLiteralSupport": {"codeActionKind": {"valueSet": []}}, "dataSupport": is_rich, "resolveSupport": {"properties": ["edit"]} if is_rich else None}}  # fmt: skip
        if profile["pulls"]:
            text["diagnostic"] = {"relatedDocumentSupport": False}
        workspace = {"workspaceFolders": True, "didChangeWatchedFiles": {"dynamicRegistration": is_rich}, "workspaceEdit": {"documentChanges": is_rich, "resourceOperations": ["create"] if is_rich else []},
                     "applyEdit": True, "diagnostics": {"refreshSupport": is_rich}, "inlayHint": {"refreshSupport": is_rich}, "codeLens": {"refreshSupport": is_rich}}  # fmt: skip
        if is_rich:
            workspace["textDocumentContent"] = {}
        profile["capabilities"] = {
            "general": {"positionEncodings": [profile["encoding"]]},
            "textDocument": text,
            "workspace": workspace,
            "window": {"workDoneProgress": is_rich, "showDocument": {"support": True}},
            "experimental": {"commands": {"commands": ["isocnc.run", "isocnc.debug"]}},
        }
        profile["locale"] = choices.choice(["en", "it"])
        return profile

    def new_server(self, process: int | None) -> LanguageClient:
        self.clients = [each for each in self.clients if each.process.poll() is None]
        client = LanguageClient(self.program, self.environment(), self.next_log())
        self.clients.append(client)
        client.start({"processId": process, "rootUri": None, "capabilities": self.profile["capabilities"], "locale": self.profile["locale"],
                      "initializationOptions": self.settings, "workspaceFolders": [{"uri": self.uri(each), "name": each.name} for each in self.workspace]})  # fmt: skip
        return client

    def open_in(self, client: LanguageClient, document: TextDocument) -> None:
        client.notify("textDocument/didOpen", {"textDocument": {"uri": document.uri, "languageId": "isocnc", "version": document.version, "text": document.text}})

    def close_in(self, client: LanguageClient, uri: str) -> None:
        client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})

    def start_life(self) -> None:
        """A new editor, with the documents that the one before had open."""
        self.profile = self.new_profile()
        self.workspace = self.choices.sample(self.shop.folders(), 3)
        self.editor = subprocess.Popen(["sleep", "3600"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.client = self.new_server(self.editor.pid)
        self.tokens: dict[str, tuple[str, list[int]]] = {}  # With their result ids, by URI.
        self.paths: dict[str, tuple[str, dict[str, bytes]]] = {}
        self.known_diagnostics: dict[str, str] = {}
        self.late_events: list[dict] = []
        for document in self.documents.values():
            document.version = 1
            self.open_in(self.client, document)

    def end_life(self) -> None:
        """The editor crashes, in one way or another."""
        self.flatness.judge()
        if self.chance(0.5):
            self.ask_something(self.any_document())
        if is_asleep := self.chance(0.3):
            self.world.set_disk(worlds.ASLEEP)
            self.change_configuration_of_network()
        way = self.choices.choice(["closed pipes", "no reader", "no process", "half a message", "exit", "shutdown"])
        if way == "shutdown":
            self.world.set_disk(worlds.AWAKE)
            self.client.stop()
        else:
            client = self.client
            if way == "no process":
                self.editor.kill()
                self.editor.wait()
                self.world.pass_time(60)
            elif way == "no reader":
                client.reads = False
                # Somebody has to hear that nobody listens.
                for _ in range(10_000):
                    try:
                        client.ask("isocnc/nothing", {})
                    except Failure:
                        break
                    time.sleep(0.002)
            elif way == "half a message":
                client.process.stdin.write(b'Content-Length: 100\r\n\r\n{"jsonrpc"')
                client.process.stdin.close()
            elif way == "exit":
                client.notify("exit", None)
            else:
                client.process.stdin.close()
            status = client.status_at_end(way)
            require(status == 1, f"{way}: exit status {status}; {client.errors()}")
            require(not client.errors(), f"{way}: {client.errors()}")
        self.world.set_disk(worlds.AWAKE)
        if self.editor.poll() is None:
            self.editor.send_signal(signal.SIGKILL)
            self.editor.wait()
        self.count(f"end: {way}{', the disk asleep' if is_asleep else ''}")

    # --- Oracles

    def synchronize(self, client: LanguageClient, uris) -> None:
        """All that was sent about these documents is done."""
        for number in [client.ask("textDocument/hover", {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 0}}) for uri in uris]:
            client.answer(number)

    def settle(self, client: LanguageClient, uris) -> None:
        """Nothing is under way: all is answered, verified and reported."""
        client.wait_for_all_answers()
        # What others have written counts a moment after it was reported; the loop has looked at its clock before the last answer.
        client.request("isocnc/nothing", {})
        self.world.pass_time(5)
        for _ in range(2):
            client.request("isocnc/nothing", {})
        if self.settings.get("verify") != "off":
            for uri in uris:
                client.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
            self.synchronize(client, uris)
            # One program is verified at a time, in the order of asking.
            sentinel = TextDocument(self.uri(self.sentinel), "M06 T101001\nG00 X500 Y0 Z50\nM02\n")
            self.open_in(client, sentinel)
            self.wait_for_run(client, sentinel.uri)
            self.close_in(client, sentinel.uri)
        self.synchronize(client, uris)
        client.wait_for_all_answers()

    def wait_for_run(self, client: LanguageClient, uri: str) -> None:
        def is_of_run(items):
            return any(each.get("source") == "isocnc verify" for each in items)

        if not self.profile["pulls"]:
            client.wait_until(lambda: is_of_run(client.published.get(uri, {}).get("diagnostics", [])), "a verification")
            return
        deadline = time.monotonic() + PATIENCE
        while not is_of_run(client.request("textDocument/diagnostic", {"textDocument": {"uri": uri}})["result"]["items"]):
            require(time.monotonic() < deadline, f"no verification in {PATIENCE} s")
            time.sleep(0.002)

    def questions(self) -> list[tuple[str, dict]]:
        """About all open documents."""
        asked = []
        for uri, document in sorted(self.documents.items()):
            of = {"textDocument": {"uri": uri}}
            whole = {**of, "range": range_of({"line": 0, "character": 0}, document.end(self.encoding))}
            if self.profile["pulls"]:
                asked.append(("textDocument/diagnostic", of))
            if not uri.endswith(".iso"):
                continue
            asked += [(f"textDocument/{name}", of) for name in ("documentSymbol", "foldingRange", "codeLens")]
            asked += [(f"textDocument/{name}", {**of, "options": {"tabSize": 2, "insertSpaces": True}}) for name in ("formatting",)]
            asked += [("textDocument/semanticTokens/full", of), ("textDocument/semanticTokens/range", {**of, "range": self.any_range(document, 50)}),
                      ("textDocument/inlayHint", whole), ("textDocument/codeAction", {**whole, "context": {"diagnostics": []}}),
                      ("isocnc/operations", of), ("isocnc/toolpath", of), ("isocnc/syntaxTree", of),
                      ("isocnc/compare", {**of, "with": {"text": generated(random.Random(self.seed), 60)}})]  # fmt: skip
            line = self.choices.randrange(document.line_count())
            asked.append(("isocnc/state", {**of, "line": line}))
            asked.append(("workspace/textDocumentContent", {"uri": f"isocnc://state/x?line={line}&program={uri.replace('%', '%25')}"}))
            asked.append(("workspace/executeCommand", {"command": "isocnc.restart", "arguments": [{"uri": uri, "line": line}]}))
            for _ in range(6):
                at = {**of, "position": self.any_position(document)}
                asked += [(f"textDocument/{name}", at) for name in POSITION_REQUESTS]
                asked.append(("textDocument/references", {**at, "context": {"includeDeclaration": True}}))
                asked.append(("textDocument/rename", {**at, "newName": "N4711"}))
                asked.append(("textDocument/selectionRange", {**of, "positions": [at["position"]]}))
                asked.append(("textDocument/codeAction", {**of, "range": self.any_range(document, 30), "context": {"diagnostics": []}}))
                asked.append(("textDocument/rangeFormatting", {**of, "range": self.any_range(document, 30), "options": {"tabSize": 2, "insertSpaces": True}}))
                asked.append(("textDocument/inlineValue", {**of, "range": self.any_range(document, 30), "context": {"frameId": 1, "stoppedLocation": self.any_range(document, 1)}}))
        return asked + [("workspace/symbol", {"query": self.choices.choice(["", "t1", "pocket", "n5"])}), ("workspace/diagnostic", {"previousResultIds": []})]

    def answers_to(self, client: LanguageClient, asked) -> list:
        numbers = [client.ask(*each) for each in asked]
        answers = [client.answer(number) for number in numbers]
        # What is offered in full on request, for the first of each.
        for (method, _), answer in list(zip(asked, answers)):
            result = answer.get("result")
            items = result["items"] if method == "textDocument/completion" and isinstance(result, dict) else result
            resolved = {"textDocument/codeLens": "codeLens/resolve", "textDocument/completion": "completionItem/resolve", "textDocument/codeAction": "codeAction/resolve"}.get(method)
            for item in (items or [])[:2] if resolved else []:
                if resolved != "codeAction/resolve" or "data" in item:
                    answers.append(client.request(resolved, item))
        answers.append(sorted(json.dumps(edit, sort_keys=True) for edit in self.taken_edits(client)))
        return answers

    @staticmethod
    def taken_edits(client: LanguageClient) -> list[dict]:
        with client.changed:
            edits, client.edits = client.edits, []
        return edits

    def compare(self) -> None:
        """The server says what a fresh one says."""
        self.deliver_late_events()
        self.settle(self.client, sorted(self.documents))
        self.check_deltas()
        fresh = self.new_server(None)
        fresh.notify("workspace/didChangeConfiguration", {"settings": {"isocnc": self.settings}})
        for document in self.documents.values():
            self.open_in(fresh, document)
        self.settle(fresh, sorted(self.documents))
        asked = self.questions()
        self.taken_edits(self.client)
        old, new = self.answers_to(self.client, asked), self.answers_to(fresh, asked)
        for index in range(max(len(old), len(new))):
            a, b = (without_ids(each[index]) if index < len(each) else None for each in (old, new))
            if a != b and index < len(asked) and asked[index][0] in ("workspace/diagnostic", "workspace/symbol"):
                a, b = in_order(a), in_order(b)
            what = f"{asked[index][0]} {json.dumps(asked[index][1])}" if index < len(asked) else "resolved"
            if a != b:
                raise Failure(f"not the answer of a fresh server to {what[:300]}\n{self.difference(a, b)}")
        for uri in sorted(self.documents):
            a, b = (client.published.get(uri, {}) for client in (self.client, fresh))
            require(a == b, f"not the diagnostics of a fresh server of {uri}\n{self.difference(a, b)}")
        for uri, params in fresh.published.items():  # Those of configurations.
            a, b = self.client.published.get(uri, {}).get("diagnostics"), params.get("diagnostics")
            require(a == b or uri == self.uri(self.sentinel), f"not the diagnostics of a fresh server of {uri}\n{self.difference(a, b)}")
        fresh.stop()
        self.count("answers compared")
        self.counts["answers"] = self.counts.get("answers", 0) + len(old)
        for answer in old:
            if isinstance(answer, dict) and "error" in answer:
                message = f"{answer['error']['code']} {answer['error']['message'][:40]}"
                self.errors_seen[message] = self.errors_seen.get(message, 0) + 1

    @staticmethod
    def difference(a, b) -> str:
        left, right = (json.dumps(each, indent=0, sort_keys=True, ensure_ascii=False).splitlines() for each in (a, b))
        first = next((i for i, (x, y) in enumerate(zip(left, right)) if x != y), min(len(left), len(right)))
        return "\n".join(["old:", *left[max(0, first - 12) : first + 8], "fresh:", *right[max(0, first - 12) : first + 8]])

    def check_deltas(self) -> None:
        """What the client has made of changes is what the server sends whole."""
        for uri in sorted(self.tokens):
            self.update_tokens(uri)
            whole = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}})["result"]["data"]
            require(whole == self.tokens.pop(uri)[1], f"the changes of the tokens of {uri} lead elsewhere")
        for uri in sorted(self.paths):
            self.update_path(uri)
            answer = self.client.request("isocnc/toolpath", {"textDocument": {"uri": uri}})
            streams = self.paths.pop(uri)[1]
            for name, data in streams.items():
                require(base64.b64decode(answer["result"][name]["data"]) == data, f"the changes of the path of {uri} lead elsewhere: {name}")

    def measure(self) -> None:
        """The memory of the server with nothing open, after the same work each time."""
        for uri in sorted(self.documents):
            self.close_in(self.client, uri)
        for document in self.standard:
            self.open_in(self.client, document)
        uris = [document.uri for document in self.standard]
        self.settle(self.client, uris)
        for uri in uris:
            self.close_in(self.client, uri)
        self.settle(self.client, [])
        self.flatness.measure(self.client)
        self.tokens, self.paths, self.known_diagnostics = {}, {}, {}
        for document in self.documents.values():
            self.open_in(self.client, document)

    # --- What editors do

    def edit(self, document: TextDocument, changes: list[dict]) -> None:
        params = document.edit(changes, self.encoding)
        if self.fault == "answer" and self.chance(0.02):
            params = json.loads(json.dumps(params))
            params["contentChanges"][-1]["text"] += " X"
        self.client.notify("textDocument/didChange", params)

    def type_something(self, document: TextDocument) -> None:
        """As a user types, with what an editor asks meanwhile."""
        for _ in range(self.choices.randrange(1, 6)):
            self.world.pass_time(0.2)
            position = self.any_position(document)
            kind = self.choices.randrange(4)
            end = dict(position)
            if kind == 0:
                text = self.choice_of_texts()
            elif kind == 1:
                text = "\n" + self.choice_of_texts() + self.choices.choice(["\n", "\r\n", "\r", ""])
            elif kind == 2:
                text, end["character"] = self.choices.choice("0123456789."), end["character"] + 1
            else:
                text, end["character"] = "", end["character"] + self.choices.randrange(4)
            self.edit(document, [{"range": range_of(position, end), "text": text}])
            if self.chance(0.3):
                name = self.choices.choice(["completion", "signatureHelp", "onTypeFormatting"])
                params = {"textDocument": {"uri": document.uri}, "position": position}
                self.client.ask(f"textDocument/{name}", {**params, "ch": "\n", "options": {"tabSize": 2, "insertSpaces": True}} if name == "onTypeFormatting" else params)

    def choice_of_texts(self) -> str:
        return self.choices.choice(TEXTS)

    def edit_at_once(self, document: TextDocument) -> None:
        changes = []
        for _ in range(self.choices.randrange(2, 6)):
            changes.append({"range": self.any_range(document, 3), "text": self.choice_of_texts()})
        self.edit(document, changes)

    def paste(self, document: TextDocument) -> None:
        position = self.any_position(document)
        text = generated(self.choices, self.choices.choice([30, 100, 600]))
        if self.chance(0.3):
            text = text.replace("\n", "\r\n")
        self.edit(document, [{"range": range_of(position, position), "text": text}])

    def delete_block(self, document: TextDocument) -> None:
        self.edit(document, [{"range": self.any_range(document, 200), "text": ""}])

    def undo(self, document: TextDocument) -> None:
        for _ in range(self.choices.randrange(1, 4)):
            if document.history:
                text = document.history[-1]
                history = document.history[:-1]
                self.edit(document, [document.change_to(text, self.encoding)])
                document.history = history

    def replace_all(self, document: TextDocument) -> None:
        file = self.path(document.uri)
        self.edit(document, [{"text": self.text_of(file) if file in self.shop.files else generated(self.choices, 50)}])

    def open(self, _=None) -> None:
        if len(self.open_programs()) >= 8:
            return self.close()
        file = self.choices.choice(sorted(self.shop.programs()))
        if self.uri(file) not in self.documents:
            document = TextDocument(self.uri(file), self.text_of(file))
            self.documents[document.uri] = document
            self.open_in(self.client, document)

    def close(self, document: TextDocument | None = None) -> None:
        if len(self.open_programs()) > 2:
            document = document or self.any_document()
            self.forget(document)
            self.close_in(self.client, document.uri)

    def forget(self, document: TextDocument) -> None:
        del self.documents[document.uri]
        for known in (self.tokens, self.paths):
            known.pop(document.uri, None)

    def save(self, document: TextDocument) -> None:
        file = self.path(document.uri)
        if self.fault == "file":
            file.with_suffix(".iso~").write_bytes(b"")
        self.shop.write(file, document.text.encode())
        self.client.notify("textDocument/didSave", {"textDocument": {"uri": document.uri}})
        self.note_change(file)

    def ask_something(self, document: TextDocument) -> None:
        """Without waiting; some requests are cancelled, some are about documents that are not open."""
        of = {"textDocument": {"uri": document.uri if self.chance(0.95) else self.uri(self.shop.root / "nowhere.iso")}}
        at = {**of, "position": self.any_position(document)}
        a_range = {**of, "range": self.any_range(document, 50)}
        options = {"options": {"tabSize": 2, "insertSpaces": True}}
        asked = self.choices.choice([
            *[(f"textDocument/{name}", at) for name in POSITION_REQUESTS],
            ("textDocument/references", {**at, "context": {"includeDeclaration": False}}),
            ("textDocument/rename", {**at, "newName": self.choices.choice(["N900", "V9", "nothing", ""])}),
            ("textDocument/selectionRange", {**of, "positions": [self.any_position(document) for _ in range(3)]}),
            ("textDocument/semanticTokens/range", a_range), ("textDocument/inlayHint", a_range),
            ("textDocument/inlineValue", {**a_range, "context": {"frameId": 1, "stoppedLocation": a_range["range"]}}),
            ("textDocument/codeAction", {**a_range, "context": {"diagnostics": []}}),
            ("textDocument/rangeFormatting", {**a_range, **options}), ("textDocument/formatting", {**of, **options}),
            *[(f"textDocument/{name}", of) for name in ("documentSymbol", "foldingRange", "codeLens", "diagnostic", "semanticTokens/full")],
            ("isocnc/operations", of), ("isocnc/toolpath", {**of, "vgpl": self.choices.randrange(3)}), ("isocnc/syntaxTree", of),
            ("isocnc/state", {**of, "line": at["position"]["line"]}),
            ("isocnc/compare", {**of, "with": {"text": generated(self.choices, 40)}, "overlay": True}),
            ("workspace/textDocumentContent", {"uri": f"isocnc://syntax/x?line=3&program={document.uri}"}),
            ("workspace/executeCommand", {"command": "isocnc.showText", "arguments": [{"uri": document.uri, "text": "state", "line": 2}]}),
        ])  # fmt: skip
        number = self.client.ask(*asked)
        if self.chance(0.2):
            self.client.notify("$/cancelRequest", {"id": number})

    def ask_workspace(self, _=None) -> None:
        if self.chance(0.5):
            self.client.ask("workspace/symbol", {"query": self.choices.choice(["", "x", "t101"])})
            return
        known = [{"uri": uri, "value": value} for uri, value in sorted(self.known_diagnostics.items())]
        number = self.client.ask("workspace/diagnostic", {"previousResultIds": known})
        if self.chance(0.3):
            self.client.notify("$/cancelRequest", {"id": number})
            return
        answer = self.client.answer(number)
        require("result" in answer, f"workspace/diagnostic: {answer}")
        for each in answer["result"]["items"]:
            if each.get("resultId"):
                self.known_diagnostics[each["uri"]] = each["resultId"]

    def update_tokens(self, uri: str) -> None:
        before = self.tokens.get(uri)
        if before is None:
            answer = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}})
        else:
            answer = self.client.request("textDocument/semanticTokens/full/delta", {"textDocument": {"uri": uri}, "previousResultId": before[0]})
        result = answer.get("result")
        require(result is not None, f"no tokens: {answer}")
        data = result.get("data")
        if data is None:
            data = list(before[1])
            for each in sorted(result["edits"], key=lambda each: -each["start"]):
                data[each["start"] : each["start"] + each["deleteCount"]] = each.get("data", [])
        self.tokens[uri] = (result["resultId"], data)

    def update_path(self, uri: str) -> None:
        before = self.paths.get(uri)
        params = {"textDocument": {"uri": uri}, **({"previousResultId": before[0]} if before else {})}
        answer = self.client.request("isocnc/toolpath", params)
        require("result" in answer, f"no path: {answer}")
        streams = {name: patched(before[1][name] if before else b"", answer["result"][name]) for name in ("steps", "points", "turns", "cuts")}
        self.paths[uri] = (answer["result"]["resultId"], streams)

    def follow(self, document: TextDocument) -> None:
        """The panes that are kept up to date."""
        (self.update_tokens if self.chance(0.6) else self.update_path)(document.uri)

    def apply(self, uri: str, edits: list[dict]) -> None:
        document = self.documents.get(uri)
        if document is None or not edits:
            return
        ordered = sorted(enumerate(edits), key=lambda each: (each[1]["range"]["start"]["line"], each[1]["range"]["start"]["character"], each[0]), reverse=True)
        self.edit(document, [{"range": each["range"], "text": each["newText"]} for _, each in ordered])

    def apply_workspace_edit(self, edit: dict) -> None:
        for change in edit.get("documentChanges", []):
            if "edits" in change:
                self.apply(change["textDocument"]["uri"], change["edits"])
        for uri, edits in edit.get("changes", {}).items():
            self.apply(uri, edits)

    def use_an_offer(self, document: TextDocument) -> None:
        """Formats, renames, takes a code action, or runs a command."""
        of = {"textDocument": {"uri": document.uri}}
        options = {"options": {"tabSize": 2, "insertSpaces": True}}
        self.client.wait_for_all_answers()
        kind = self.choices.randrange(4)
        if kind == 0:
            answer = self.client.request("textDocument/formatting", {**of, **options})
            self.apply(document.uri, answer.get("result") or [])
        elif kind == 1:
            answer = self.client.request("textDocument/rename", {**of, "position": self.any_position(document), "newName": f"N{self.choices.randrange(1, 9999)}"})
            self.apply_workspace_edit(answer.get("result") or {})
        elif kind == 2:
            answer = self.client.request("textDocument/codeAction", {**of, "range": self.any_range(document, 60), "context": {"diagnostics": []}})
            offers = answer.get("result") or []
            if offers:
                action = self.choices.choice(offers)
                if "edit" not in action and "data" in action:
                    action = self.client.request("codeAction/resolve", action).get("result") or {}
                self.apply_workspace_edit(action.get("edit") or {})
        else:
            command, more = self.choices.choice([("isocnc.fixAll", {}), ("isocnc.renumber", {}), ("isocnc.transform", {"mirror": "X", "about": 100}), ("isocnc.transform", {"shift": [1, 2]}),
                                                 ("isocnc.transform", {"rotate": 90, "about": [0, 0]}), ("isocnc.nothing", {})])  # fmt: skip
            self.client.request("workspace/executeCommand", {"command": command, "arguments": [{"uri": document.uri, **more}]})
            for edit in self.taken_edits(self.client):
                self.apply_workspace_edit(edit)

    # --- What changes around them

    def note_change(self, file: Path, kind: int = 2) -> None:
        """An editor that watches files reports changes, sometimes late, sometimes twice."""
        event = {"uri": self.uri(file), "type": kind}
        if self.chance(0.2):
            self.late_events.append(event)
        else:
            self.client.notify("workspace/didChangeWatchedFiles", {"changes": [event] * self.choices.choice([1, 1, 2])})

    def deliver_late_events(self) -> None:
        if self.late_events:
            self.client.notify("workspace/didChangeWatchedFiles", {"changes": self.late_events})
            self.late_events = []

    def change_configuration(self, _=None) -> None:
        folder = self.choice_of_folders()
        file = folder / "isocnc.json"
        if self.uri(file) in self.documents:
            return
        if file in self.shop.files and self.chance(0.3):
            self.shop.remove(file)
            return self.note_change(file, 3)
        kind = 2 if file in self.shop.files else 1
        text = self.choices.choice(BROKEN) if self.chance(0.4) else json.dumps(self.choices.choice(MACHINES), indent=1).encode()
        self.shop.write(file, text)
        return self.note_change(file, kind)

    def choice_of_folders(self) -> Path:
        return self.choices.choice([*self.shop.folders(), self.shop.root])

    def change_configuration_of_network(self) -> None:
        """While the disk sleeps, its files are written by others."""
        file = self.shop.network / "isocnc.json"
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": self.uri(file), "type": 2}]})

    def type_configuration(self, _=None) -> None:
        """An isocnc.json in the editor: opened, edited, saved, closed."""
        files = [file for file in sorted(self.shop.files) if file.name == "isocnc.json" or file.name.endswith(".setup.json")]
        file = self.choices.choice(files)
        uri = self.uri(file)
        document = self.documents.get(uri)
        if document is None:
            if len(self.documents) - len(self.open_programs()) < 3:
                self.documents[uri] = document = TextDocument(uri, self.text_of(file))
                self.open_in(self.client, document)
            return
        if self.chance(0.4):
            self.forget(document)
            self.close_in(self.client, uri)
        elif self.chance(0.5):
            self.edit(document, [{"range": self.any_range(document, 3), "text": self.choices.choice(["{", "}", '"', "7", ""])}])
        else:
            self.save(document)

    def change_setup(self, _=None) -> None:
        program = self.choices.choice(sorted(self.shop.programs()))
        file = program.with_suffix(".setup.json")
        if self.uri(file) in self.documents:
            return
        if file in self.shop.files and self.chance(0.5):
            self.shop.remove(file)
            self.note_change(file, 3)
        else:
            self.shop.write(file, self.choices.choice(SETUPS))
            self.note_change(file, 1)

    def change_settings(self, _=None) -> None:
        self.settings = {"verify": self.choices.choice(["onPause", "onPause", "onSave", "off"]), "language": self.choices.choice(["en", "it", None]),
                         "inlayHints": {"endPosition": self.chance(0.7), "sectionTime": self.chance(0.7), "motionInForce": self.chance(0.7)}}  # fmt: skip
        self.client.notify("workspace/didChangeConfiguration", {"settings": {"isocnc": self.settings}})

    def change_folders(self, _=None) -> None:
        folder = self.choices.choice(self.shop.folders())
        as_folder = {"uri": self.uri(folder), "name": folder.name}
        is_open = folder in self.workspace
        self.workspace = [each for each in self.workspace if each != folder] if is_open else [*self.workspace, folder]
        self.client.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [] if is_open else [as_folder], "removed": [as_folder] if is_open else []}})

    def change_files(self, _=None) -> None:
        """Another program writes, renames or removes a program."""
        file = self.choices.choice(sorted(self.shop.programs()))
        kind = self.choices.randrange(4)
        if kind == 0 and len(self.shop.programs()) > 100 and self.uri(file) not in self.documents:
            self.shop.remove(file)
            self.note_change(file, 3)
        elif kind == 1 and self.uri(file) not in self.documents:
            name = file.with_name(f"renamed{self.choices.randrange(1000)}.iso")
            if name not in self.shop.files:
                self.shop.rename(file, name)
                self.note_change(file, 3)
                self.note_change(name, 1)
        elif kind == 2:
            name = self.shop.root / self.choices.choice(["jobs", "doors", "network"]) / f"posted{self.choices.randrange(30)}.iso"
            self.shop.write(name, generated(self.choices, 60).encode())
            self.note_change(name, 1)
        else:
            text = self.shop.files[file]
            self.shop.write(file, text[: self.choices.randrange(len(text) + 1)] + self.choices.choice([b"", b"X\xff\xfe\n", b"G00 X1\n"]))
            self.note_change(file)

    def send_garbage(self, _=None) -> None:
        """Messages that are wrong, after which all goes on."""
        client = self.client
        kind = self.choices.randrange(5)
        if kind == 0:
            answer = client.request("isocnc/wrongOnPurpose", {})
            require(answer.get("error", {}).get("code") == -32601, f"{answer}")
        elif kind == 1:
            answer = client.request("textDocument/hover", {"textDocument": 7})
            require("error" in answer, f"{answer}")
        elif kind == 2:
            client.notify("$/wrongOnPurpose", {})
        elif kind == 3:
            answer = client.request("textDocument/hover", {"textDocument": {"uri": "http://[wrong on purpose"}, "position": {"line": 0, "character": 0}})
            require("error" in answer, f"{answer}")
        else:
            client.notify("$/cancelRequest", {"id": 4000000})

    def jump_clock(self, _=None) -> None:
        """The time is set, ends to be summer's, or the machine was suspended, in its two ways."""
        self.world.jump("real", self.choices.choice([86400, -3600, 3600, 0.5, -0.5, 7200]))
        if self.chance(0.3):
            self.world.jump("monotonic", self.choices.choice([60, 3600, 86400]))

    def suspend_disk(self, _=None) -> None:
        """The network's disk sleeps. What does not need it is answered meanwhile."""
        client = self.client
        client.wait_for_all_answers()
        awake = self.awake_documents()
        calls = self.world.disk_calls()
        self.world.set_disk(worlds.ASLEEP)
        pending = []
        # Last, a program on the disk is opened.
        for kind in [*self.choices.sample([0, 2, 3, 4], self.choices.randrange(3)), 1]:
            if kind == 0:
                self.change_configuration_of_network()
            elif kind == 1:
                file = self.shop.network / f"asleep{self.choices.randrange(50)}.iso"
                if self.uri(file) not in self.documents:
                    self.documents[self.uri(file)] = document = TextDocument(self.uri(file), generated(self.choices, 40))
                    self.open_in(client, document)
                    pending.append(client.ask("textDocument/hover", {"textDocument": {"uri": document.uri}, "position": {"line": 4, "character": 1}}))
            elif kind == 2:
                number = client.ask("workspace/diagnostic", {"previousResultIds": []})
                client.notify("$/cancelRequest", {"id": number})
                answer = client.answer(number)
                require("result" in answer or answer["error"]["code"] == CANCELLED, f"{answer}")
            elif kind == 3:
                pending.append(client.ask("workspace/symbol", {"query": "t"}))
            else:
                self.change_folders()
        file = self.choices.choice([each for each in sorted(self.shop.programs()) if not self.shop.is_on_network(each)])
        if self.uri(file) not in self.documents:
            self.documents[self.uri(file)] = document = TextDocument(self.uri(file), self.text_of(file))
            self.open_in(client, document)
            awake.append(document)
        for document in awake:
            self.type_something(document)
        for document in awake:
            at = {"textDocument": {"uri": document.uri}, "position": self.any_position(document)}
            for name in ("hover", "completion"):
                client.answer(client.ask(f"textDocument/{name}", at))
        if self.world.waiting() > 0:
            self.times_waited += 1
        if self.chance(0.5):
            self.world.set_disk(worlds.BROKEN)
            for number in pending:
                client.answer(number)
            pending = []
        self.world.set_disk(worlds.AWAKE)
        # A disk that comes back is reported by what watches it.
        self.change_configuration_of_network()
        for number in pending:
            client.answer(number)
        if self.world.disk_calls() > calls:
            self.count("suspended disks that were asked for")

    # --- The day

    def operations(self):
        return {
            self.type_something: 30, self.ask_something: 30, self.edit_at_once: 4, self.paste: 3, self.delete_block: 5, self.undo: 6, self.replace_all: 2,
            self.open: 6, self.close: 5, self.save: 6, self.use_an_offer: 6, self.follow: 6, self.ask_workspace: 3, self.change_configuration: 3,
            self.type_configuration: 3, self.change_setup: 2, self.change_settings: 1, self.change_folders: 2, self.change_files: 5, self.send_garbage: 1,
            self.jump_clock: 1, self.suspend_disk: 1,
        }  # fmt: skip

    def sprint(self, number: int) -> None:
        self.choices = random.Random(f"{self.seed}/{number}")
        weights = self.operations()
        # While a user thinks or types, time passes.
        pauses = [self.choices.expovariate(1) for _ in range(OPERATIONS)]
        scale = SPRINT_S / sum(pauses)
        for step, pause in enumerate(pauses):
            operation = self.choices.choices(list(weights), list(weights.values()))[0]
            seconds = round(number * SPRINT_S + step * SPRINT_S / OPERATIONS)
            self.place = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}, sprint {number}, step {step}: {operation.__name__}"
            if number == 0 and step == OPERATIONS // 2:  # On the shortest day, too.
                operation = self.suspend_disk
            document = self.any_document()
            if len(document.text) > 150_000:
                operation = self.replace_all
            if self.fault == "silence" and step == 50:
                self.client.ignored_answers, self.client.patience = 1, 2
            operation(document)
            self.count(operation.__name__)
            for edit in self.taken_edits(self.client):
                self.apply_workspace_edit(edit)
            if self.chance(0.1):
                self.deliver_late_events()
            self.client.check()
            require(self.client.process.poll() is None, f"the server has ended by itself, {self.client.process.returncode}: {self.client.errors()}")
            self.world.pass_time(pause * scale)

    def run(self) -> None:
        for file in self.choices.sample(sorted(self.shop.programs()), 4):
            self.documents[self.uri(file)] = TextDocument(self.uri(file), self.text_of(file))
        life = max(1, round(24 * SPRINTS_PER_HOUR / LIVES_PER_DAY) if self.sprints > 24 * SPRINTS_PER_HOUR / LIVES_PER_DAY else self.sprints - 1)
        self.start_life()
        for number in range(self.sprints):
            if number > 0 and number % life == 0:
                self.place += "; the client crashes"
                self.end_life()
                self.start_life()
            self.sprint(number)
            if number % COMPARED_EVERY == COMPARED_EVERY - 1 or number == self.sprints - 1:
                self.place += "; comparing"
                self.compare()
                self.shop.check()
            self.place += "; measuring"
            self.measure()
        self.place = "the end of the day"
        self.end_life()
        self.shop.check()
        require(not list(self.temporary.iterdir()), f"temporary files: {list(self.temporary.iterdir())}")
        require(self.world.clock_reads() > 0 and self.times_waited > 0, "the clocks or the disk were not used")

    def summary(self) -> str:
        lines = [f"{name}: {count}" for name, count in sorted(self.counts.items())]
        return "\n".join([*self.flatness.report, "operations: " + ", ".join(lines), f"errors in compared answers: {self.errors_seen}"])


def run(programs: Path, seed: int, hours: float, fault: str) -> str:
    """What has been done."""
    with tempfile.TemporaryDirectory(prefix="isocnc-soak-") as name:
        day = ServerDay(programs, seed, hours, fault, Path(name).resolve())
        try:
            day.run()
        except Exception as problem:
            raise Failure(f"isols, seed {seed}, at {day.place}: {problem or type(problem).__name__}") from problem
        finally:
            for client in day.clients:
                client.process.kill()
            if day.editor:
                day.editor.kill()
                day.editor.wait()
        return day.summary()
