#!/usr/bin/env python3
"""What is different on Windows: names of files, who else uses them, line ends, languages, ports. Runs the programs under Wine.

usage: windows_test.py PROGRAMS -- EMULATOR... HELPERS

PROGRAMS is a folder of scripts that run them; HELPERS is that of the programs that the C++ files beside this one make.
"""

import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
*EMULATOR, HELPERS = sys.argv[3:]
HOLD_FILE = [*EMULATOR, str(pathlib.Path(HELPERS) / "hold_file.exe")]
REPLACE_FILE = [*EMULATOR, str(pathlib.Path(HELPERS) / "replace_file.exe")]

WRONG = "M06 T101001\nS12000 M03\nG01 X10 F1200\nG02 X20\nM05\nM02\n"
UNTIDY = "m06 t101001\r\ng00 x0 y0\r\nm02\r\n"
TIDY = "M06 T101001\r\nG00 X0 Y0\r\nM02\r\n"


def run(*command, environment=None, **options):
    # Wine reads the arguments as the locale says.
    locale = {"LC_ALL": "C.UTF-8"}
    kept = {key: value for key, value in os.environ.items() if not key.startswith("LC_") and key not in ("LANG", "NO_COLOR")}
    return subprocess.run([str(PROGRAMS / command[0]), *map(str, command[1:])], env=kept | (environment or locale), capture_output=True,
                          timeout=120, check=False, **options)


def framed(message):
    body = json.dumps(message).encode()
    return b"Content-Length: %d\r\n\r\n" % len(body) + body


def replies(stream):
    """The messages that come, one after the other."""
    while True:
        length = 0
        while (line := stream.readline()) not in (b"\r\n", b""):
            if line.lower().startswith(b"content-length:"):
                length = int(line.split(b":")[1])
        if not length:
            return
        yield json.loads(stream.read(length))


def windows_path(path):
    """Wine shows the root of this machine as its drive Z."""
    return "Z:" + str(path).replace("/", "\\")


