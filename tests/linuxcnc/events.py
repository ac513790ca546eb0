"""What a program does, read from the trace of isorun and from what LinuxCNC's rs274 prints."""

import json
import math
import re
from dataclasses import dataclass

from programs import AXES, LINEAR, MM_PER_INCH, PLANES, Frame


@dataclass(frozen=True)
class Event:
    """`values` in mm, degrees, seconds, mm/min (degrees/min where B and C alone turn), in machine coordinates."""

    line: int
    kind: str
    values: dict[str, float]

    def sort(self) -> tuple:
        return self.line, self.kind, self.values.keys()

    def __str__(self) -> str:
        return " ".join([self.kind, *(f"{name} {value:.6f}" for name, value in self.values.items())])


def named(name: str, axes: str, values: tuple) -> dict[str, float]:
    return {f"{name} {axis}": value for axis, value in zip(axes, values)}


def event_of_isorun(entry: dict) -> Event | None:
    kind = entry["kind"]
    if kind == "spindle":
        values = {name: entry[name] for name in ("speed", "number") if name in entry}
    elif kind == "dwell":
        values = {"seconds": entry["seconds"]}
    elif kind in ("rapid", "feed", "arc"):
        values = named("from", AXES, entry["from"]) | named("to", AXES, entry["to"])
        if kind == "arc":
            values |= named("center", LINEAR, entry["center"]) | named("normal", LINEAR, entry["normal"])
            values["sweep"] = entry["sweepDeg"]
        if kind != "rapid":
            values["feed"] = entry["feed"]
    elif kind == "end":
        values = {}
    else:
        return None
    return Event(entry["line"], kind, values)


def events_of_isorun(trace: str) -> list[Event]:
    """What it was writing when it crashed, if it did, is no event."""
    whole_lines = trace[: trace.rfind("\n") + 1].splitlines()
    events = (event_of_isorun(json.loads(line)) for line in whole_lines)
    return [event for event in events if event]


