"""What a machine does, as a list that can be compared: from a trace of isorun, and from our own evaluations.

A motion has five points of its path in machine coordinates, from its start to its end, so that lines and arcs compare alike.
"""

import json
import math
import subprocess
from dataclasses import dataclass

FRACTIONS = (0.0, 0.25, 0.5, 0.75, 1.0)


@dataclass
class Motion:
    kind: str  # "rapid", "feed", "arc"
    points: list  # (x, y, z), mm
    turns: tuple  # ((b, c) at the start, (b, c) at the end), degrees
    feed: float = 0.0  # mm/min
    arc: tuple = ()  # Of an arc: its center, the unit vector of its normal, its sweep in radians.

    def extent(self):
        return max(math.dist(a, b) for a in self.points for b in self.points)

    def turned(self):
        return math.dist(*self.turns)


@dataclass
class Other:
    """A tool change, the spindle, a dwell or an M function of the shop."""

    what: tuple


def arc_motion(start, end, center, normal, sweep, turns, feed):
    return Motion("arc", along_arc(start, end, center, normal, sweep), turns, feed, (center, normal, sweep))


def along_line(start, end):
    return [tuple(a + t * (b - a) for a, b in zip(start, end)) for t in FRACTIONS]


def along_arc(start, end, center, normal, sweep):
    """Points of a helix about the normal, a unit vector; sweep in radians, positive counterclockwise. Any orientation."""
    rise = sum((b - a) * n for a, b, n in zip(start, end, normal))
    arm = [a - c for a, c in zip(start, center)]
    height = sum(r * n for r, n in zip(arm, normal))
    arm = [r - height * n for r, n in zip(arm, normal)]
    side = [
        normal[1] * arm[2] - normal[2] * arm[1],
        normal[2] * arm[0] - normal[0] * arm[2],
        normal[0] * arm[1] - normal[1] * arm[0],
    ]
    points = []
    for t in FRACTIONS[:-1]:
        cosine, sine = math.cos(sweep * t), math.sin(sweep * t)
        points.append(
            tuple(
                c + cosine * r + sine * s + (height + t * rise) * n for c, r, s, n in zip(center, arm, side, normal)
            )
        )
    return [*points, tuple(end)]


def motion_of(event):
    start, end = event["from"], event["to"]
    turns = (tuple(start[3:]), tuple(end[3:]))
    if event["kind"] == "arc":
        arc = (event["center"], event["normal"], math.radians(event["sweepDeg"]))
        return arc_motion(start[:3], end[:3], *arc, turns, event.get("feed", 0.0))
    return Motion(event["kind"], along_line(start[:3], end[:3]), turns, event.get("feed", 0.0))


def of_trace(text):
    events = []
    for line in text.splitlines():
        event = json.loads(line)
        kind = event["kind"]
        if kind in ("rapid", "feed", "arc"):
            events.append(motion_of(event))
        elif kind == "tool":
            events.append(Other(("tool", f"{event['head']}{event['holder']:02}{event['tool']:03}")))
        elif kind == "spindle":
            events.append(Other(("spindle", event.get("number", event.get("speed")))))
        elif kind == "dwell":
            events.append(Other(("dwell", event["seconds"])))
        elif kind == "m":
            events.append(Other(("m", event["number"])))
    return events


def of_program(isorun, program):
    """Runs a program, a text, and fails with what isorun reports."""
    run = subprocess.run(
        [isorun, "--no-config", "--trace", "-", "-"], input=program, capture_output=True, text=True, timeout=60, check=False
    )
    if run.returncode != 0:
        raise AssertionError(f"isorun: {run.stderr}\n{program}")
    return of_trace(run.stdout)


def joined(events, tolerance):
    """With arcs that continue one another about one center as one: almost a full turn is posted as two halves."""
    result = []
    for event in events:
        last = result[-1] if result else None
        if getattr(event, "arc", ()) and getattr(last, "arc", ()):
            (center, normal, sweep), (before, _, sweep_before) = event.arc, last.arc
            aside = [a - b for a, b in zip(center, before)]
            rise = sum(a * n for a, n in zip(aside, normal))
            if (
                math.hypot(*(a - rise * n for a, n in zip(aside, normal))) < tolerance
                and sweep * sweep_before > 0
                and abs(abs(sweep) - abs(sweep_before)) < 1e-2 + tolerance / last.extent()
                and 5 < abs(sweep + sweep_before) < math.tau + 0.01
            ):
                turns = (last.turns[0], event.turns[1])
                result[-1] = arc_motion(
                    last.points[0], event.points[-1], before, normal, sweep + sweep_before, turns, event.feed
                )
                continue
        result.append(event)
    return result


def same(left, right, tolerance, feeds):
    if isinstance(left, Other) or isinstance(right, Other):
        return left == right
    return (
        (left.kind == "rapid") == (right.kind == "rapid")
        and max(math.dist(a, b) for a, b in zip(left.points, right.points)) <= tolerance
        and max(math.dist(a, b) for a, b in zip(left.turns, right.turns)) <= 2e-3
        and (left.kind == "rapid" or abs(left.feed - right.feed) <= feeds * right.feed)
    )


def is_nothing(event, tolerance):
    """A motion that rounding may have removed."""
    return isinstance(event, Motion) and event.extent() <= 3 * tolerance and event.turned() <= 2e-3


def difference(expected, found, tolerance, feeds=1e-3):
    """Where two lists differ first, in words; empty where nowhere. An arc may be a line if that is within the tolerance."""
    left, right = list(expected), list(found)
    while left and right:
        if same(left[0], right[0], tolerance, feeds):
            left.pop(0), right.pop(0)
        elif is_nothing(left[0], tolerance):
            left.pop(0)
        elif is_nothing(right[0], tolerance):
            right.pop(0)
        else:
            return f"expected {left[0]}, found {right[0]}"
    rest = [event for event in left + right if not is_nothing(event, tolerance)]
    return f"{'missing' if left else 'one too many'}: {rest[0]}" if rest else ""
