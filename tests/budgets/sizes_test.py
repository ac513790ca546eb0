#!/usr/bin/env python3
"""Holds the sizes of what is handed out against the tables in docs/platforms.md.

usage: sizes_test.py BUILD_FOLDER
       sizes_test.py --modules FOLDER [--at-most]

The first holds the release build's programs, without symbols, as they are shipped; the second WebAssembly modules. Nothing may be larger than its table
allows, and the table must say its size to within 3 %; with --at-most, of a build that optimizes more than the one of the table, only the former.
"""

import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

TABLE = Path(__file__).resolve().parents[2] / "docs/platforms.md"
PROGRAMS = ["isolint", "isofmt", "isorun", "isodiff", "isols", "isodap"]
MODULES = ["isocnc.wasm", "playground.wasm"]
# | `isolint` | all tests | 6.0 MB | 6.5 MB | 3 ms |
ROW = re.compile(r"^\| `([\w.]+)` \| [^|]+ \| ([\d.]+) MB \| ([\d.]+) MB \|", re.MULTILINE)
TOLERANCE = 0.03


def stripped_size(program: Path) -> int:
    with tempfile.NamedTemporaryFile() as stripped:
        subprocess.run(["strip", "-o", stripped.name, program], check=True)
        return Path(stripped.name).stat().st_size


def size(file: Path) -> int:
    return file.stat().st_size


def hold(folder: Path, names: list[str], size_of: Callable[[Path], int], only_at_most: bool) -> bool:
    rows = {name: (float(said), float(most)) for name, said, most in ROW.findall(TABLE.read_text())}
    all_hold = True
    for name in names:
        if name not in rows:
            print(f"{TABLE}: no row for {name}")
            all_hold = False
            continue
        said, most = rows[name]
        megabytes = size_of(folder / name) / 1e6
        is_other = not only_at_most and abs(megabytes / said - 1) > TOLERANCE
        problem = "more than is allowed" if megabytes > most else "not what is said" if is_other else ""
        print(f"{name}: {megabytes:.2f} MB; said {said} MB, at most {most} MB; {problem or 'ok'}")
        all_hold &= not problem
    return all_hold


def main() -> int:
    arguments = sys.argv[1:]
    if arguments[0] == "--modules":
        holds = hold(Path(arguments[1]), MODULES, size, "--at-most" in arguments)
    else:
        holds = hold(Path(arguments[0]) / "bin", PROGRAMS, stripped_size, False)
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
