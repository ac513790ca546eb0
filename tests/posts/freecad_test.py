#!/usr/bin/env python3
"""Makes the jobs of tests/posts/jobs anew with FreeCAD itself, and posts them from FreeCAD's own objects.

usage: freecad_test.py FOLDER_OF_PROGRAMS [--keep]. Belongs to scripts/test --all. With --keep, what FreeCAD has computed is
written to tests/posts/jobs. Exit status 77: skipped, as there is no freecadcmd.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import freecad_post_test as tests
from freecad_post_test import HERE, JOBS, ROOT, isocnc_post

SKIPPED = 77
SAME = 1e-6  # mm and mm/s


def make_jobs(folder: Path) -> None:
    environment = os.environ | {"HOME": str(folder), "POSTS_JOBS": str(folder), "POSTS_FREECAD": str(ROOT / "posts/freecad")}
    run = subprocess.run(
        ["freecadcmd", str(HERE / "freecad_jobs.py")],
        stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600, check=False, env=environment,
    )
    if run.returncode != 0 or not (folder / "done").is_file():
        lines = [line for line in (run.stdout + run.stderr).splitlines() if line.strip() and "%)" not in line]
        sys.exit("\n".join([f"freecadcmd: exit status {run.returncode}", *lines[-30:]]))


def numbers_of(value):
    """The names of a job and its numbers, apart."""
    if isinstance(value, dict):
        value = [part for pair in sorted(value.items()) for part in pair]
    if isinstance(value, list):
        parts = [numbers_of(part) for part in value]
        return [name for names, _ in parts for name in names], [number for _, numbers in parts for number in numbers]
    return ([], [float(value)]) if isinstance(value, (int, float)) else ([value], [])


def is_kept(made: dict, kept: dict) -> bool:
    (names, numbers), (kept_names, kept_numbers) = (numbers_of(job["operations"]) for job in (made, kept))
    return names == kept_names and len(numbers) == len(kept_numbers) and all(abs(a - b) < SAME for a, b in zip(numbers, kept_numbers))


def main() -> int:
    if not shutil.which("freecadcmd"):
        print("skipped: there is no freecadcmd (Debian package freecad-python3)")
        return SKIPPED
    tests.programs = Path(sys.argv[1]).resolve()
    failures = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        make_jobs(folder)
        if "--keep" in sys.argv[2:]:
            for path in folder.glob("*.json"):
                shutil.copy(path, HERE / "jobs")
        texts = {}
        for path in JOBS:
            made, kept = (json.loads((place / path.name).read_text()) for place in (folder, path.parent))
            text = texts[path.stem] = (folder / f"{path.stem}.iso").read_text(encoding="utf-8")
            if made["made"] != kept["made"]:
                print(f"{path.stem}: made {made['made']}, kept is what was made {kept['made']}")
            elif not is_kept(made, kept):
                failures.append(f"{path.stem}: FreeCAD computes other commands than those in tests/posts/jobs; see --keep")
            options = isocnc_post.parse_options(made["arguments"])
            if text != isocnc_post.post(isocnc_post.operations_of_json(made), options):
                failures.append(f"{path.stem}: posted from FreeCAD's objects it is another program than from their commands")
            expected = tests.path_of(made)
            wrong = tests.events.difference(expected, tests.events.of_program(tests.programs / "isorun", text), 1.5e-3)
            failures += [f"{path.stem}: {wrong}"] if wrong else []
            whole = folder / f"{path.stem}.job.iso"  # From the job as an object.
            if whole.is_file() and whole.read_text(encoding="utf-8") != text:
                failures.append(f"{path.stem}: posted as a whole job it is another program")
        findings = tests.findings_of(texts)
        failures += [findings] if findings else []
    print("\n".join(failures) or f"{len(JOBS)} jobs: as kept, clean, and on FreeCAD's path")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