class Windows(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def write(self, name, text=WRONG):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text.encode() if isinstance(text, str) else text)
        return file

    def codes(self, *arguments, **options):
        result = run("isolint", "--no-config", "--format", "json", *arguments, **options)
        self.assertEqual(result.stderr, b"")
        return [(each["file"], each["code"]) for each in json.loads(result.stdout)]

    # --- Names of files

    def test_names_may_have_any_letters(self):
        for name in ("part with blanks.iso", "più è così ß €.iso", "część.iso", "零件.iso"):
            file = self.write(name)
            self.assertEqual(self.codes(name, cwd=self.folder), [(name, "ISO028")])
            self.assertEqual(self.codes(file), [(str(file), "ISO028")])
            result = run("isofmt", "-i", self.write("untidy " + name, UNTIDY))
            self.assertEqual((result.returncode, (self.folder / ("untidy " + name)).read_bytes().decode()), (0, TIDY), result.stderr)

    def test_drives_and_backslashes_are_shown_with_slashes(self):
        file = self.write("parts/a.iso")
        shown = "Z:" + str(file)
        self.assertEqual(self.codes(windows_path(file)), [(shown, "ISO028")])
        self.assertEqual(self.codes(windows_path(file.parent)), [(shown, "ISO028")])
        self.assertEqual(self.codes(r"parts\a.iso", cwd=self.folder), [("parts/a.iso", "ISO028")])
        named = ("--stdin-filename", r"C:\parts\a.iso", "-")
        self.assertEqual(self.codes(*named, input=WRONG.encode()), [("C:/parts/a.iso", "ISO028")])
        self.assertIn(b"--- C:/parts/a.iso", run("isofmt", "--no-config", "--diff", *named, input=UNTIDY.encode()).stdout)
        self.assertIn(b"parts/a.iso:4: ", run("isorun", "--no-config", r"parts\a.iso", cwd=self.folder).stderr)
        self.write("parts/b.iso", WRONG.replace("X10", "X11"))
        both = run("isodiff", "--no-config", "--format", "markdown", r"parts\a.iso", r"parts\b.iso", cwd=self.folder)
        self.assertIn(b"parts/a.iso -> parts/b.iso", both.stdout)
        self.assertIn(b"parts/none.iso: ", run("isodiff", r"parts\a.iso", r"parts\none.iso", cwd=self.folder).stderr)

    def test_an_absolute_path_is_no_option(self):
        report = self.folder / "report.json"
        result = run("isolint", "--no-config", "--output", report, "--format", "json", self.write("a.iso"))
        self.assertEqual((result.returncode, result.stderr), (1, b""))
        self.assertEqual(len(json.loads(report.read_text())), 1)

    def test_paths_may_be_longer_than_260_characters(self):
        deep = self.folder
        while len(str(deep)) < 400:
            deep = deep / ("folder" * 5)
        file = self.write(deep.relative_to(self.folder) / "a.iso", UNTIDY)
        self.assertEqual(run("isofmt", "-i", file).returncode, 0)
        self.assertEqual(file.read_bytes().decode(), TIDY)
        self.assertEqual(list(file.parent.iterdir()), [file])

    def test_folders_may_be_deeper_than_260_characters(self):
        deep = pathlib.Path("top")
        while len(str(deep)) < 400:
            deep = deep / ("folder" * 5)
        file = self.write(deep / "a.iso", UNTIDY)
        self.write(deep.parent / "b.iso")
        self.assertEqual({pathlib.Path(name).name for name, _ in self.codes("top", cwd=self.folder)}, {"b.iso"})
        result = run("isofmt", "-i", "top", cwd=self.folder)
        self.assertEqual((result.returncode, file.read_bytes().decode()), (0, TIDY), result.stderr)

    def share(self):
        """A folder as a share of a server, beside a folder of this computer that is called the same."""
        prefix = PROGRAMS.parent / "wine"  # As cmake/windows.cmake has it.
        server = f"server-{os.getpid()}"
        twin = prefix / "drive_c" / server
        link = prefix / "dosdevices" / "unc" / server / "share"
        for made in (twin, link.parent):
            made.mkdir(parents=True)
            self.addCleanup(shutil.rmtree, made)
        (twin / "share").mkdir()
        link.symlink_to(self.folder)
        return rf"\\{server}\share", twin / "share"

    def test_shares_of_servers_are_no_folders_of_this_computer(self):
        share, twin = self.share()
        (twin / "a.iso").write_text(UNTIDY + "; of this computer\r\n")
        before = (twin / "a.iso").read_bytes()
        for command in (("isofmt", "-i"), ("isolint", "--no-config", "--select", "W125", "--fix")):
            for written in (share + r"\a.iso", share.replace("\\", "/") + "/a.iso"):
                file = self.write("a.iso", UNTIDY)
                run(*command, written)
                self.assertIn("M06 T101001", file.read_text(), (command, written))
                self.assertEqual((twin / "a.iso").read_bytes(), before)
        report = run("isolint", "--no-config", "--format", "json", "--output", share + r"\report.json", share + r"\a.iso")
        self.assertEqual(report.stderr, b"")
        self.assertEqual(json.loads((self.folder / "report.json").read_text()), [])
        self.assertEqual(list(twin.iterdir()), [twin / "a.iso"])

    def test_programs_on_a_share_have_its_configuration_and_its_name(self):
        share, _ = self.share()
        shown = share.replace("\\", "/")
        self.write("più/a.iso")
        self.assertEqual(self.codes(share), [(shown + "/più/a.iso", "ISO028")])
        sarif = run("isolint", "--no-config", "--format", "sarif", share)
        self.assertIn("file:" + shown + "/pi%C3%B9/a.iso", sarif.stdout.decode())
        self.write("isocnc.json", json.dumps({"lint": {"ignore": ["ISO028"]}}))
        self.assertEqual(run("isolint", share + "\\più\\a.iso").returncode, 0)
        server, messages = self.server()
        uri = "file:" + shown + "/pi%C3%B9/a.iso"
        document = {"uri": uri, "languageId": "isocnc", "version": 1, "text": WRONG}
        server.stdin.write(framed({"jsonrpc": "2.0", "method": "initialized", "params": {}}))
        server.stdin.write(framed({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}}))
        server.stdin.flush()
        published = (each["params"] for each in messages if each.get("method") == "textDocument/publishDiagnostics")
        self.assertEqual(next(each for each in published if each["uri"] == uri)["diagnostics"], [])

    def test_patterns_in_configurations_are_written_with_slashes(self):
        self.write("isocnc.json", json.dumps({"lint": {"exclude": ["old/**"]}}))
        self.write("old/deep/a.iso")
        self.write("new/b.iso")
        result = run("isolint", "--format", "concise", ".", cwd=self.folder)
        self.assertIn(b"new/b.iso:4:", result.stdout)
        self.assertNotIn(b"old", result.stdout)

    # --- Files that others use

    def test_a_file_that_another_program_holds_is_reported(self):
        file = self.write("a.iso", UNTIDY)
        with subprocess.Popen([*HOLD_FILE, windows_path(file)], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
            self.assertEqual(holder.stdout.readline().strip(), b"held")
            lint = run("isolint", "--no-config", file)
            self.assertEqual(lint.returncode, 2)
            self.assertEqual(lint.stderr.decode().splitlines()[0], f"isolint: {file}: cannot read: In use by another program")
            tidy = run("isofmt", "-i", file, environment={"LC_ALL": "it_IT.UTF-8"})
            self.assertEqual(tidy.returncode, 2)
            self.assertIn("non si può leggere: in uso da un altro programma", tidy.stderr.decode())
            holder.communicate(b"")
        self.assertEqual(file.read_bytes().decode(), UNTIDY)
        self.assertEqual(run("isofmt", "-i", file).returncode, 0)

    def test_a_watch_waits_for_a_file_that_another_program_holds(self):
        file = self.write("a.iso")
        with subprocess.Popen([*HOLD_FILE, windows_path(file)], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
            self.assertEqual(holder.stdout.readline().strip(), b"held")
            with subprocess.Popen([PROGRAMS / "isolint", "--watch", "--no-config", "--format", "concise", "--lang", "en", "."], cwd=self.folder,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as watch:
                self.addCleanup(watch.kill)
                self.assertEqual(watch.stdout.readline(), b"0 errors, 0 warnings in 0 files; watching\n")
                self.assertEqual(watch.stdout.readline(), b"isolint: a.iso: cannot read: In use by another program\n")
                self.assertEqual(watch.stdout.readline(), b"0 errors, 0 warnings in 0 files; watching\n")
                holder.communicate(b"")
                self.assertIn(b"a.iso:4:1: error:", watch.stdout.readline())
                self.assertEqual(watch.stdout.readline(), b"1 error, 0 warnings in 1 file; watching\n")
                watch.kill()

    def test_a_replaced_file_is_the_old_or_the_new_one(self):
        file = self.write("a.iso", UNTIDY)
        with open(file, "rb") as reader:
            self.assertEqual(run("isofmt", "-i", file).returncode, 0)
            self.assertEqual(reader.read().decode(), UNTIDY)
        self.assertEqual(file.read_bytes().decode(), TIDY)
        self.assertEqual([each.name for each in self.folder.iterdir()], ["a.iso"])

    def test_a_file_with_two_names_is_not_replaced(self):
        file = self.write("a.iso", UNTIDY)
        os.link(file, self.folder / "b.iso")
        result = run("isofmt", "-i", file)
        self.assertEqual(result.returncode, 2)
        self.assertIn("has other names (hard links)", result.stderr.decode())
        self.assertEqual(file.read_bytes().decode(), UNTIDY)

    def test_a_read_only_file_is_not_replaced(self):
        file = self.write("a.iso", UNTIDY)
        file.chmod(0o444)
        self.assertEqual(run("isofmt", "-i", file).returncode, 2)
        self.assertEqual(file.read_bytes().decode(), UNTIDY)

    def replaced_while(self, others_work):
        """What comes of a replacement during which others work on the file."""
        file = self.write("a.iso", "old")
        with subprocess.Popen([*REPLACE_FILE, windows_path(file)], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as replacement:
            self.assertEqual(replacement.stdout.readline().strip(), b"begun")
            others_work(file)
            return replacement.communicate(b"")[0].decode().strip()

    def test_a_file_that_changes_meanwhile_is_not_replaced(self):
        def write_another(file):
            other = self.write("other", "old")
            os.utime(other, ns=(file.stat().st_atime_ns, file.stat().st_mtime_ns))
            other.rename(file)

        def write_older(file):
            file.write_text("OLD", encoding="ascii")
            os.utime(file, (0, 0))

        changes = {
            "written": lambda file: file.write_text("more", encoding="ascii"),
            "older": write_older,
            "another": write_another,
            "second name": lambda file: os.link(file, self.folder / "b.iso"),
        }
        for name, change in changes.items():
            with self.subTest(name):
                self.assertIn("left as it is", self.replaced_while(change))
                self.assertNotEqual((self.folder / "a.iso").read_text(encoding="ascii"), "new")
                for file in self.folder.iterdir():
                    file.unlink()
        self.assertEqual(self.replaced_while(lambda file: None), "replaced")
        self.assertEqual([(each.name, each.read_text(encoding="ascii")) for each in self.folder.iterdir()], [("a.iso", "new")])

    def test_a_file_that_is_removed_meanwhile_does_not_come_back(self):
        self.assertNotEqual(self.replaced_while(lambda file: file.unlink()), "replaced")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_hidden_file_stays_hidden(self):
        self.write("a.iso", UNTIDY)
        attrib = [*EMULATOR, "cmd", "/c", "attrib"]
        subprocess.run([*attrib, "+H", "a.iso"], cwd=self.folder, check=True, timeout=60)
        self.assertEqual(run("isofmt", "-i", "a.iso", cwd=self.folder).returncode, 0)
        shown = subprocess.run([*attrib, "a.iso"], cwd=self.folder, check=True, timeout=60, capture_output=True).stdout
        self.assertIn(b"H", shown[:12])

    # --- Text

    def test_line_ends_stay_as_they_are(self):
        both = "M06 T101001\r\ng00 x0\n\rM02\r"
        formatted = run("isofmt", "-", input=both.encode())
        self.assertEqual(formatted.stdout.decode(), "M06 T101001\r\nG00 X0\n\rM02\r")
        self.assertNotIn(b"\r", run("isolint", "--no-config", self.write("a.iso", WRONG.replace("\n", "\r\n"))).stdout)

    def test_a_large_file_is_read(self):
        lines = "".join(f"G01 X{i}.5 Y{i % 977} F1200\r\n" for i in range(400_000))
        file = self.write("large.iso", "M06 T101001\r\nS12000 M03\r\n" + lines + "G02 X20\r\nM05\r\nM02\r\n")
        self.assertGreater(file.stat().st_size, 9 << 20)
        self.assertEqual(self.codes(file), [(str(file), "ISO028")])

    def test_the_language_is_that_of_the_environment(self):
        file = self.write("a.iso")
        self.assertIn("errore", run("isolint", "--no-config", file, environment={"LANG": "it_IT.UTF-8"}).stdout.decode())
        self.assertIn("error", run("isolint", "--no-config", file).stdout.decode())

    # --- Servers

    def test_isols_serves_at_a_port(self):
        with subprocess.Popen([PROGRAMS / "isols", "--tcp", "0"], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE) as server:
            address = server.stderr.readline().decode().strip().rsplit(" ", 1)[-1]
            host, port = address.split(":")
            with socket.create_connection((host, int(port)), timeout=60) as client:
                stream = client.makefile("rb")
                client.sendall(framed({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}}))
                self.assertEqual(next(replies(stream))["result"]["serverInfo"]["name"], "isols")
                client.sendall(framed({"jsonrpc": "2.0", "id": 2, "method": "shutdown"}) + framed({"jsonrpc": "2.0", "method": "exit"}))
                self.assertEqual(next(replies(stream))["id"], 2)
            self.assertEqual(server.wait(60), 0)

    def test_a_port_that_another_program_has_is_reported(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            for program, option in (("isols", "--tcp"), ("isodap", "--server")):
                result = run(program, option, port)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stderr.decode().strip(), f"{program}: 127.0.0.1:{port}: Address already in use")

    def test_isodap_serves_at_a_port(self):
        with subprocess.Popen([PROGRAMS / "isodap", "--server", "0"], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE) as server:
            host, port = server.stderr.readline().decode().strip().rsplit(" ", 1)[-1].split(":")
            with socket.create_connection((host, int(port)), timeout=60) as client:
                stream = client.makefile("rb")
                client.sendall(framed({"seq": 1, "type": "request", "command": "initialize", "arguments": {"adapterID": "isocnc"}}))
                self.assertTrue(next(replies(stream))["body"]["supportsStepBack"])
                client.sendall(framed({"seq": 2, "type": "request", "command": "disconnect"}))
                self.assertTrue(any(reply.get("command") == "disconnect" for reply in replies(stream)))
            self.assertEqual(server.wait(60), 0)

    def server(self, **initialize):
        """A server at its standard streams, and its messages."""
        server = subprocess.Popen([PROGRAMS / "isols"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.stdin.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        params = {"capabilities": {}} | initialize
        server.stdin.write(framed({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": params}))
        server.stdin.flush()
        messages = replies(server.stdout)
        self.assertEqual(next(messages)["id"], 1)
        return server, messages

    def test_isols_knows_a_file_by_its_uri(self):
        self.write("isocnc.json", json.dumps({"lint": {"ignore": ["ISO028"]}}))
        file = self.write("più.iso")
        server, messages = self.server()
        uri = "file:///z%3A" + str(file).replace("ù", "%C3%B9")
        document = {"uri": uri, "languageId": "isocnc", "version": 1, "text": WRONG}
        server.stdin.write(framed({"jsonrpc": "2.0", "method": "initialized", "params": {}}))
        server.stdin.write(framed({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}}))
        server.stdin.flush()
        published = (each["params"] for each in messages if each.get("method") == "textDocument/publishDiagnostics")
        shown = next(each for each in published if each["uri"] == uri)
        self.assertEqual(shown["diagnostics"], [])

    def test_isols_ends_while_its_input_stays_open(self):
        server, messages = self.server()
        server.stdin.write(framed({"jsonrpc": "2.0", "id": 2, "method": "shutdown"}) + framed({"jsonrpc": "2.0", "method": "exit"}))
        server.stdin.flush()
        self.assertEqual(next(messages)["id"], 2)
        self.assertEqual(server.wait(60), 0)

    def test_isols_ends_with_its_input(self):
        server, _ = self.server()
        server.stdin.close()
        self.assertEqual(server.wait(60), 1)

    def test_isols_ends_with_the_editor_that_started_it(self):
        # A number that no process has: those of Windows are multiples of four.
        server, _ = self.server(processId=999_999)
        self.assertEqual(server.wait(60), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
