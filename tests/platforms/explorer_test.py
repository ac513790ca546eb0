#!/usr/bin/env python3
"""The entries in the menus of the Explorer: added, run and removed by the scripts that the packages have for them.

usage: explorer_test.py ISOLINT.EXE RUN_VERB.EXE -- COMMAND...    what runs programs for Windows here
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ISOLINT, RUN_VERB = map(pathlib.Path, sys.argv[1:3])
EMULATOR = sys.argv[4:]
SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "cmake" / "windows"
WRONG = "M06 T101001\nS12000 M03\nG01 X10 F1200\nG02 X20\nM05\nM02\n"
CLASSES = [*(f"SystemFileAssociations\\{extension}" for extension in (".iso", ".nc", ".cnc", ".tap", ".ngc")), "Directory", "Drive", "Directory\\Background"]


def windows_path(path):
    return "Z:" + str(path).replace("/", "\\")


class Explorer(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        # As where programs are installed, and where Italians keep their parts.
        self.programs = pathlib.Path(folder.name).resolve() / "Program Files (x86) & più"
        self.programs.mkdir()
        shutil.copy(ISOLINT, self.programs / "isolint.exe")
        for script in SCRIPTS.glob("*.cmd"):
            shutil.copy(script, self.programs)
        self.parts = self.programs.parent / "pezzi di più & meno"
        self.parts.mkdir()
        self.addCleanup(self.run_script, "remove-from-explorer.cmd")

    def start(self, *arguments, language="C.UTF-8"):
        kept = {key: value for key, value in os.environ.items() if not key.startswith("LC_") and key not in ("LANG", "NO_COLOR")}
        result = subprocess.run([*EMULATOR, *map(str, arguments)], env=kept | {"LC_ALL": language}, capture_output=True, timeout=120,
                                check=False, stdin=subprocess.DEVNULL, cwd=self.programs)
        return result.returncode, result.stdout.decode(errors="replace").replace("\r", "")

    def run_script(self, name, **options):
        return self.start("cmd", "/d", "/c", name, **options)

    def entries(self):
        """The names of the user's own classes, with their default values."""
        root = "HKEY_CURRENT_USER\\Software\\Classes\\"
        found, key = {}, None
        for line in self.start("reg", "query", root[:-1], "/s")[1].splitlines():
            if line.startswith(root):
                key = line[len(root):].strip()
                found[key] = None
            elif key and "REG_SZ" in line and line.strip().startswith("("):  # (Default), in the language of the system.
                found[key] = line.split("REG_SZ", 1)[1].strip()
        return found

    def test_entries_check_programs_and_folders(self):
        status, said = self.run_script("add-to-explorer.cmd")
        self.assertEqual((status, said.splitlines()[:2]), (0, ["Check with isolint", "Watch with isolint"]))
        entries = self.entries()
        for each in CLASSES:
            self.assertEqual(entries[each + r"\shell\isolint"], "Check with isolint")
        self.assertNotIn(".iso", entries)  # Disk images are opened as before.
        for each in CLASSES[-3:]:
            self.assertIn(" --watch ", entries[each + r"\shell\isolint-watch\command"])
        self.assertIn('"%1."', entries[r"Drive\shell\isolint\command"])
        self.assertIn('"%V\\."', entries[r"Directory\Background\shell\isolint\command"])
        for name in ("part.iso", "già fatto (1) & bene.iso", "100%.iso"):
            program = self.parts / name
            program.write_text(WRONG)
            status, text = self.start(RUN_VERB, CLASSES[0], "isolint", windows_path(program))
            self.assertEqual(status, 0, text)
            self.assertIn("error[ISO028]", text, name)
            self.assertIn(name + ":4:1", text)
            program.unlink()
        (self.parts / "a.nc").write_text(WRONG)
        self.assertIn("a.nc:4:1", self.start(RUN_VERB, "Directory", "isolint", windows_path(self.parts))[1])

        self.assertEqual(self.run_script("remove-from-explorer.cmd"), (0, ""))
        self.assertEqual([key for key in self.entries() if "isolint" in key], [])
        self.assertEqual(self.run_script("remove-from-explorer.cmd"), (0, ""))

    def test_entries_are_in_the_language_of_the_user(self):
        status, said = self.run_script("add-to-explorer.cmd", language="it_IT.UTF-8")
        self.assertEqual((status, said.splitlines()[:2]), (0, ["Verifica con isolint", "Tieni d'occhio con isolint"]))

    def test_a_script_without_its_program_adds_nothing(self):
        (self.programs / "isolint.exe").unlink()
        status, said = self.run_script("add-to-explorer.cmd")
        self.assertEqual((status, said.splitlines()[0]), (1, "There is no isolint.exe beside add-to-explorer.cmd."))
        self.assertEqual([key for key in self.entries() if "isolint" in key], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
