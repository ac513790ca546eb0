#!/usr/bin/env python3
"""What the programs do to the system when what they read is hostile: watched by strace, call by call.

usage: security_test.py BIN_FOLDER. Skipped (77) where there is no strace. docs/security.md says what is promised.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAMS = Path()

HOSTILE = """; $(touch PWNED) `touch PWNED` ; touch PWNED | touch PWNED > PWNED
(../../../etc/passwd) (file:///etc/passwd) (http://example.com/x.iso) %x isolint: ignore-file ../../etc/passwd
O1 <#include "/etc/passwd"> #1=2 (LOG,/tmp/PWNED) (DEBUG,#1) M98 P../../etc/passwd
M06 T101001
M100 P1=2
G00 X10 Y10 (</script><script>alert(1)</script>)
V99 = /etc/passwd
IF V1 = 1 GOTO N../../etc/passwd
M02
"""
CONFIGURATION = {
    "$schema": "http://example.com/schema.json",
    "lint": {"files": ["../../../etc/*", "/etc/passwd"], "exclude": ["`touch PWNED`", "../**"], "baseline": "/etc/passwd"},
    "machine": {"functions": [{"number": 100, "name": "$(touch PWNED)"}], "tools": "/etc/passwd"},
}
# Where a program may look without being asked: what the loader, the C library and the clock take.
OF_THE_SYSTEM = re.compile(r"^(/lib|/usr/lib|/etc/ld\.so|/usr/share/(locale|zoneinfo|terminfo)|/etc/localtime|/proc/self|/proc/meminfo|/sys/|/dev/null|/dev/tty)")


def converse(process, messages, last):
    """Sends the messages, waits until each request has its answer, and only then sends the last ones."""
    awaited = {each.get("id", each.get("seq")) for each in messages} - {None}
    process.stdin.write(b"".join(map(frame, messages)))
    process.stdin.flush()
    while awaited:
        header = process.stdout.readline()
        if not header:
            raise AssertionError(f"no answer to {awaited}")
        process.stdout.readline()
        message = json.loads(process.stdout.read(int(header.split(b":")[1])))
        if "method" not in message:
            awaited.discard(message.get("id", message.get("request_seq")))
    process.stdin.write(b"".join(map(frame, last)))
    process.stdin.close()
    process.stdout.read()


class Watched:
    """A run of a program, and what it asked of the system."""

    def __init__(self, argv, folder, messages=None, last=()):
        log = Path(folder) / "calls.log"
        calls = "execve,execveat,fork,vfork,network,open,openat,creat,unlink,unlinkat,rename,renameat,renameat2,mkdir,link,symlink"
        with tempfile.TemporaryFile() as said, subprocess.Popen(
            ["strace", "-f", "-qq", "-s", "4096", "-e", f"trace={calls}", "-o", log, *map(str, argv)],
            cwd=folder, stdin=subprocess.PIPE if messages else subprocess.DEVNULL,
            stdout=subprocess.PIPE if messages else said, stderr=said,
            env={"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "HOME": folder},
        ) as process:
            if messages:
                converse(process, messages, last)
            self.status = process.wait(timeout=120)
            said.seek(0)
            self.said = said.read()
        self.calls = [re.sub(r"^\d+ +", "", line) for line in log.read_text(errors="replace").splitlines()]
        log.unlink()

    def named(self, *names):
        return [call for call in self.calls if call.split("(", 1)[0] in names]

    def opened(self, *, to_write):
        """The files that were really opened, but for the system's own."""
        found = []
        for call in self.named("open", "openat", "creat"):
            path = re.search(r'"((?:[^"\\]|\\.)*)"', call)
            if path is None or re.search(r"= -1 ", call) or OF_THE_SYSTEM.match(path[1]):
                continue
            if bool(re.search(r"O_WRONLY|O_RDWR|O_CREAT", call)) == to_write:
                found.append(path[1])
        return found


def frame(message):
    body = json.dumps(message).encode()
    return b"Content-Length: %d\r\n\r\n%s" % (len(body), body)


class Security(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="isocnc-security-"))
        self.program = self.folder / "part; touch PWNED.iso"
        self.program.write_text(HOSTILE)

    def tearDown(self):
        self.assertEqual([], list(self.folder.rglob("PWNED*")))
        shutil.rmtree(self.folder)

    def watch(self, name, *arguments, messages=None, last=()):
        return Watched([PROGRAMS / name, *arguments], str(self.folder), messages, last)

    def holds(self, run, *, reads=(), writes=()):
        """One process, no socket, and no files but these and the configuration above them."""
        self.assertGreaterEqual(run.status, 0, run.said)
        self.assertLess(run.status, 3, run.said)
        self.assertEqual(1, len(run.named("execve", "execveat", "fork", "vfork")))
        self.assertEqual([], run.named("socket", "connect", "bind", "listen"))
        allowed = {str(path) for path in reads} | {str(self.folder / "isocnc.json"), "isocnc.json"}
        self.assertEqual([], [path for path in run.opened(to_write=False) if path not in allowed and not Path(self.folder, path).is_dir()])
        self.assertEqual([], [path for path in run.opened(to_write=True) if path not in {str(each) for each in writes}])

    def test_checking_reads_what_is_named_and_writes_nothing(self):
        for options in ([], ["--format", "sarif"], ["--diff"], ["--statistics"]):
            self.holds(self.watch("isolint", *options, self.program), reads=[self.program])

    def test_formatting_to_standard_output_writes_nothing(self):
        self.holds(self.watch("isofmt", "--stdout", self.program), reads=[self.program])

    def test_comparing_files_starts_nothing(self):
        other = self.folder / "part:$(touch PWNED).iso"
        other.write_text(HOSTILE)
        self.holds(self.watch("isodiff", self.program, other.name), reads=[self.program, other.name])
        self.holds(self.watch("isodiff", "--git", "x.iso", self.program, ".", "100644", other.name, ".", "100644"),
                   reads=[self.program, other.name])  # fmt: skip

    @unittest.skipUnless(shutil.which("git"), "there is no git")
    def test_comparing_revisions_starts_git_alone(self):
        for command in (["init", "-q"], ["add", "."], ["-c", "user.name=T", "-c", "user.email=t@localhost", "commit", "-qm", "P"]):
            subprocess.run(["git", *command], cwd=self.folder, check=True, capture_output=True)
        for name in (f"HEAD:{self.program.name}", "HEAD:$(touch PWNED)", "$(touch PWNED):x", "--output=PWNED:x"):
            run = self.watch("isodiff", "--", self.program, name)
            self.assertIn(run.status, (0, 2), run.said)
            started = [call for call in run.named("execve", "execveat") if call.endswith(" = 0")]
            self.assertTrue(all(re.match(r'execve\("[^"]*/(isodiff|git)"', call) for call in started), started)
            self.assertGreater(len(started), 1)
            self.assertEqual([], run.named("socket", "connect", "bind", "listen"))
            self.assertEqual([], [path for path in run.opened(to_write=True) if path != "/dev/null"])

    def test_running_writes_the_files_that_are_named(self):
        trace = self.folder / "trace.jsonl"
        run = self.watch("isorun", "--trace", trace, self.program)
        self.assertTrue(all(str(trace) in path or str(self.folder) in path for path in run.opened(to_write=True)))
        self.assertEqual([], run.named("socket", "connect", "bind"))
        self.assertEqual(1, len(run.named("execve", "fork", "vfork")))

    def test_a_configuration_names_no_file_to_be_read_or_written(self):
        (self.folder / "isocnc.json").write_text(json.dumps(CONFIGURATION))
        below = self.folder / "sub" / "part.iso"
        below.parent.mkdir()
        below.write_text(HOSTILE)
        for name in ("isolint", "isorun"):
            for program in (self.program, below):
                self.holds(self.watch(name, program), reads=[program])

    def test_a_tree_leads_nowhere_else(self):
        tree, outside = self.folder / "tree", self.folder / "outside"
        for folder in (tree, outside):
            folder.mkdir()
            (folder / "part.iso").write_text("g71 g71\n")
        (outside / "notes.txt").write_text("g71 g71\n")
        (tree / "link.iso").symlink_to("../outside/part.iso")
        (tree / "notes.iso").symlink_to("../outside/notes.txt")
        (tree / "away").symlink_to("../outside")
        for argv in (["isolint"], ["isolint", "--fix", "--unsafe-fixes"], ["isofmt", "-i"]):
            run = self.watch(*argv, tree)
            self.assertEqual([], [path for path in run.opened(to_write=False) if "outside" in path])
            self.assertEqual([], [path for path in run.opened(to_write=True) if not Path(path).is_relative_to(tree)])
        self.assertNotEqual("g71 g71\n", (tree / "part.iso").read_text())
        for name in ("part.iso", "notes.txt"):
            self.assertEqual("g71 g71\n", (outside / name).read_text())

    def test_an_editor_s_messages_open_no_file_outside_its_folders(self):
        (self.folder / "away").symlink_to("/etc")
        (self.folder / "link.iso").symlink_to("/etc/passwd")
        uris = ["file:///etc/passwd", "file:///etc/../etc/hostname", "file://localhost/etc/passwd", "http://example.com/a.iso",
                "file://example.com/etc/passwd", "FILE:///etc/passwd", "vscode-remote://ssh-remote/etc/passwd", "/etc/passwd",
                "file:///etc/passwd%00.iso", *(f"{self.folder.as_uri()}/{path}" for path in (
                    "..%2f..%2fetc/passwd", "%2e%2e/%2E%2E/etc/passwd", "away/passwd", "link.iso", "link.iso%00"))]
        text = {"languageId": "isocnc", "version": 1, "text": HOSTILE}
        messages = [{"id": 1, "method": "initialize", "params": {"processId": None, "capabilities": {},
                     "workspaceFolders": [{"uri": self.folder.as_uri(), "name": "parts"}]}}]
        for number, uri in enumerate(uris):
            messages.append({"id": 10 + number, "method": "textDocument/diagnostic", "params": {"textDocument": {"uri": uri}}})
        messages.append({"method": "textDocument/didOpen", "params": {"textDocument": {"uri": self.program.as_uri(), **text}}})
        for number, method in enumerate(("textDocument/hover", "textDocument/definition", "textDocument/documentSymbol", "isocnc/toolpath")):
            messages.append({"id": 30 + number, "method": method,
                             "params": {"textDocument": {"uri": self.program.as_uri()}, "position": {"line": 2, "character": 30}}})
        messages.append({"id": 50, "method": "workspace/diagnostic", "params": {"previousResultIds": []}})
        last = [{"id": 99, "method": "shutdown"}, {"method": "exit"}]
        spoken = [[{"jsonrpc": "2.0", **each} for each in all_of_them] for all_of_them in (messages, last)]
        self.holds(self.watch("isols", messages=spoken[0], last=spoken[1]), reads=[self.program])

    def test_a_debugger_reads_the_program_it_is_told_to(self):
        messages = [
            {"command": "initialize", "arguments": {"adapterID": "isocnc"}},
            {"command": "launch", "arguments": {"program": str(self.program), "stopOnEntry": True}},
            {"command": "configurationDone"},
            {"command": "evaluate", "arguments": {"expression": "`touch PWNED`; system('touch PWNED')", "context": "repl"}},
            {"command": "source", "arguments": {"source": {"path": "/etc/passwd"}, "sourceReference": 0}},
            {"command": "setBreakpoints", "arguments": {"source": {"path": "/etc/passwd"}, "breakpoints": [{"line": 1}]}},
        ]
        numbered = [{"seq": i + 1, "type": "request", **each} for i, each in enumerate(messages)]
        last = [{"seq": 99, "type": "request", "command": "disconnect"}]
        self.holds(self.watch("isodap", messages=numbered, last=last), reads=[self.program])

    def test_waiting_for_an_editor_listens_on_the_loopback_alone(self):
        for name, option in (("isols", "--tcp"), ("isodap", "--server")):
            process = subprocess.Popen([PROGRAMS / name, option, "0"], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            try:
                port = int(re.search(r"127\.0\.0\.1:(\d+)", process.stderr.readline())[1])
                bound = [line.split()[1] for table in ("tcp", "tcp6") for line in Path("/proc/net", table).read_text().splitlines()[1:]
                         if line.split()[3] == "0A" and line.split()[1].endswith(f":{port:04X}")]
                self.assertEqual([f"0100007F:{port:04X}"], bound)
            finally:
                process.kill()
                process.wait()
                process.stderr.close()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if shutil.which("strace") is None:
        print("skipped: there is no strace")
        sys.exit(77)
    PROGRAMS = Path(sys.argv.pop(1)).resolve()
    unittest.main()