class CanonReader:
    """Follows the calls that rs274 prints. Their coordinates are those of the frame in force, in the units in force."""

    CALL = re.compile(r"\s*\d+ +N(\S+) +([A-Z0-9_]+)\((.*)\)$")
    ROTARY = ((4, "B"), (5, "C"))  # Their places among X Y Z A B C.
    M_CODES = {"START_SPINDLE_CLOCKWISE": 3, "START_SPINDLE_COUNTERCLOCKWISE": 4, "STOP_SPINDLE_TURNING": 5}
    PLANE_OF = {"CANON_PLANE_XY": PLANES[0], "CANON_PLANE_XZ": PLANES[1], "CANON_PLANE_YZ": PLANES[2]}

    def __init__(self):
        self.events: list[Event] = []
        self.line = 0
        self.unit = 1.0
        self.coordinate_system = (0.0,) * 3  # mm, as the next one.
        self.g92 = (0.0,) * 3
        self.angle = 0.0
        self.plane = PLANES[0]
        self.feed = 0.0
        self.tip = (0.0,) * 5

    def read(self, output: str) -> list[Event]:
        for text in output.splitlines():
            call = self.CALL.match(text)
            if call and call[1].isdigit():
                self.line = int(call[1])
                self.take(call[2], call[3].split(", "))
        return self.events

    def take(self, name: str, arguments: list[str]) -> None:
        if name == "USE_LENGTH_UNITS":
            self.unit = 1.0 if arguments[0] == "CANON_UNITS_MM" else MM_PER_INCH
        elif name == "SET_G5X_OFFSET":
            self.coordinate_system = self.lengths(arguments[1:4])
        elif name == "SET_G92_OFFSET":
            self.g92 = self.lengths(arguments[:3])
        elif name == "SET_XY_ROTATION":
            self.angle = float(arguments[0])
        elif name == "SELECT_PLANE":
            self.plane = self.PLANE_OF[arguments[0]]
        elif name == "SET_FEED_RATE":
            self.feed = float(arguments[0])
        elif name == "SET_SPINDLE_SPEED":
            self.add("spindle", {"speed": float(arguments[1])})
        elif name in self.M_CODES:
            self.add("spindle", {"number": self.M_CODES[name]})
        elif name == "DWELL":
            self.add("dwell", {"seconds": float(arguments[0])})
        elif name == "PROGRAM_END":  # M2 stops the spindle as well, M02 does not say.
            self.events = [event for event in self.events if event.line != self.line]
            self.add("end", {})
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            self.straight(name, arguments)
        elif name == "ARC_FEED":
            self.arc(arguments)

    def add(self, kind: str, values: dict[str, float]) -> None:
        self.events.append(Event(self.line, kind, values))

    def lengths(self, arguments: list[str]) -> tuple:
        return tuple(float(argument) * self.unit for argument in arguments)

    def machine(self, point: tuple) -> tuple:
        return Frame(self.coordinate_system, self.angle).to_machine(tuple(p + o for p, o in zip(point, self.g92)))

    def program(self, point: tuple) -> tuple:
        """The other way round: from machine coordinates to those of the frame in force."""
        turned = Frame(self.coordinate_system, self.angle).from_machine(point)
        return tuple(p - o for p, o in zip(turned, self.g92))

    def move_to(self, point: tuple, rotary: list[str]) -> dict[str, float]:
        start = self.tip
        self.tip = self.machine(point) + tuple(float(angle) for angle in rotary)
        return named("from", AXES, start) | named("to", AXES, self.tip)

    def straight(self, name: str, arguments: list[str]) -> None:
        before = self.tip
        ends = self.move_to(self.lengths(arguments[:3]), [arguments[place] for place, _ in self.ROTARY])
        if name == "STRAIGHT_TRAVERSE":
            self.add("rapid", ends)
            return
        moves_tip = math.dist(before[:3], self.tip[:3]) > MOVES_BY
        self.add("feed", ends | {"feed": self.feed * (self.unit if moves_tip else 1)})

    def arc(self, arguments: list[str]) -> None:
        """Arguments: end and center along the plane's first and second axis, turns, end along the normal, A B C."""
        first, second = self.plane.axes
        start = dict(zip(LINEAR, self.program(self.tip[:3])))
        end = dict(zip(first + second + self.plane.normal, self.lengths([*arguments[:2], arguments[5]])))
        center = dict(zip(first + second, self.lengths(arguments[2:4]))) | {self.plane.normal: start[self.plane.normal]}
        turns = int(arguments[4])
        values = self.move_to(tuple(end[axis] for axis in LINEAR), arguments[7:9])
        values |= named("center", LINEAR, self.machine(tuple(center[axis] for axis in LINEAR)))
        normal = tuple(float(axis == self.plane.normal) for axis in LINEAR)
        values |= named("normal", LINEAR, Frame(angle=self.angle).turned(normal, 1))

        def from_center(point: dict) -> complex:
            return complex(point[first] - center[first], point[second] - center[second])

        values["sweep"] = sweep(from_center(start), from_center(end), turns)
        values["feed"] = self.feed * self.unit
        self.add("arc", values)


MOVES_BY = 0.01  # mm. Less is what rs274 has rounded.
FULL_TURN_WITHIN = 0.5  # Degrees. No arc that is not full comes as near as that.


def sweep(start: complex, end: complex, turns: int) -> float:
    """Degrees from start to end, both seen from the center; as many turns, begun or full, in the sense of the sign."""
    sense = 1 if turns > 0 else -1
    turned = sense * math.degrees(math.atan2((start.conjugate() * end).imag, (start.conjugate() * end).real)) % 360
    if turned < FULL_TURN_WITHIN:
        turned += 360
    return sense * (turned + 360 * (abs(turns) - 1))


def events_of_rs274(output: str) -> list[Event]:
    return CanonReader().read(output)
