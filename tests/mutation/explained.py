"""Mutants that no test can notice, with the reason: tests/mutation/explained.toml."""

import dataclasses
import enum
import tomllib
from pathlib import Path

FILE = Path(__file__).resolve().with_name("explained.toml")


class Effect(enum.Enum):
    """What a mutant that is explained changes."""

    NOTHING = "nothing"
    TIME = "time"  # Only the time or memory that is needed, or how far a search goes that no promise bounds.
    MEMORY_ERROR = "memory error"  # It uses what is not there, which a sanitizer notices.


@dataclasses.dataclass(frozen=True)
class Explanation:
    path: str
    place: str  # The line with the changed part between « and », each run of blanks as one.
    changed: str
    effect: Effect
    why: str


def squeezed(text):
    return " ".join(text.split())


def place_of(source, mutant):
    """The lines of a mutant with the changed part between « and »."""
    begin = source.rfind(b"\n", 0, mutant.begin) + 1
    end = source.find(b"\n", mutant.end)
    end = len(source) if end < 0 else end
    before, part, after = source[begin : mutant.begin], source[mutant.begin : mutant.end], source[mutant.end : end]
    return squeezed(f"{before.decode()}«{part.decode()}»{after.decode()}")


def load(text):
    """The explanations of a file. Raises ValueError where one is not complete."""
    found = {}
    for path, entries in tomllib.loads(text).items():
        for entry in entries:
            if set(entry) != {"place", "changed", "effect", "why"} or not entry["why"].strip():
                raise ValueError(f"{path}: {entry} needs a place, changed, effect and why")
            explanation = Explanation(path, entry["place"], entry["changed"], Effect(entry["effect"]), entry["why"])
            if found.setdefault((path, explanation.place, explanation.changed), explanation) is not explanation:
                raise ValueError(f"{path}: {explanation.place} is explained twice")
    return found


def stale(root, explanations):
    """Those whose place is no longer in its file."""
    squeezed_files = {}
    for each in explanations.values():
        if each.path not in squeezed_files:
            file = Path(root) / each.path
            squeezed_files[each.path] = squeezed(file.read_text(encoding="utf-8")) if file.is_file() else ""
        if each.place.replace("«", "").replace("»", "") not in squeezed_files[each.path]:
            yield each


def of(root, mutants, explanations):
    """For each of the mutants that is explained, its explanation."""
    sources = {path: (Path(root) / path).read_bytes() for path in {mutant.path for mutant in mutants}}
    keys = {mutant: (mutant.path, place_of(sources[mutant.path], mutant), squeezed(mutant.changed)) for mutant in mutants}
    return {mutant: explanations[key] for mutant, key in keys.items() if key in explanations}
