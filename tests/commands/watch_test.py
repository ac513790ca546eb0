#!/usr/bin/env python3
"""isolint --watch: what it reports while programs are written, renamed and removed, and how it ends.

The tests wait for lines and never for a time; program_changes_test.cpp tests what counts as settled.
"""

import json
import os
import pathlib
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

ISOLINT = pathlib.Path(sys.argv[1]).resolve() / "isolint"
# Wine passes no signal of this machine on as Ctrl-C.
TAKES_SIGNALS = sys.argv[2:] != ["--no-signals"]

GOOD = "M06 T101001\nM02\n"
WRONG = "M06 T101001\nS12000 M03\nG01 X10 F1200\nG02 X20\nM05\nM02\n"


class Watch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def start(self, *arguments):
        kept = {key: value for key, value in os.environ.items() if not key.startswith("LC_") and key not in ("LANG", "NO_COLOR")}
        self.watch = subprocess.Popen([str(ISOLINT), "--watch", "--format", "concise", *arguments], cwd=self.folder, text=True,
                                      encoding="utf-8", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=kept | {"LC_ALL": "C.UTF-8"})
        self.addCleanup(self.watch.stdout.close)
        self.addCleanup(self.watch.wait)
        self.addCleanup(self.watch.kill)
        self.lines = queue.Queue()
        put, stream = self.lines.put, self.watch.stdout
        threading.Thread(target=lambda: [put(line.rstrip("\n")) for line in stream], daemon=True).start()

    def until(self, last):
        """The lines up to the one that ends like this, without it; findings are shortened to `name:line CODE`."""
        lines = []
        while not (line := self.lines.get(timeout=120)).endswith(last):
            parts = line.split(":")
            is_finding = line.endswith("]")
            lines.append(f"{parts[0]}:{parts[1]} {line[line.rindex('[') + 1:-1]}" if is_finding else line)
        return sorted(lines)

    def end(self, by=signal.SIGINT):
        if not TAKES_SIGNALS:
            return None
        self.watch.send_signal(by)
        return self.watch.wait(120)

    def test_programs_are_checked_again_as_they_change(self):
        self.write("a.iso", WRONG)
        self.write("sub/b.nc", GOOD)
        self.write("notes.txt", WRONG)
        self.start()
        self.assertEqual(self.until("1 error, 0 warnings in 2 files; watching"), ["a.iso:4 ISO028"])
        # Only what has changed is reported.
        self.write("sub/b.nc", WRONG)
        self.assertEqual(self.until("2 errors, 0 warnings in 2 files; watching"), ["sub/b.nc:4 ISO028"])
        self.write("a.iso", GOOD)
        self.assertEqual(self.until("1 error, 0 warnings in 2 files; watching"), ["isolint: a.iso: no findings"])
        # Written beside it and renamed, as many programs save.
        self.write("a.tmp", WRONG).replace(self.folder / "a.iso")
        self.assertEqual(self.until("2 errors, 0 warnings in 2 files; watching"), ["a.iso:4 ISO028"])
        self.write("new/deep/c.CNC", WRONG)
        self.assertEqual(self.until("3 errors, 0 warnings in 3 files; watching"), ["new/deep/c.CNC:4 ISO028"])
        (self.folder / "a.iso").rename(self.folder / "d.iso")
        self.assertEqual(self.until("3 errors, 0 warnings in 3 files; watching"), ["d.iso:4 ISO028", "isolint: a.iso: removed"])
        (self.folder / "d.iso").unlink()
        self.assertEqual(self.until("2 errors, 0 warnings in 2 files; watching"), ["isolint: d.iso: removed"])
        if TAKES_SIGNALS:
            self.assertEqual(self.end(), 1)

    def test_configurations_count_anew(self):
        self.write("parts/a.iso", WRONG)
        self.write("parts/b.iso", GOOD)
        self.start("parts")
        self.until("1 error, 0 warnings in 2 files; watching")
        self.write("isocnc.json", '{"lint": {"ignore": ["ISO028"]}}')
        self.until("0 errors, 0 warnings in 2 files; watching")
        self.write("isocnc.json", '{"lint": {"ignored": []}}')
        self.assertEqual(self.until("error: lint.ignored: unknown key; did you mean ignore?"), [])
        self.write("isocnc.json", '{"lint": {"exclude": ["a.*"]}}')
        self.assertEqual(self.until("0 errors, 0 warnings in 1 file; watching"),
                         ["isolint: parts/a.iso: removed", "isolint: parts/b.iso: no findings"])
        (self.folder / "isocnc.json").unlink()
        self.assertIn("parts/a.iso:4 ISO028", self.until("1 error, 0 warnings in 2 files; watching"))
        subprocess.run(["git", "init", "-q", str(self.folder)], check=True)
        self.write("parts/.gitignore", "a.iso\n")
        self.assertEqual(self.until("0 errors, 0 warnings in 1 file; watching"), ["isolint: parts/a.iso: removed"])
        if TAKES_SIGNALS:
            self.assertEqual(self.end(signal.SIGTERM), 0)

    def test_a_baseline_counts_anew(self):
        self.write("a.iso", WRONG)
        known = {"version": 1, "findings": []}
        self.write("known.json", json.dumps(known))
        self.start("--baseline", "known.json", "a.iso")
        self.until("1 error, 0 warnings in 1 file; 0 in the baseline; watching")
        subprocess.run([str(ISOLINT), "--write-baseline", "known.json", "a.iso"], cwd=self.folder, check=True, capture_output=True)
        self.until("0 errors, 0 warnings in 1 file; 1 in the baseline; watching")
        self.write("known.json", "{")
        self.assertIn("known.json", self.lines.get(timeout=120))
        if TAKES_SIGNALS:
            self.assertEqual(self.end(), 2)

    def test_a_file_that_cannot_be_read_does_not_end_it(self):
        self.write("a.iso", "\0\1\2\3" * 100)
        self.write("b.iso", WRONG)
        self.start("a.iso", "b.iso", "later.iso")
        self.assertEqual(self.until("1 error, 0 warnings in 1 file; watching"),
                         ["b.iso:4 ISO028", "isolint: a.iso: looks like a binary file", "isolint: later.iso: cannot read: No such file or directory"])
        self.write("later.iso", GOOD)
        self.assertEqual(self.until("1 error, 0 warnings in 2 files; watching"), ["isolint: later.iso: no findings"])
        if TAKES_SIGNALS:
            self.assertEqual(self.end(), 2)

    def test_its_status_is_that_of_the_last_state(self):
        if not TAKES_SIGNALS:
            self.skipTest("no signals")
        for text, options, status in ((WRONG, [], 1), (GOOD, [], 0), (WRONG, ["--exit-zero"], 0)):
            self.write("a.iso", text)
            self.start(*options)
            self.until("watching")
            self.assertEqual(self.end(), status)
        self.start("--lang", "it")
        self.until("1 errore, 0 avvisi in 1 file; in attesa di modifiche")

    def test_options_that_do_not_go_with_it(self):
        self.write("a.iso", GOOD)
        for options, complaint in (
                (["--format", "json"], "--watch: only with --format text, concise"), (["-"], "--watch: standard input cannot be watched"),
                (["--fix"], "--fix excludes --watch"), (["--diff"], "--diff excludes --watch"), (["--output", "x"], "--output excludes --watch"),
                (["--statistics"], "--statistics excludes --watch"), (["--write-baseline", "x"], "--write-baseline excludes --watch")):
            result = subprocess.run([str(ISOLINT), "--lang", "en", "--watch", *options], cwd=self.folder, capture_output=True, text=True,
                                    input="", timeout=120, check=False)
            self.assertEqual(result.returncode, 2, options)
            self.assertIn(complaint, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
