"""The folders of a shop: programs, configurations, and those that change them."""

import json
import os
import random
import shutil
from pathlib import Path

from failure import require
from world import World

ROOT = Path(__file__).resolve().parents[2]

MACHINES = [
    {"machine": {"home": {"z": 400}, "axes": {"X": {"min": -50, "max": 900}, "Z": {"min": -80, "max": 450}}}},
    {"language": "it", "lint": {"ignore": ["W106"], "severity": {"W003": "error"}}, "format": {"renumber": {"start": 5, "step": 5}}},
    {
        "machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "name": "cutter 12", "length": 150, "radius": 6, "shape": "flat", "cutLength": 40}]},
        "setups": [{"paths": ["*.iso"], "stock": {"box": [[-20, -20, -20], [420, 320, 0]]}, "fixtures": [{"name": "clamp", "box": [[-40, 80, -20], [-5, 120, 30]]}]}],
    },
    {"lint": {"files": [{"paths": ["job*"], "ignore": ["W1"]}], "extensions": [".iso", ".nc"], "exclude": ["old*"]}},
]
BROKEN = [b"{", b"", b"[1, 2]", b'{"lint": {"ignore": 7}}', b'{"machine": {"axes": {"X": {"min": 5, "max": 1}}}}', b'{"nothing": 1}\xff', b"\xef\xbb\xbf{}", b'{"lint": {"ignore": ["W106"],}}']
SETUP = {"stock": {"box": [[-30, -30, -25], [430, 330, 0]]}, "fixtures": [{"name": "pin", "cylinder": {"at": [50, 50, -25], "height": 60, "diameter": 16}}], "resolution": 2}
SETUPS = [json.dumps(SETUP).encode(), json.dumps({**SETUP, "target": {"mesh": "missing.stl"}}).encode(), b'{"stock": }', json.dumps({"fixtures": []}).encode()]


def generated(choices: random.Random, blocks: int) -> str:
    """A program with pockets, arcs, increments, registers, and jumps, mostly right."""
    lines = [f"; part {choices.randrange(10000)}", "G71 G90", f"V{choices.randrange(1, 9)} = {choices.randrange(5)}"]
    number = 10
    while len(lines) < blocks:
        x, y = choices.randrange(0, 400), choices.randrange(0, 300)
        lines += [f"; pocket {number}", f"M06 T10100{choices.randrange(1, 4)}", f"S{choices.randrange(6, 24)}000 M03", f"G00 X{x} Y{y} Z50"]
        if choices.random() < 0.3:
            lines.append(f"IF VGPL = {choices.randrange(3)} GOTO N{number + 500}")
        for depth in range(choices.randrange(1, 5)):
            lines += [f"G01 Z-{depth + 1} F{choices.randrange(5, 60)}00", f"X{x + choices.randrange(1, 60)}", f"G03 X{x} Y{y + 10} R{choices.randrange(30, 90)}", f"G01 Y{y}"]
        if choices.random() < 0.3:
            lines += ["G91", *(f"G01 X{choices.uniform(-3, 3):.3f} Y{choices.uniform(-3, 3):.3f}" for _ in range(choices.randrange(1, 20))), "G90"]
        lines += ["G00 Z50", f"N{number + 500} M05"]
        number += 10
    return "\n".join([*lines, "M02", ""])


class Shop:
    """What the folders hold is known at any time, so that a change by others is noticed."""

    def __init__(self, root: Path, world: World, choices: random.Random):
        self.root = root
        self.world = world
        self.network = root / "network"
        self.files: dict[Path, bytes] = {}
        self.last_time = 0
        self.fill("doors", sorted((ROOT / "examples").glob("*.iso")))
        self.fill("broken", sorted((ROOT / "examples/broken").glob("*.iso")))
        self.fill("panels", sorted((ROOT / "examples/setups").glob("*.*")))
        self.fill("panels/broken", sorted((ROOT / "examples/setups/broken").glob("*.iso")))
        for folder in sorted((ROOT / "tests/programs").iterdir()):
            self.fill(f"golden/{folder.name}", sorted(folder.glob("*.iso")))
        for folder, blocks in (("jobs", 40), ("jobs", 200), ("jobs", 1500), ("network", 60), ("network/old", 120), ("network", 30)):
            for number in range(3):
                self.write(root / folder / f"job{blocks}-{number}.iso", generated(choices, blocks).encode())
        self.write(self.network / "isocnc.json", json.dumps(MACHINES[0]).encode())

    def fill(self, folder: str, files: list[Path]) -> None:
        for file in files:
            self.write(self.root / folder / file.name, file.read_bytes())

    def folders(self) -> list[Path]:
        return [self.root / each for each in ("doors", "broken", "panels", "golden/paths", "golden/geometry", "jobs", "network")]

    def programs(self) -> list[Path]:
        return [file for file in self.files if file.suffix == ".iso"]

    def is_on_network(self, file: Path) -> bool:
        return file.is_relative_to(self.network)

    def write(self, file: Path, text: bytes) -> None:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text)
        # By the clock of the day; two files have never the same time.
        self.last_time = max(self.last_time + 1, self.world.real_time()) if self.world.real_time() > self.last_time - 10**9 else self.world.real_time()
        os.utime(file, ns=(self.last_time, self.last_time))
        self.files[file] = text

    def remove(self, file: Path) -> None:
        file.unlink()
        del self.files[file]

    def rename(self, file: Path, name: Path) -> None:
        file.rename(name)
        self.files[name] = self.files.pop(file)

    def check(self) -> None:
        """Nobody else has changed anything."""
        found = {file for file in self.root.rglob("*") if not file.is_dir()}
        require(found == set(self.files), f"files that nobody has written, or that are gone: {sorted(map(str, found ^ set(self.files)))[:5]}")
        for file, text in self.files.items():
            require(file.read_bytes() == text, f"{file} is changed")

    def clear(self) -> None:
        shutil.rmtree(self.root)
