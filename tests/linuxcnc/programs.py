"""Random programs, each in two dialects: ISOCNC, and RS274/NGC as LinuxCNC reads it.

Line n of the ISOCNC program carries N<n>, and so do the lines of the other that mean the same: one instruction here may
be several there. What the dialects write differently:

    inches, millimeters       G70, G71                      G20, G21
    workpiece frame           G92 at its origin             G10 L2 at its origin, or G92 at the tip
    face frame, turned by C   G24, G28, G29                 G10 L2 with R
    centers                   absolute in G90, else from    absolute (G90.1)
                              the start; one may do
    five axes                 G49                           always

The motion G is left out now and then, on either side by itself, so that neither leans on the other's idea of what is in
force.
"""

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass

MM_PER_INCH = 25.4
LINEAR = "XYZ"
AXES = "XYZBC"


@dataclass(frozen=True)
class Plane:
    g: int
    axes: str  # First and second axis, as in i x j, k x i, j x k (D40).
    centers: str
    normal: str


PLANES = [Plane(17, "XY", "IJ", "Z"), Plane(18, "ZX", "KI", "Y"), Plane(19, "YZ", "JK", "X")]


@dataclass(frozen=True)
class Frame:
    """Machine coordinates of the origin, in mm, and the angle about Z by which the axes are turned, in degrees."""

    origin: tuple = (0.0, 0.0, 0.0)
    angle: float = 0.0

    def turned(self, point: tuple, sense: int) -> tuple:
        cos, sin = math.cos(math.radians(self.angle)), sense * math.sin(math.radians(self.angle))
        return (cos * point[0] - sin * point[1], sin * point[0] + cos * point[1], point[2])

    def to_machine(self, point: tuple) -> tuple:
        return tuple(o + p for o, p in zip(self.origin, self.turned(point, 1)))

    def from_machine(self, point: tuple) -> tuple:
        return self.turned(tuple(p - o for o, p in zip(self.origin, point)), -1)


