"""The clocks and the disk of a program under test, which world.c shifts and suspends."""

import mmap
import os
import struct
import subprocess
import time
from pathlib import Path

AWAKE, ASLEEP, BROKEN = range(3)
SECOND = 1_000_000_000

# The layout of `struct world` in world.c.
OFFSETS = {"real": 0, "monotonic": 8}
DISK, WAITING, CLOCK_READS, DISK_CALLS, TRIMS, FOLDER = 16, 20, 24, 32, 40, 48
SIZE = FOLDER + 4096


def built(folder: Path) -> Path:
    """The library to be preloaded, compiled."""
    library = folder / "world.so"
    source = Path(__file__).with_name("world.c")
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-O2", "-o", library, source, "-ldl"], check=True)
    return library


class World:
    """Starts awake, with the system's clocks."""

    def __init__(self, folder: Path, network: Path):
        """`network` is the folder of the disk that can be suspended."""
        self.library = built(folder)
        self.file = folder / "world"
        self.file.write_bytes(bytes(SIZE))
        with open(self.file, "r+b") as file:
            self.shared = mmap.mmap(file.fileno(), SIZE)
        name = os.fsencode(network)
        self.shared[FOLDER : FOLDER + len(name)] = name

    def environment(self) -> dict[str, str]:
        return {"LD_PRELOAD": str(self.library), "ISOCNC_SOAK_WORLD": str(self.file)}

    def get(self, form: str, at: int) -> int:
        return struct.unpack_from(form, self.shared, at)[0]

    # --- Clocks

    def pass_time(self, seconds: float) -> None:
        """Both clocks go on."""
        self.jump("real", seconds)
        self.jump("monotonic", seconds)

    def jump(self, clock: str, seconds: float) -> None:
        """Also backward. A suspended machine jumps the real clock alone, since the monotonic one stands still meanwhile."""
        at = OFFSETS[clock]
        struct.pack_into("q", self.shared, at, self.get("q", at) + round(seconds * SECOND))

    def real_time(self) -> int:
        """Nanoseconds since 1970."""
        return time.time_ns() + self.get("q", OFFSETS["real"])

    def trim(self) -> None:
        """The program gives back what its heap has free, which says more of the past than of what is kept."""
        struct.pack_into("i", self.shared, TRIMS, 1)
        while self.get("i", TRIMS):
            time.sleep(0.002)

    def clock_reads(self) -> int:
        return self.get("q", CLOCK_READS)

    # --- The disk

    def set_disk(self, state: int) -> None:
        struct.pack_into("i", self.shared, DISK, state)

    def waiting(self) -> int:
        """Calls of the program that wait for the disk."""
        return self.get("i", WAITING)

    def disk_calls(self) -> int:
        return self.get("q", DISK_CALLS)
