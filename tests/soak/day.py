"""What the days with both programs have in common."""

import random
from pathlib import Path

from flatness import Flatness
from shop import Shop
from world import World


class Day:
    """One program in a shop, by choices that follow from the seed and the name of what is chosen."""

    def __init__(self, program: Path, seed: int, choices: str, fault: str, folder: Path, max_threads: int):
        self.program = program
        self.seed = seed
        self.fault = fault
        self.folder = folder
        self.temporary = folder / "tmp"
        self.temporary.mkdir()
        self.world = World(folder, folder / "shop" / "network")
        self.choices = random.Random(f"{seed}/{choices}")
        self.shop = Shop(folder / "shop", self.world, self.choices)
        self.number = 0
        self.place = "start"
        self.flatness = Flatness(program.name, self.world, max_threads)
        self.counts: dict[str, int] = {}

    def chance(self, share: float) -> bool:
        return self.choices.random() < share

    def count(self, what: str) -> None:
        self.counts[what] = self.counts.get(what, 0) + 1

    def environment(self) -> dict[str, str]:
        """Of the program, with the planted mistake if there is one."""
        environment = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "TMPDIR": str(self.temporary), **self.world.environment()}
        if self.fault:
            environment["ISOCNC_SOAK_FAULT"] = self.fault
        return environment

    def next_log(self) -> Path:
        """Of a process that starts."""
        self.number += 1
        return self.folder / f"{self.program.name}-{self.number}.log"
