#!/usr/bin/env python3
"""Makes a release twice, in two folders with names of two lengths and in two environments: the files must have the same bytes. Takes up to two hours on two cores.

usage: reproducible_test.py [OPTION OF scripts/release...]
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ENVIRONMENTS = [("a", 0o022, {"TZ": "UTC", "LC_ALL": "C"}), ("another-place", 0o077, {"TZ": "Asia/Tokyo", "LC_ALL": "it_IT.UTF-8", "USER": "other"})]


def different(one: Path, other: Path) -> list[str]:
    names = sorted({path.name for folder in (one, other) for path in folder.iterdir()})
    return [
        name
        for name in names
        if not (one / name).is_file() or not (other / name).is_file() or (one / name).read_bytes() != (other / name).read_bytes()
    ]


def main() -> None:
    with tempfile.TemporaryDirectory(prefix="isocnc-reproducible-") as folder:
        outputs = []
        for name, mask, variables in ENVIRONMENTS:
            outputs.append(Path(folder, name, "dist"))
            subprocess.run(
                [ROOT / "scripts/release", "--dirty", "--work", Path(folder, name), "--output", outputs[-1], *sys.argv[1:]],
                env=os.environ | variables, umask=mask, stdin=subprocess.DEVNULL, check=True,
            )  # fmt: skip
        found = different(*outputs)
        for name in found:
            print(f"other bytes: {name}")
        files = len(list(outputs[0].iterdir()))
        print(f"{files - len(found)} of {files} files have the same bytes")
        if found:
            sys.exit(1)
        subprocess.run([ROOT / "tests/packages/release_test.py", outputs[0]], check=True)


if __name__ == "__main__":
    main()
