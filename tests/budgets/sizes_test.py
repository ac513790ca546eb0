#!/usr/bin/env python3
"""Holds the sizes of the release build's programs against the table in docs/platforms.md.

usage: sizes_test.py BUILD_FOLDER

Without symbols, as they are shipped. A program must not be larger than the table allows, and the table must say its size to within 3 %.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

TABLE = Path(__file__).resolve().parents[2] / "docs/platforms.md"
PROGRAMS = ["isolint", "isofmt", "isorun", "isodiff", "isols", "isodap"]
# | `isolint` | all tests | 6.0 MB | 6.5 MB | 3 ms |
ROW = re.compile(r"^\| `(\w+)` \| [^|]+ \| ([\d.]+) MB \| ([\d.]+) MB \|", re.MULTILINE)


def size(program: Path) -> float:
    """MB, without symbols."""
    with tempfile.NamedTemporaryFile() as stripped:
        subprocess.run(["strip", "-o", stripped.name, program], check=True)
        return Path(stripped.name).stat().st_size / 1e6


def main() -> int:
    folder = Path(sys.argv[1]) / "bin"
    rows = {name: (float(said), float(most)) for name, said, most in ROW.findall(TABLE.read_text())}
    is_wrong = sorted(rows) != sorted(PROGRAMS)
    if is_wrong:
        print(f"{TABLE}: rows for {sorted(rows)} instead of {sorted(PROGRAMS)}")
    for name, (said, most) in rows.items():
        megabytes = size(folder / name)
        problem = "more than is allowed" if megabytes > most else "not what is said" if abs(megabytes / said - 1) > 0.03 else ""
        print(f"{name}: {megabytes:.2f} MB; said {said} MB, at most {most} MB; {problem or 'ok'}")
        is_wrong |= bool(problem)
    return 1 if is_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