def number(value: float, decimals: int = 6) -> str:
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class Writer:
    """Writes one program line by line, and knows where the tip is and what is in force."""

    def __init__(self, seed: int, steps: int):
        self.random = random.Random(seed)
        self.iso: list[str] = []
        self.ngc: list[str] = []
        self.tip = dict.fromkeys(AXES, 0.0)  # Machine coordinates; mm, degrees.
        self.workpiece = Frame()
        self.face: Frame | None = None
        self.coordinate_system = 1  # Of LinuxCNC: G54 is 1.
        self.unit = 1.0  # mm
        self.plane = PLANES[0]
        self.absolute = True
        self.five_axes = False
        self.inverse_time = False
        self.feed_is_known = False
        self.motion_in_iso = self.motion_in_ngc = -1
        self.settings: list[str] = []  # Written alike in both; they open the next motion's line.

        self.write("G17 G71 G90 G94", "G17 G21 G90 G94 G40 G49 G64 G54 G90.1")
        self.write("M06 T101001", "(TOOL)")
        for _ in range(steps):
            self.step()
        self.write("M02", "M2")

    def write(self, iso: str, *ngc: str) -> None:
        line = len(self.iso) + 1
        self.iso.append(f"N{line} {iso}")
        self.ngc.extend(f"N{line} {text}" for text in ngc)

    def often(self, share: float) -> bool:
        return self.random.random() < share

    def step(self) -> None:
        steps = {
            self.rapid: 3,
            self.line: 5,
            self.arc: 12,
            self.change_plane: 3,
            self.change_distance: 2,
            self.change_units: 1,
            self.change_workpiece: 1,
            self.change_face: 1,
            self.change_axes: 1,
            self.change_feed_mode: 1,
            self.dwell: 1,
            self.spindle: 1,
        }
        self.random.choices(list(steps), list(steps.values()))[0]()

    # Where the tip is, in the coordinates of the program.

    def frame(self) -> Frame:
        return self.face or self.workpiece

    def programmed(self) -> dict[str, float]:
        linear = self.frame().from_machine(tuple(self.tip[axis] for axis in LINEAR))
        return {**{a: p / self.unit for a, p in zip(LINEAR, linear)}, "B": self.tip["B"], "C": self.tip["C"]}

    def go(self, reached: dict[str, float]) -> None:
        linear = self.frame().to_machine(tuple(reached[axis] * self.unit for axis in LINEAR))
        self.tip = {**dict(zip(LINEAR, linear)), "B": reached["B"], "C": reached["C"]}

    def length(self, maximum: float) -> float:
        """At random, in the units in force; `maximum` in mm."""
        return round(self.random.uniform(-maximum, maximum) / self.unit, 4)

    # Motions.

    def move(
        self, g: int, targets: dict[str, float], iso_center: Sequence[str] = (), ngc_center: Sequence[str] = ()
    ) -> None:
        start = self.programmed()
        reached, words = dict(start), []
        for axis, target in targets.items():
            value = number(target if self.absolute else target - start[axis])
            reached[axis] = float(value) if self.absolute else start[axis] + float(value)
            words.append(axis + value)
        feed = [] if g == 0 else self.feed_word()
        speed = [f"S{self.random.randint(1000, 20000)}"] if self.often(0.05) else []

        arguments = [*words, *iso_center, *feed]
        self.random.shuffle(arguments)
        g_of_iso = [] if self.motion_in_iso == g and self.often(0.5) else [f"G{g:02}"]
        iso = [*self.settings, *g_of_iso, *arguments]
        iso = speed + iso if self.often(0.5) else iso + speed

        g_of_ngc = [] if self.motion_in_ngc == g and self.often(0.5) else [f"G{g}"]
        ngc = [*speed, *self.settings, *g_of_ngc, *words, *ngc_center, *feed]
        self.random.shuffle(ngc)

        self.write(" ".join(iso), " ".join(ngc))
        self.settings = []
        self.motion_in_iso = self.motion_in_ngc = g
        self.go(reached)

    def feed_word(self) -> list[str]:
        if self.inverse_time:
            return [f"F{number(self.random.uniform(60, 500), 2)}"]  # rs274 goes no slower than 0.1 inch/min.
        if self.feed_is_known and self.often(0.7):
            return []
        self.feed_is_known = True
        return [f"F{number(self.random.uniform(100, 8000) / self.unit, 1)}"]

    def some(self, axes: str) -> str:
        return "".join(self.random.sample(axes, self.random.randint(1, len(axes))))

    def targets(self, axes: str) -> dict[str, float]:
        maximum = {"B": 60, "C": 170}
        return {a: round(self.random.uniform(-maximum[a], maximum[a]), 3) if a in maximum else self.length(300) for a in axes}

    def rapid(self) -> None:
        self.move(0, self.targets(self.some(AXES)))

    def line(self) -> None:
        self.move(1, self.targets(self.some(AXES if self.five_axes else LINEAR)))

    def arc(self) -> None:
        start = self.programmed()
        first, second = self.plane.axes
        at = complex(start[first], start[second])
        forms = [self.by_center, self.by_center, self.by_radius, self.half_turn]
        if not self.inverse_time:  # There rs274 takes a full turn for none, by a rounding, and gives it the minimum feed.
            forms.append(self.full_turn)
        form = self.random.choice(forms)
        g, end, iso_center, ngc_center = form(at, self.random.choice([2, 3]))
        targets = {first: end.real, second: end.imag}
        restated = [axis for axis in targets if abs(targets[axis] - start[axis]) < 1e-12]
        if restated and self.often(0.5):
            del targets[restated[0]]
        if self.often(0.4):
            targets[self.plane.normal] = start[self.plane.normal] + self.length(10)
        if self.five_axes and self.often(0.3):
            targets |= self.targets(self.some("BC"))
        targets = dict(self.random.sample(list(targets.items()), len(targets)))
        self.move(g, targets, iso_center, ngc_center)

    def center_near(self, at: complex) -> complex:
        """5 to 80 mm away, and so that its word says it exactly."""
        away = self.random.uniform(5, 80) / self.unit
        turn = self.random.uniform(0, 2 * math.pi)
        away = complex(away * math.cos(turn), away * math.sin(turn))
        center = at + away if self.absolute else away
        exact = complex(float(number(center.real)), float(number(center.imag)))
        return exact if self.absolute else at + exact

    def center_words(self, at: complex, center: complex) -> tuple[list[str], list[str]]:
        first, second = self.plane.centers
        written = center if self.absolute else center - at
        return (
            [first + number(written.real), second + number(written.imag)],
            [first + number(center.real, 9), second + number(center.imag, 9)],
        )

    def end_of(self, g: int, at: complex, center: complex, degrees: float) -> complex:
        sweep = math.radians(degrees if g == 3 else -degrees)
        return center + (at - center) * complex(math.cos(sweep), math.sin(sweep))

    def can_restate(self, at: complex) -> bool:
        """Whether words can say exactly where the tip is, as they mostly cannot after a change of units."""
        return not self.absolute or abs(at - complex(float(number(at.real)), float(number(at.imag)))) < 1e-12

    # The forms of an arc. Each gives the G, the end, and the words of the center in both dialects.

    def by_center(self, at: complex, g: int) -> tuple:
        center = self.center_near(at)
        end = self.end_of(g, at, center, self.random.uniform(3, 357))
        iso, ngc = self.center_words(at, center)
        chord, radius = end - at, abs(at - center)
        shortened = self.random.choice(["none", "first", "second", "radius"])
        if shortened == "first" and abs(chord.imag) > radius / 4:
            iso = iso[:1]
        elif shortened == "second" and abs(chord.real) > radius / 4:
            iso = iso[1:]
        elif shortened == "radius":
            iso = [*iso, f"R{number(radius)}"]
        return g, end, iso, ngc

    def by_radius(self, at: complex, g: int) -> tuple:
        center = self.center_near(at)
        words = [f"R{number(abs(at - center))}"]
        return g, self.end_of(g, at, center, self.random.uniform(3, 175)), words, words

    def half_turn(self, at: complex, g: int) -> tuple:
        """By radius, along an axis: the chord is 2 R to the last digit. A little less, and the center is far off."""
        if not self.can_restate(at):
            return self.by_radius(at, g)
        radius = round(self.random.uniform(5, 80) / self.unit, 3)
        words = [f"R{number(radius)}"]
        return g, at + 2 * radius * self.random.choice([1, -1, 1j, -1j]), words, words

    def full_turn(self, at: complex, g: int) -> tuple:
        if not self.can_restate(at):
            return self.by_center(at, g)
        return g, at, *self.center_words(at, self.center_near(at))

    # All the rest.

    def change_plane(self) -> None:
        self.plane = self.random.choice(PLANES)
        self.set(f"G{self.plane.g}")

    def change_distance(self) -> None:
        self.absolute = not self.absolute
        self.set("G90" if self.absolute else "G91")

    def set(self, g: str) -> None:
        """On a line of its own, or at the beginning of the next motion's."""
        if self.often(0.5) or self.settings:
            self.write(" ".join([*self.settings, g]), *self.settings, g)
            self.settings = []
        else:
            self.settings = [g]

    def change_units(self) -> None:
        inches = self.unit == 1
        self.unit = MM_PER_INCH if inches else 1.0
        self.feed_is_known = False
        self.write("G70" if inches else "G71", "G20" if inches else "G21")

    def change_feed_mode(self) -> None:
        self.inverse_time = not self.inverse_time
        self.feed_is_known = False
        self.write(*["G93" if self.inverse_time else "G94"] * 2)

    def change_axes(self) -> None:
        self.five_axes = not self.five_axes
        self.write("G49" if self.five_axes else "G48", "(AXES)")

    def dwell(self) -> None:
        self.write(*[f"G04 P{number(self.random.uniform(0, 3), 3)}"] * 2)

    def spindle(self) -> None:
        self.write(*[self.random.choice([f"S{self.random.randint(1000, 20000)} M03", "M04", "M05"])] * 2)

    def change_workpiece(self) -> None:
        if self.face:
            self.dismount()
        values = {axis: self.length(200) for axis in self.some(LINEAR)}
        origin = tuple(values.get(axis, 0) * self.unit for axis in LINEAR)
        self.workpiece = Frame(origin)
        iso = " ".join(["G92", *(axis + number(value) for axis, value in values.items())])
        if self.often(0.5):
            self.write(iso, *self.coordinate_system_at(self.workpiece))
        else:
            here = " ".join(axis + number(value, 9) for axis, value in self.programmed().items() if axis in LINEAR)
            self.write(iso, *self.coordinate_system_at(Frame()), f"G92 {here}")

    def change_face(self) -> None:
        if self.face:
            self.dismount()
            return
        values = [self.length(200) for _ in LINEAR]
        angle = round(self.random.uniform(-180, 180), 4)
        at = Frame(self.workpiece.to_machine(tuple(value * self.unit for value in values)), angle)
        origin = " ".join(axis + number(value) for axis, value in zip(LINEAR, values))
        cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        second_and_third = f"I{number(-2 * sin, 9)} J{number(2 * cos, 9)} R5"
        form = self.random.choice(["angles", "vectors", "vectors here"])
        if form == "angles":
            iso = f"G29 {origin} C{number(angle)}"
        elif form == "vectors":
            iso = f"G24 {origin} A{number(cos, 9)} B{number(sin, 9)} {second_and_third}"
        else:
            iso = f"G28 X{number(cos, 9)} Y{number(sin, 9)} {second_and_third}"
            at = Frame(tuple(self.tip[axis] for axis in LINEAR), angle)
        self.face = at
        self.write(iso, *self.coordinate_system_at(at))

    def dismount(self) -> None:
        self.face = None
        self.write("G27", *self.coordinate_system_at(self.workpiece))

    def coordinate_system_at(self, frame: Frame) -> list[str]:
        """LinuxCNC's way to a frame: no G92, and one of G54 to G59 there."""
        self.coordinate_system = self.random.randint(1, 6)
        origin = " ".join(axis + number(value / self.unit, 9) for axis, value in zip(LINEAR, frame.origin))
        system = self.coordinate_system
        return ["G92.1", f"G10 L2 P{system} {origin} R{number(frame.angle)}", f"G{53 + system}"]
