#!/usr/bin/env python3
"""Looks into the files that scripts/release makes, and starts the programs in them.

usage: release_test.py           those for this platform, packed of what build/release holds
       release_test.py FOLDER    those of a release that has been made

Exit status: 77 where what the packing takes is missing.
"""

import hashlib
import json
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(isocnc VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
PROGRAMS = ["isolint", "isofmt", "isorun", "isodiff", "isols", "isodap"]
NOTICES = "third-party-notices.txt"
LISTS = {"SHA256SUMS", "sbom.spdx.json", "release-notes.md", NOTICES}
PROGRAMS_OF = {"linux-x64": f"isocnc-{VERSION}-linux-x64.tar.gz", "linux-arm64": f"isocnc-{VERSION}-linux-arm64.tar.gz",
               "windows-x64": f"isocnc-{VERSION}-windows-x64.zip"}  # fmt: skip
DEBIAN = {"linux-x64": f"isocnc_{VERSION}_amd64.deb", "linux-arm64": f"isocnc_{VERSION}_arm64.deb"}
VSIX = {"linux-x64": f"isocnc-linux-x64-{VERSION}.vsix", "linux-arm64": f"isocnc-linux-arm64-{VERSION}.vsix",
        "windows-x64": f"isocnc-win32-x64-{VERSION}.vsix", "web": f"isocnc-web-{VERSION}.vsix",
        "universal": f"isocnc-universal-{VERSION}.vsix"}  # fmt: skip
OFFLINE = {"linux-x64": f"isocnc-offline-{VERSION}-linux-x64.tar.gz", "linux-arm64": f"isocnc-offline-{VERSION}-linux-arm64.tar.gz",
           "windows-x64": f"isocnc-offline-{VERSION}-windows-x64.zip"}  # fmt: skip
MODULE = ("web", "universal")  # Those that hold the programs as a module.
EXPLORER_SCRIPTS = ("add-to-explorer.cmd", "remove-from-explorer.cmd")
NPM = f"isocnc-{VERSION}.tgz"
SITE = f"isocnc-site-{VERSION}.zip"
EMULATORS = {"linux-x64": [], "linux-arm64": ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"], "windows-x64": ["wine64", "wine"]}

made = Path()
scratch = Path()


def output_of(*command: object, **options: object) -> str:
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def contents(name: str) -> dict[str, bytes]:
    path = made / name
    if name.endswith(".deb"):
        tar = scratch / "deb.tar"
        with tar.open("wb") as file:
            subprocess.run(["dpkg-deb", "--fsys-tarfile", path], stdout=file, check=True)
        path = tar
    elif not name.endswith(("tar.gz", ".tgz")):
        with zipfile.ZipFile(path) as archive:
            return {member.filename: archive.read(member) for member in archive.infolist()}
    with tarfile.open(path) as archive:
        return {member.name: archive.extractfile(member).read() for member in archive if member.isfile()}


def platform_of_program(data: bytes) -> str:
    if data.startswith(b"MZ"):
        return "windows-x64"
    machine = int.from_bytes(data[18:20], "little") if data.startswith(b"\x7fELF") else 0
    return {0x3E: "linux-x64", 0xB7: "linux-arm64"}.get(machine, "unknown")


class Release(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.names = {path.name for path in made.iterdir()}
        cls.files = {name: contents(name) for name in cls.names - LISTS}
        cls.sbom = json.loads((made / "sbom.spdx.json").read_text())

    def those(self, names: dict[str, str]) -> list[tuple[str, str, dict[str, bytes]]]:
        return [(platform, name, self.files[name]) for platform, name in names.items() if name in self.names]

    def test_it_has_no_other_files(self) -> None:
        known = {*PROGRAMS_OF.values(), *DEBIAN.values(), *VSIX.values(), *OFFLINE.values(), NPM, SITE}
        self.assertLessEqual(LISTS, self.names)
        self.assertLessEqual(self.names - LISTS, known)
        self.assertTrue(self.names - LISTS)

    def test_the_sums_are_those_of_all_files(self) -> None:
        sums = dict(reversed(line.split("  ")) for line in (made / "SHA256SUMS").read_text().splitlines())
        self.assertEqual(sums, {name: hashlib.sha256((made / name).read_bytes()).hexdigest() for name in self.names - {"SHA256SUMS"}})

    def test_programs_are_those_of_their_platform(self) -> None:
        for platform, name, files in self.those(PROGRAMS_OF) + self.those(DEBIAN) + self.those(VSIX):
            in_bin = {Path(file).name: data for file, data in files.items() if "/bin/" in file}
            if name == PROGRAMS_OF["windows-x64"]:
                for script in EXPLORER_SCRIPTS:
                    self.assertTrue(in_bin.pop(script, b"").startswith(b"@echo off"), script)
            programs = {file: platform_of_program(data) for file, data in in_bin.items()}
            ending = ".exe" if platform == "windows-x64" else ""
            expected = {} if platform in MODULE else {program + ending: platform for program in PROGRAMS}
            self.assertEqual(programs, expected, name)

    def test_programs_hold_no_path_of_the_machine_that_built_them(self) -> None:
        if made.name == "packed":
            self.skipTest("these are of a build for tests")
        for name, files in self.files.items():
            for file, data in files.items():
                if "/bin/" in file or file.endswith(".wasm"):
                    self.assertNotRegex(data, rb"isocnc-release-\w|/build/(release|arm64|windows|web)/", f"{name}: {file}")

    def test_debian_packages_name_what_they_take(self) -> None:
        for platform, name, files in self.those(DEBIAN):
            self.assertEqual(output_of("dpkg-deb", "--field", made / name, "Architecture").strip(), name[:-4].rpartition("_")[2])
            taken = re.fullmatch(r"libc6 \(>= ([\d.]+)\)", output_of("dpkg-deb", "--field", made / name, "Depends").strip()).group(1)
            needed = {version for data in files.values() for version in re.findall(rb"GLIBC_(2[\d.]+)\0", data)}
            newest = max(tuple(int(part) for part in version.split(b".")) for version in needed)
            self.assertGreaterEqual(tuple(int(part) for part in taken.split(".")), newest, platform)

    def test_the_extension_is_for_its_platform(self) -> None:
        for platform, name, files in self.those(VSIX):
            target = "win32-x64" if platform == "windows-x64" else platform
            targets = re.findall(r'TargetPlatform="(.*?)"', files["extension.vsixmanifest"].decode())
            self.assertEqual(targets, [] if platform == "universal" else [target], name)
            self.assertEqual(json.loads(files["extension/package.json"])["version"], VERSION, name)
            modules = [file for file, data in files.items() if data.startswith(b"\0asm")]
            self.assertEqual(modules, ["extension/dist/web/isocnc.wasm"] if platform in MODULE else [], name)

    def test_each_package_holds_the_licenses_of_what_it_holds(self) -> None:
        packages = {package["SPDXID"]: package for package in self.sbom["packages"]}
        ids = {package["name"]: package["SPDXID"] for package in self.sbom["packages"]}
        whole = (made / NOTICES).read_text()
        for name, files in self.files.items():
            parts = [packages[each["relatedSpdxElement"]] for each in self.sbom["relationships"] if each["spdxElementId"] == ids[name]]
            self.assertTrue(parts, name)
            if name in OFFLINE.values():
                self.assertLessEqual({part["name"] for part in parts}, self.names)
                continue
            (notices,) = [data.decode() for file, data in files.items() if file.endswith("/" + NOTICES)]
            for part in parts:
                line = f"- {part['name']} {part['versionInfo']}: {part['licenseDeclared']}; "
                self.assertIn(line, notices, name)
                self.assertIn(line, whole)
            for text in ("PERMISSION" if "site" in name else "Emscripten" if name in (VSIX["web"], VSIX["universal"], NPM) else "GCC RUNTIME LIBRARY EXCEPTION",):
                self.assertIn(text.lower(), notices.lower(), name)

    def test_the_sbom_is_spdx(self) -> None:
        """What the specification of SPDX 2.3 requires, of what is used."""
        sbom = self.sbom
        self.assertEqual((sbom["spdxVersion"], sbom["dataLicense"], sbom["SPDXID"]), ("SPDX-2.3", "CC0-1.0", "SPDXRef-DOCUMENT"))
        self.assertRegex(sbom["documentNamespace"], r"^https://[^#]+$")
        self.assertRegex(sbom["creationInfo"]["created"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        self.assertRegex(sbom["creationInfo"]["creators"][0], r"^(Person|Organization|Tool): \S")
        ids = [package["SPDXID"] for package in sbom["packages"]]
        self.assertEqual(len(ids), len(set(ids)))
        for package in sbom["packages"]:
            self.assertRegex(package["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")
            self.assertTrue(package["name"] and package["versionInfo"])
            self.assertRegex(package["downloadLocation"], r"^(NOASSERTION|NONE|https://.+)$")
            self.assertIs(package["filesAnalyzed"], False)
            for word in re.split(r" (?:AND|OR|WITH) ", package["licenseDeclared"]):
                self.assertRegex(word, r"^[A-Za-z0-9.-]+$", package["name"])
            for checksum in package.get("checksums", []):
                digits = {"SHA256": 64, "SHA512": 128}[checksum["algorithm"]]
                self.assertRegex(checksum["checksumValue"], rf"^[0-9a-f]{{{digits}}}$")
            for reference in package.get("externalRefs", []):
                self.assertRegex(reference["referenceLocator"], r"^pkg:(deb/debian|npm)/[^@]+@\S+$")
        for each in sbom["relationships"]:
            self.assertIn(each["relationshipType"], ("DESCRIBES", "CONTAINS"))
            self.assertIn(each["relatedSpdxElement"], ids)
            self.assertIn(each["spdxElementId"], ["SPDXRef-DOCUMENT", *ids])
        described = {each["relatedSpdxElement"] for each in sbom["relationships"] if each["relationshipType"] == "DESCRIBES"}
        artifacts = {package["SPDXID"]: package for package in sbom["packages"] if package["SPDXID"] in described}
        self.assertEqual({package["packageFileName"] for package in artifacts.values()}, self.names - LISTS)
        for package in artifacts.values():
            data = (made / package["packageFileName"]).read_bytes()
            self.assertEqual(package["checksums"][0]["checksumValue"], hashlib.sha256(data).hexdigest())

    def test_the_sbom_names_what_is_compiled_in_and_bundled(self) -> None:
        named = {package["name"] for package in self.sbom["packages"]}
        self.assertLessEqual({"nlohmann-json", "Eigen", "CLI11", "fmt", "fast_float", "stb", "three", "vscode-languageclient"}, named)
        self.assertNotIn("esbuild", named)
        # Each compiler has its own.
        runtimes = [package for package in self.sbom["packages"] if package["name"] == "libstdc++"]
        self.assertEqual(len(runtimes), len(self.names & set(PROGRAMS_OF.values())))
        self.assertIs("musl" in named, NPM in self.names)

    def test_the_notes_are_those_of_the_changelog(self) -> None:
        notes = (made / "release-notes.md").read_text()
        changelog = (ROOT / "CHANGELOG.md").read_text()
        _, _, section = changelog.partition(f"\n## [{VERSION}]")
        section = section.partition("\n")[2].partition("\n## ")[0]
        self.assertTrue(section.strip())
        self.assertEqual(notes, f"# isocnc {VERSION}\n\n{section.strip()}\n")

    def test_archives_tell_nothing_of_who_made_them(self) -> None:
        for name in self.files:
            if name.endswith((".tar.gz", ".tgz")):
                with tarfile.open(made / name) as archive:
                    members = list(archive)
                facts = {(member.mtime, member.uid, member.gid, member.uname, member.gname) for member in members}
                order = [member.name for member in members]
            elif name.endswith((".zip", ".vsix")):
                with zipfile.ZipFile(made / name) as archive:
                    facts = {(member.date_time, member.create_system) for member in archive.infolist()}
                    order = archive.namelist()
            else:
                continue
            self.assertEqual(len(facts), 1, name)
            self.assertEqual(order, sorted(order), name)

    def test_bundles_hold_what_a_pc_without_a_network_takes(self) -> None:
        for platform, name, files in self.those(OFFLINE):
            top = name.removesuffix(".zip").removesuffix(".tar.gz")
            ending = ".exe" if platform == "windows-x64" else ""
            self.assertLessEqual({f"{top}/{VSIX[platform]}", f"{top}/README.txt", f"{top}/site/index.html", f"{top}/programs/bin/isolint{ending}"},
                                 set(files))  # fmt: skip
            self.assertEqual(files[f"{top}/{VSIX[platform]}"], (made / VSIX[platform]).read_bytes())
            readme = files[f"{top}/README.txt"].decode()
            self.assertIn(VSIX[platform], readme)
            self.assertNotIn("{", readme)

    def test_the_programs_run(self) -> None:
        for platform, name, _ in self.those(PROGRAMS_OF):
            emulator = EMULATORS[platform]
            if platform == "windows-x64":
                wine = next((found for each in (*emulator, "/usr/lib/wine/wine64") if (found := shutil.which(each))), None)
                emulator = [wine or "wine64"]
            if emulator and not shutil.which(emulator[0]):
                print(f"not started, since there is no {emulator[0]}: {name}")
                continue
            folder = scratch / f"unpacked {platform}"
            shutil.unpack_archive(made / name, folder)
            (top,) = folder.iterdir()
            ending = ".exe" if platform == "windows-x64" else ""
            for program in PROGRAMS:
                file = top / "bin" / (program + ending)
                file.chmod(0o755)
                environment = {"PATH": "/usr/bin:/bin", "WINEDEBUG": "-all", "WINEPREFIX": str(scratch / "wine"), "HOME": str(scratch)}
                shown = output_of(*emulator, file, "--version", env=environment)
                self.assertEqual(shown.strip(), f"{program} {VERSION}")

    def test_the_npm_package_runs(self) -> None:
        if NPM not in self.names:
            self.skipTest("there is none")
        folder = scratch / "npm"
        folder.mkdir()
        output_of("npm", "install", "--offline", "--no-audit", "--no-fund", "--prefix", folder, made / NPM)
        shown = output_of(folder / "node_modules/.bin/isolint", "--version")
        self.assertEqual(shown.strip(), f"isolint {VERSION}")
        self.assertEqual(json.loads(self.files[NPM]["package/package.json"])["version"], VERSION)


class Refusals(unittest.TestCase):
    """Of a small repository, in which nothing is built."""

    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory(prefix="isocnc-refusals-")
        self.addCleanup(holder.cleanup)
        self.clone = Path(holder.name)
        for name in ("scripts", "CMakeLists.txt", "CHANGELOG.md"):
            copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
            copy(ROOT / name, self.clone / name)
        self.git("init", "--quiet")
        self.git("add", ".")
        self.git("commit", "--quiet", "--message", "Start")

    def git(self, *arguments: str) -> None:
        identity = ["-c", "user.name=A", "-c", "user.email=a@example.org"]
        output_of("git", *identity, *arguments, cwd=self.clone)

    def refused(self, *arguments: str) -> str:
        done = subprocess.run([self.clone / "scripts/release", *arguments], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertFalse((self.clone / "dist").exists())
        return done.stderr

    def test_changes(self) -> None:
        (self.clone / "CHANGELOG.md").write_text("other")
        self.assertIn("CHANGELOG.md", self.refused())

    def test_new_files(self) -> None:
        (self.clone / "new").touch()
        self.assertIn("?? new", self.refused())

    def test_the_tag_of_another_version(self) -> None:
        self.assertIn(VERSION, self.refused("--tag", "v99.0.0"))

    def test_a_version_without_date(self) -> None:
        changelog = self.clone / "CHANGELOG.md"
        changelog.write_text(re.sub(r"^(## \[\S+\] - ).*$", r"\1unreleased", changelog.read_text(), flags=re.MULTILINE))
        self.assertIn("unreleased", self.refused("--dirty", "--tag", f"v{VERSION}"))

    def test_a_version_that_the_changelog_does_not_have(self) -> None:
        (self.clone / "CHANGELOG.md").write_text("# Changelog\n")
        self.assertIn(VERSION, self.refused("--dirty"))

    def test_a_folder_with_other_files(self) -> None:
        folder = self.clone / "programs"
        folder.mkdir()
        (folder / "part.iso").touch()
        self.assertIn("part.iso", self.refused("--dirty", "--output", str(folder)))
        self.assertTrue((folder / "part.iso").exists())


def main() -> None:
    global made, scratch
    with tempfile.TemporaryDirectory(prefix="isocnc-release-test-") as folder:
        scratch = Path(folder)
        if len(sys.argv) > 1:
            made = Path(sys.argv.pop(1)).resolve()
        else:
            made = scratch / "packed"
            done = subprocess.run(
                [ROOT / "scripts/release", "--dirty", "--as-built", "--only", "linux-x64", "--output", made],
                stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
            )  # fmt: skip
            if done.returncode == 2:
                print(f"skipped: {done.stderr.splitlines()[-1]}")
                sys.exit(77)
            if done.returncode != 0:
                sys.exit(done.stderr)
        unittest.main()


if __name__ == "__main__":
    missing = [program for program in ("git", "npm", "node", "dpkg-deb", "cpack") if not shutil.which(program)]
    if missing:
        print(f"skipped: there is no {', '.join(missing)}")
        sys.exit(77)
    main()
