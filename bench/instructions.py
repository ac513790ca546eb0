"""Counts what a process executes in user space, by callgrind (Debian package valgrind)."""

import re
import subprocess

import compare


def instructions(argv: list[str]) -> int:
    """The same from run to run, whatever else the machine does."""
    counting = compare.on_one_processor(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *argv])
    done = subprocess.run(counting, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not found:
        raise compare.CannotMeasure(f"exit status {done.returncode}: {' '.join(counting)}")
    return int(found[1])
