#!/usr/bin/env python3
"""Packs what a build has made, installs it into scratch folders, uses it, and takes it away again.

usage: packages_test.py BUILD_FOLDER. What is not there to test with (dpkg, lintian) is skipped.
"""

import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ["isolint", "isofmt", "isorun", "isodiff", "isols", "isodap"]
VERSION = re.search(r"project\(isocnc VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
BROKEN = "examples/broken/pocket.iso"

build = Path()
scratch = Path()


def must(*command: object, **options: object) -> str:
    done = subprocess.run(
        [str(each) for each in command],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
        **options,
    )
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def pack(generator: str, pattern: str) -> Path:
    """A package of what has been built: no part of the build is run again for it."""
    folder = scratch / generator
    must("cpack", "--config", build / "CPackConfig.cmake", "-G", generator, "-B", folder)
    (package,) = folder.glob(pattern)
    return package


def pages_of_findings(isols: Path) -> set[str]:
    """The files that a language server names for the codes of its findings."""
    document = {"uri": "file:///part.iso", "languageId": "isocnc", "version": 1, "text": (ROOT / BROKEN).read_text()}
    messages = [
        {"id": 1, "method": "initialize", "params": {"processId": None, "rootUri": None, "capabilities": {}}},
        {"method": "initialized", "params": {}},
        {"method": "textDocument/didOpen", "params": {"textDocument": document}},
        {"id": 2, "method": "textDocument/diagnostic", "params": {"textDocument": {"uri": document["uri"]}}},
    ]
    with subprocess.Popen([isols], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as server:
        for message in messages:
            text = json.dumps({"jsonrpc": "2.0"} | message).encode()
            server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(text) + text)
        server.stdin.flush()
        answer = {}
        while answer.get("id") != 2:
            length = int(server.stdout.readline().removeprefix(b"Content-Length: "))
            server.stdout.readline()
            answer = json.loads(server.stdout.read(length))
        server.terminate()
    return {unquote(each["codeDescription"]["href"].partition("#")[0]) for each in answer["result"]["items"]}


def files_below(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir())


class Installed(unittest.TestCase):
    def check_programs(self, prefix: Path) -> None:
        for program in PROGRAMS:
            self.assertIn(VERSION, must(prefix / "bin" / program, "--version"))
            sections = must("readelf", "--section-headers", "--wide", prefix / "bin" / program)
            self.assertNotIn(".symtab", sections, f"{program} is not stripped")
            for folder, heading in (("man1", "SEE ALSO"), ("it/man1", "VEDERE ANCHE")):
                manual = gzip.decompress((prefix / f"share/man/{folder}/{program}.1.gz").read_bytes()).decode()
                self.assertIn(f'"isocnc {VERSION}"', manual)
                self.assertIn(f".SH {heading}\n", manual)
            self.assertTrue((prefix / f"share/bash-completion/completions/{program}").is_file())
            self.assertTrue((prefix / f"share/fish/vendor_completions.d/{program}.fish").is_file())
        self.assertTrue((prefix / "share/zsh/vendor-completions/_isocnc").is_file())
        documents = prefix / "share/doc/isocnc"
        self.assertIn("Permission is hereby granted", (documents / "copyright").read_text())
        self.assertEqual(
            gzip.decompress((documents / "changelog.gz").read_bytes()), (ROOT / "CHANGELOG.md").read_bytes()
        )
        # The files that the first steps name (docs/operator.md), and the pages in both languages.
        for file in ("examples/machine/isocnc.json", "docs/operator.md", "docs/it/operatore.md", "docs/it/macchina.md"):
            self.assertTrue((documents / file).is_file(), file)
        posts = prefix / "share/isocnc/posts"
        self.assertEqual(files_below(posts), [file for file in files_below(ROOT / "posts") if "__pycache__" not in file])
        job = [ROOT / "tests/posts/jobs/pocket.json", "--origin", "350,220,-180", "--head", "1", "--holder", "1"]
        self.assertIn("M06 T101001\n", must(sys.executable, posts / "freecad/isocnc_post.py", *job))
        self.assertEqual(pages_of_findings(prefix / "bin/isols"), {"file://" + str((documents / "docs/rules.md").resolve())})
        broken = subprocess.run(
            [prefix / "bin/isolint", "--lang", "en", documents / BROKEN], capture_output=True, text=True, check=False
        )
        self.assertEqual(broken.returncode, 1)
        self.assertIn("error[ISO035]", broken.stdout)


@unittest.skipUnless(shutil.which("dpkg"), "there is no dpkg")
class DebianPackage(Installed):
    @classmethod
    def setUpClass(cls) -> None:
        cls.package = pack("DEB", "*.deb")

    def test_it_is_named_after_the_version(self) -> None:
        self.assertRegex(self.package.name, rf"^isocnc_{re.escape(VERSION)}_\w+\.deb$")

    def test_it_installs_runs_and_goes(self) -> None:
        root = scratch / "root"
        for folder in ("info", "updates"):
            (root / "var/lib/dpkg" / folder).mkdir(parents=True)
        for file in ("status", "available"):
            (root / "var/lib/dpkg" / file).touch()
        before = files_below(root)
        forced = [f"--force-{what}" for what in ("not-root", "depends", "bad-path", "unsafe-io")]
        dpkg = ["dpkg", f"--root={root}", "--log=/dev/null", *forced]
        must(*dpkg, "--install", self.package)
        self.check_programs(root / "usr")
        must(*dpkg, "--purge", "isocnc")
        left = [path for path in files_below(root) if not path.startswith("var/lib/dpkg/")]
        self.assertEqual(left, [path for path in before if not path.startswith("var/lib/dpkg/")])
        self.assertFalse((root / "usr").exists())

    def test_it_names_the_libraries_that_it_takes(self) -> None:
        self.assertIn("libc6", must("dpkg-deb", "--field", self.package, "Depends"))

    @unittest.skipUnless(shutil.which("lintian"), "there is no lintian")
    def test_lintian_finds_nothing(self) -> None:
        reported = must("lintian", "--fail-on=error,warning", "--allow-root", self.package)
        self.assertEqual(reported, "")


class Archive(Installed):
    def test_it_runs_wherever_it_is_unpacked(self) -> None:
        package = pack("TGZ", "*.tar.gz")
        folder = scratch / "some where else"
        with tarfile.open(package) as archive:
            archive.extractall(folder)
        (top,) = folder.iterdir()
        self.check_programs(top)


class Libraries(unittest.TestCase):
    def test_the_example_uses_them(self) -> None:
        must("cmake", "--install", build, "--component", "development", "--prefix", scratch / "first")
        prefix = (scratch / "first").rename(scratch / "moved to")
        self.assertNotIn(str(ROOT), "".join(path.read_text() for path in prefix.rglob("*.cmake")))
        made = scratch / "example"
        compiler = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", (build / "CMakeCache.txt").read_text()).group(1)
        must("cmake", "-S", ROOT / "examples/library", "-B", made, "-D", f"CMAKE_PREFIX_PATH={prefix}", "-D",
             f"CMAKE_CXX_COMPILER={compiler}")  # fmt: skip
        must("cmake", "--build", made)
        program = made / "look_at_program"
        good = must(program, ROOT / "examples/pocket.iso")
        summary = must(build / "bin/isorun", "--lang", "en", ROOT / "examples/pocket.iso")
        blocks = re.search(r"blocks: (\d+)", summary).group(1)
        seconds = re.search(r"cycle time: ([\d.]+) s", summary).group(1)
        self.assertEqual(good, f"{blocks} blocks, {seconds} s\n")
        bad = subprocess.run([program, ROOT / BROKEN], capture_output=True, text=True, check=False)
        self.assertEqual(bad.returncode, 1)
        findings = subprocess.run(
            [build / "bin/isolint", "--no-config", "--lang", "en", "--format", "concise", ROOT / BROKEN],
            capture_output=True,
            text=True,
            check=False,
        ).stdout.splitlines()
        reported = re.findall(r"^line (\d+): .* \[(\w+)\]$", bad.stdout, re.MULTILINE)
        self.assertEqual(reported, [re.search(r":(\d+):\d+: .* \[(\w+)\]$", line).groups() for line in findings])
        missing = subprocess.run([program, scratch / "none.iso"], capture_output=True, check=False)
        self.assertEqual(missing.returncode, 2)


if __name__ == "__main__":
    build = Path(sys.argv.pop(1)).resolve()
    with tempfile.TemporaryDirectory(prefix="isocnc-packages-") as folder:
        scratch = Path(folder)
        os.environ["LC_ALL"] = "C.UTF-8"
        unittest.main()
