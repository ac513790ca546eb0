#!/usr/bin/env python3
"""Runs what docs/isodiff.md says of git, and the pipelines of examples/ci that comment a merge request, with the real git.

usage: recipes_test.py FOLDER_OF_PROGRAMS. Exit status: 77 where there is no module for YAML.
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
programs = Path()

# Keeps its arguments, one on a line, and answers as GitLab does after an upload.
CURL = r"""#!/bin/bash
printf '%s\n' "$@" >>"$CURL_LOG"
for argument; do
  case $argument in
    file=@*) file=${argument#file=@}; [ -s "$file" ] && printf '{"id":1,"markdown":"![%s](/uploads/1/%s)"}' "${file##*/}" "${file##*/}" ;;
    body@*) [ -s "${argument#body@}" ] && cat "${argument#body@}" >"$CURL_LOG.body" ;;
  esac
done
"""


def program(x: int) -> str:
    return f"M06 T101001\nS12000 M03\nG00 X10 Y20 Z40\nG01 Z-5 F2000\nX{x}\nG00 Z40\nM02\n"


class Repository(unittest.TestCase):
    def setUp(self) -> None:
        scratch = tempfile.TemporaryDirectory(prefix="isocnc-recipes-")
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)
        self.folder = self.scratch / "repository"
        self.folder.mkdir()
        curl = self.scratch / "bin" / "curl"
        curl.parent.mkdir()
        curl.write_text(CURL)
        curl.chmod(0o755)
        (self.scratch / "bin" / "compare-in-pipeline").symlink_to(ROOT / "scripts/compare-in-pipeline")
        self.environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith("GIT_")},
            "PATH": f"{self.scratch / 'bin'}:{programs}:{os.environ['PATH']}",
            "HOME": str(self.scratch),
            "LC_ALL": "C.UTF-8",
            "GIT_CONFIG_NOSYSTEM": "1",
            "GIT_PAGER": "cat",
            "CURL_LOG": str(self.scratch / "curl"),
        }
        self.run_command("git init -q -b main; git config user.name Test; git config user.email test@localhost")

    def run_command(self, command: str, **environment: str) -> str:
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", command],
            cwd=self.folder,
            env={**self.environment, **environment},
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def write(self, name: str, text: str) -> None:
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text)

    def commit(self) -> str:
        return self.run_command("git add -A . && git commit -q -m Programs && git rev-parse HEAD").strip()


class Pages(Repository):
    def test_git_shows_what_the_pages_show(self) -> None:
        for page, english in (("docs/isodiff.md", True), ("docs/it/isodiff.md", False)):
            with self.subTest(page=page):
                text = (ROOT / page).read_text()
                files = dict(re.findall(r"^\$ cat (\w+\.iso)\n((?:[^$].*\n)+)", text, re.MULTILINE))
                self.write("part.iso", files["old.iso"])
                self.write(".gitattributes", f"# {page}\n")
                self.commit()
                self.write("part.iso", files["new.iso"])
                section = text[text.index("\n## In git\n") :]
                section = section[: section.index("\n## ", 1)]
                run = 0
                for block in re.findall(r"^```\n(.*?)^```", section, re.MULTILINE | re.DOTALL):
                    for command, answer in re.findall(r"^\$ (.*)\n((?:[^$`].*\n)*)", block, re.MULTILINE):
                        if command.startswith(("GIT_EXTERNAL_DIFF", "git difftool")):
                            # Where attributes name a driver, git asks no other.
                            self.run_command("git config --unset diff.isodiff.command || true")
                        output = self.run_command(command)
                        run += 1
                        shown, _, _ = answer.partition("...\n")
                        self.assertIn(shown, output, command)
                self.assertGreaterEqual(run, 6)
                self.run_command(re.findall(r"git config diff.isodiff.command .*", section)[0])
                self.assertIn("Y1", self.run_command("git diff"))
                self.assertIn("moved" if english else "spostato", self.run_command("git diff"))
                self.assertIn("+N10 M06", self.run_command("git diff --no-ext-diff"))


class Pipelines(Repository):
    def setUp(self) -> None:
        super().setUp()
        for name, x in (("parts/a b.iso", 100), ("old.iso", 200), ("same.iso", 60)):
            self.write(name, program(x))
        # By these git sees that it is no other one with another name.
        remarks = "".join(f"( remark {i * i} )\n" for i in range(40))
        self.write("gone.nc", program(50) + remarks)
        self.write("notes.txt", "old\n")
        self.write(".gitattributes", "*.iso diff=isodiff\n")
        self.base = self.commit()
        self.run_command("git checkout -q -b change")
        self.write("parts/a b.iso", program(101))
        (self.folder / "old.iso").rename(self.folder / "größer.iso")
        self.write("größer.iso", program(202))
        (self.folder / "gone.nc").unlink()
        self.write("NEW.NC", program(300) + remarks.replace("remark", "another"))
        self.write("notes.txt", "new\n")
        self.commit()
        # What others have done since is no part of the merge request.
        self.run_command("git checkout -q main")
        self.write("same.iso", program(66))
        self.commit()
        self.run_command("git checkout -q change")

    def comment(self) -> str:
        return (self.folder / "changes/comment.md").read_text()

    def check_comment(self, text: str) -> None:
        for part in ("### `NEW.NC (new)`\n", "### `gone.nc (deleted)`\n", "### `old.iso -> größer.iso`\n", "### `parts/a b.iso`\n",
                     "moved by X1\n", "moved by X2\n"):  # fmt: skip
            self.assertIn(part, text)
        self.assertNotIn("same.iso", text)
        self.assertNotIn("notes.txt", text)

    def pictures(self) -> list[str]:
        return sorted(path.name for path in (self.folder / "changes").glob("*.svg"))

    def test_github(self) -> None:
        text = (ROOT / "examples/ci/github-isodiff.yml").read_text()
        steps = yaml.safe_load(text)["jobs"]["isodiff"]["steps"]
        (compare,) = [step for step in steps if "run" in step]
        self.assertEqual(list(compare["env"]), ["BASE"])
        summary = self.scratch / "summary"
        self.run_command(
            compare["run"], BASE="main", GITHUB_WORKSPACE=str(self.folder), GITHUB_STEP_SUMMARY=str(summary)
        )
        self.check_comment(summary.read_text())
        self.assertEqual(self.pictures(), ["1-NEW.svg", "2-größer.svg", "3-a b.svg"])
        self.assertIn("changes", [step["with"]["path"] for step in steps if "upload-artifact" in step.get("uses", "")])

    def test_gitlab(self) -> None:
        job = yaml.safe_load((ROOT / "examples/ci/gitlab-isodiff.yml").read_text())["isodiff"]
        self.run_command(
            "\n".join(job["script"]),
            CI_MERGE_REQUEST_DIFF_BASE_SHA=self.base,
            CI_API_V4_URL="https://gitlab.example.org/api/v4",
            CI_PROJECT_ID="7",
            CI_MERGE_REQUEST_IID="12",
            ISOCNC_TOKEN="secret",
        )
        log = (self.scratch / "curl").read_text()
        self.assertEqual(log.count("\nhttps://gitlab.example.org/api/v4/projects/7/uploads\n"), 3)
        self.assertIn("\nhttps://gitlab.example.org/api/v4/projects/7/merge_requests/12/notes\n", log)
        self.assertEqual(log.count("PRIVATE-TOKEN: secret\n"), 4)
        body = (self.scratch / "curl.body").read_text()
        self.check_comment(body)
        self.assertIn("\n\n![2-größer.svg](/uploads/1/2-größer.svg)\n", body)
        self.assertEqual(job["artifacts"]["paths"], ["changes"])

    def test_without_changes_there_is_a_comment(self) -> None:
        self.run_command("git reset -q --hard main && compare-in-pipeline main changes")
        self.assertEqual(self.comment(), "No program differs.\n")
        self.assertEqual(self.pictures(), [])

    def test_a_comment_is_not_too_long(self) -> None:
        rows = "".join(f"G01 X{i % 50} Y{i} F{1000 + i}\n" for i in range(3000))
        start = "M06 T101001\nS12000 M03\nG00 X0 Y0 Z40\n"
        self.write("long.iso", start + rows + "M02\n")
        base = self.commit()
        self.write("long.iso", start + re.sub(r"F(\d)", r"F2\1", rows) + "M02\n")
        self.write("zz.iso", program(1))
        self.commit()
        self.run_command(f"compare-in-pipeline {base} changes")
        comment = self.comment()
        self.assertLess(len(comment.encode()), 64001)
        self.assertTrue("### `long.iso`\n\nThis is long: see all.md.\n\n### `zz.iso (new)`\n" in comment)
        self.assertGreater((self.folder / "changes/all.md").stat().st_size, 60000)

    def test_only_what_is_asked_for(self) -> None:
        self.run_command("compare-in-pipeline main ../elsewhere parts")
        comment = (self.scratch / "elsewhere/comment.md").read_text()
        self.assertTrue(comment.startswith("### `parts/a b.iso`\n"))
        self.assertNotIn("NEW", comment)


if __name__ == "__main__":
    programs = Path(sys.argv.pop(1)).resolve()
    unittest.main()
