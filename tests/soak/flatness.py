"""Whether a process keeps what it takes."""

import statistics
import time
from pathlib import Path

from failure import require
from world import World

# What a process may have more at the end of its life than early in it.
SHARE = 0.10
ALLOWANCE = 2 << 20
# What it may have free in its heap, between what is in use.
MAX_FREE = 256 << 20
# Seconds after which a file that is open is not just being read.
MAX_READING = 10
MIN_SERIES = 8


class Flatness:
    """Measurements of one process, each after the same work."""

    def __init__(self, name: str, world: World, max_threads: int):
        self.name = name
        self.world = world
        self.max_threads = max_threads
        self.memory: list[int] = []
        self.untrimmed = 0
        self.descriptors: int | None = None
        self.report: list[str] = []

    def measure(self, client) -> None:
        process = Path(f"/proc/{client.process.pid}")
        descriptors = self.open_files(process)
        threads = len(list((process / "task").iterdir()))
        untrimmed = client.anonymous_bytes()
        self.world.trim()
        self.memory.append(client.anonymous_bytes())
        self.untrimmed = max(self.untrimmed, untrimmed)
        require(untrimmed - self.memory[-1] <= MAX_FREE, f"{(untrimmed - self.memory[-1]) >> 20} MiB are free in the heap")
        require(threads <= self.max_threads, f"{threads} threads")
        require(descriptors <= self.descriptors, f"{descriptors} open files, {self.descriptors} before")
        self.descriptors = descriptors

    def open_files(self, process: Path) -> int:
        """Their number, once no file more is open than before: one may just be read."""
        end = time.monotonic() + MAX_READING
        while True:
            count = len(list((process / "fd").iterdir()))
            self.descriptors = self.descriptors or count
            if count <= self.descriptors or time.monotonic() > end:
                return count
            time.sleep(0.02)

    def judge(self) -> None:
        """At the end of the process."""
        series, self.memory, self.descriptors = self.memory, [], None
        kibibytes = [each >> 10 for each in series]
        if series:
            self.report.append(f"{self.name}: {len(series)} measurements of memory, first {kibibytes[0]} KiB, middle {kibibytes[len(series) // 2]} KiB, last {kibibytes[-1]} KiB, most {max(kibibytes)} KiB, with what is free in the heap {self.untrimmed >> 10} KiB")
        if len(series) < MIN_SERIES:
            return
        quarter = len(series) // 4
        early, late = statistics.median(series[quarter : 2 * quarter]), statistics.median(series[-quarter:])
        require(late <= early * (1 + SHARE) + ALLOWANCE, f"memory grows: {early / 1024:.0f} KiB in the second quarter, {late / 1024:.0f} KiB in the last, of {kibibytes}")
