"""Post-processor of FreeCAD's Path (CAM) workbench for ISOCNC: docs/posts.md.

In FreeCAD: copy this file into the folder of macros, and choose `isocnc` as the job's post-processor.
Without FreeCAD: isocnc_post.py JOB.json [options] posts commands that were kept as JSON.

What the control cannot do, or what the job leaves open, is a PostError: then nothing is written.
Takes Python 3.8 or later, which older FreeCADs have with them.
"""

import argparse
import datetime
import json
import math
import re
import shlex
import sys
from dataclasses import dataclass, field

TOOLTIP = "ISOCNC: Italian five-axis routers. Arguments: --origin X,Y,Z --head H --holder HH and more, see below."
MACHINE_NAME = "ISOCNC"
UNITS = "G21"  # What FreeCAD takes for "metric".
CORNER_MIN = {"x": 0, "y": 0, "z": 0}
CORNER_MAX = {"x": 3000, "y": 1500, "z": 200}

LINEAR = "XYZ"
ROTARY = "BC"
AXES = LINEAR + ROTARY
NO_TOOL = "000000"
MM_PER_INCH = 25.4
ARC_TOLERANCE = 0.01  # mm: how far the control lets the ends of an arc be from its circle (ISO031).
SAME_PLACE = 1e-6  # mm
MOST_REPETITIONS = 100  # Of a hole.
MOST_PECKS = 1000  # Of a hole; a smaller Q is a slip, and would fill the disk.
LEAST_PRECISION = {"mm": 3, "in": 4}  # With fewer digits, rounding alone goes beyond ARC_TOLERANCE.
FIXTURES = ["G54", "G55", "G56", "G57", "G58", "G59"] + [f"G59.{number}" for number in range(1, 10)]
# The axes of an arc's plane in the order of its sense, the axis along its normal, and the letters of its center.
PLANES = {17: ("X", "Y", "Z", "I", "J", "K"), 18: ("Z", "X", "Y", "K", "I", "J"), 19: ("Y", "Z", "X", "J", "K", "I")}
CYCLES = {73: "XYZRQF", 81: "XYZRF", 82: "XYZRPF", 83: "XYZRQF", 85: "XYZRF", 89: "XYZRPF"}
# G codes that ask for what is in force here in any case.
SUPERFLUOUS = {21: "", 40: "", 49: "", 64: "P", 80: "", 94: "", 97: ""}
REFUSED = {
    38: "there is no probing",
    20: "FreeCAD's own lengths are mm; for a program in inches there is --inches",
    28: "G28 mounts a face here and does not return home; use --home, or give its versors",
    30: "there is no return to a reference point; use --home",
    41: "FreeCAD does not say with which radius; let the operation compensate",
    42: "FreeCAD does not say with which radius; let the operation compensate",
    43: "the control knows the lengths of its tools; leave G43 out",
    53: "a motion in machine coordinates has no counterpart",
    92: "a shift of the origin has no counterpart; use fixtures (G54 to G59) with --fixture",
    93: "feeds are in mm/min; the inverse of a time is not read",
    96: "a constant surface speed has no counterpart",
    98: "G98 stands alone",
}
REFUSED.update(dict.fromkeys((33, 74, 84), "tapping has no counterpart: the control does not couple the spindle to Z"))
REFUSED.update(dict.fromkeys((76, 86, 87, 88), "this cycle has no counterpart in motions"))
REFUSED_M = {
    2: "the program ends after its last operation",
    30: "the program ends after its last operation",
    98: "there are no subprograms",
    99: "there are no subprograms",
}


class PostError(Exception):
    """What cannot be posted, in words for the author of the job."""


@dataclass(frozen=True)
class Face:
    """A frame in the coordinates of the workpiece: origin and orthonormal, right-handed axes."""

    origin: tuple = (0.0, 0.0, 0.0)
    i: tuple = (1.0, 0.0, 0.0)
    j: tuple = (0.0, 1.0, 0.0)
    k: tuple = (0.0, 0.0, 1.0)

    def to_workpiece(self, point):
        return tuple(
            self.origin[axis] + point[0] * self.i[axis] + point[1] * self.j[axis] + point[2] * self.k[axis]
            for axis in range(3)
        )

    def is_workpiece(self):
        return self.near(Face())

    def near(self, other):
        mine, theirs = (self.origin + self.i + self.j + self.k, other.origin + other.i + other.j + other.k)
        return all(abs(a - b) < 1e-9 for a, b in zip(mine, theirs))


@dataclass
class Operation:
    """What FreeCAD computed for one object: commands are (name, {letter: value}), lengths in mm, feeds in mm/s."""

    label: str
    commands: list
    coolant: str = "None"
    face: Face = None
    active: bool = True


# --- Options ---------------------------------------------------------------------------------------------------------


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise PostError(f"arguments of the post-processor: {message}")


def triple(text):
    try:
        values = tuple(float(value) for value in text.split(","))
    except ValueError:
        values = ()
    if len(values) != 3 or not all(map(math.isfinite, values)):
        raise argparse.ArgumentTypeError(f"{text} is not X,Y,Z")
    return values


def origin(text):
    return None if text == "machine" else triple(text)


def fixture(text):
    name, equals, value = text.partition("=")
    if not equals or name.upper() not in FIXTURES:
        raise argparse.ArgumentTypeError(f"{text} is not like G55=X,Y,Z")
    return name.upper(), triple(value)


def tool(text):
    match = re.fullmatch(r"(\d+)=T?(\d{6})", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text} is not like 3=102003")
    return int(match[1]), match[2]


def function(text):
    """An M function of the shop: 8, M08, or one with parameters, M101 P1=1. `none` writes nothing."""
    if text.lower() == "none":
        return ""
    match = re.fullmatch(r"M?0*(\d{1,3})((?:\s+P\d{1,2}=-?\d+(?:\.\d+)?)*)", text.strip(), re.IGNORECASE)
    if not match or int(match[1]) in (0, 2, 3, 4, 5, 6):
        raise argparse.ArgumentTypeError(f"{text} is no M function of the shop, as M08 or 'M101 P1=1'")
    return f"M{int(match[1]):02}{match[2].upper()}"


def non_negative(text):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not a length")
    return value


def make_parser():
    parser = Parser(prog="isocnc", add_help=False, allow_abbrev=False)
    add = parser.add_argument
    add("--no-header", action="store_true", help="suppress header output")
    add("--no-comments", action="store_true", help="suppress comment output")
    add("--line-numbers", action="store_true", help="prefix with line numbers")
    add("--show-editor", action="store_true", default=True, help="pop up editor before writing output (default)")
    add("--no-show-editor", dest="show_editor", action="store_false", help="don't pop up editor before writing output")
    add("--precision", type=int, help="number of digits of precision, default=3, in inches 4")
    add("--preamble", help='set commands to be issued before the first command, default="G17 G71 G90 G94"')
    add("--postamble", help='set commands to be issued after the last command, default="M05"; M02 follows')
    add("--inches", action="store_true", help="Convert output for US imperial mode (G70)")
    add("--modal", action="store_true", help="suppress a G that is in force")
    add("--axis-modal", action="store_true", help="suppress coordinates that do not change")
    add("--origin", type=origin, default=False, metavar="X,Y,Z", help="G54 in machine coordinates, or: machine")
    add("--fixture", type=fixture, action="append", default=[], metavar="G55=X,Y,Z", help="another fixture")
    add("--tool", type=tool, action="append", default=[], metavar="3=102003", help="the T of a tool number")
    add("--head", type=int, metavar="H", help="the head of all other tools")
    add("--holder", type=int, metavar="HH", help="their holder")
    add("--flood", type=function, default="M08", metavar="M", help="flood coolant, default=M08; none")
    add("--mist", type=function, default="M07", metavar="M", help="mist coolant, default=M07; none")
    add("--coolant-off", type=function, default="M09", metavar="M", help="coolant off, default=M09; none")
    add("--stop", type=function, metavar="M", help="what stops the program, for M0 and M1")
    add("--peck-clearance", type=non_negative, default=0.25, metavar="MM", help="G73, G83: between pecks, default=0.25")
    add("--arcs", choices=["center", "radius"], default="center", help="how arcs up to 120 degrees are written")
    add("--safe-z", type=float, metavar="Z", help="where B and C may turn, in the workpiece frame, mm")
    add("--faces", choices=["g29", "g28"], default="g29", help="g29, or g24 with other axes; g28: from where they start")
    add("--rotary", choices=["tool", "part"], default="tool", help="what A, B and C of the job turn")
    add("--all-jobs", action="store_true", help="all jobs of the document, the later ones as faces of the first")
    add("--home", type=triple, metavar="X,Y,Z", help="where to go at the end, in machine coordinates")
    return parser


TOOLTIP_ARGS = make_parser().format_help()


def parse_options(text):
    try:
        words = shlex.split(text or "")
    except ValueError as error:
        raise PostError(f"arguments of the post-processor: {error}") from None
    # A value such as -10,5,0 is no option.
    joined = []
    for word in words:
        if joined and re.fullmatch(r"--[a-z-]+", joined[-1]) and re.match(r"-[\d.]", word):
            joined[-1] += "=" + word
        else:
            joined.append(word)
    options = make_parser().parse_args(joined)
    unit = "in" if options.inches else "mm"
    least = LEAST_PRECISION[unit]
    if options.precision is None:
        options.precision = least
    if not least <= options.precision <= 9:
        raise PostError(
            f"--precision {options.precision}: from {least} to 9 digits in {unit}, as the control wants the ends of arcs "
            f"within {ARC_TOLERANCE} mm"
        )
    for name, largest in (("head", 9), ("holder", 99)):
        value = getattr(options, name)
        if value is not None and not 1 <= value <= largest:
            raise PostError(f"--{name} {value}: from 1 to {largest}")
    if (options.head is None) != (options.holder is None):
        raise PostError("--head and --holder belong together")
    options.fixtures = dict(options.fixture)
    if options.origin is not False:
        options.fixtures["G54"] = options.origin
    options.tools = dict(options.tool)
    for text, name in ((options.preamble, "--preamble"), (options.postamble, "--postamble")):
        check_own_text(text, name, options)
    return options


def lines_of(text):
    return [line for line in text.replace("\\n", "\n").splitlines() if line.strip()]


def check_own_text(text, name, options):
    """Text of the user is written as it stands, and so may not change how the rest of the program is read."""
    if text is None:
        return
    changing = {18, 19, 24, 28, 29, 39, 41, 42, 49, 91, 93, 71 if options.inches else 70}
    for line in lines_of(text):
        code = re.sub(r"\([^)]*\)|;.*", " ", line).upper()
        for number in re.findall(r"G\s*0*(\d+)", code):
            if int(number) in changing:
                raise PostError(f"{name}: G{number} would change how the rest of the program is read")


# --- The translation -------------------------------------------------------------------------------------------------


def normalized(vector):
    length = math.sqrt(sum(value * value for value in vector))
    if length < 1e-9:
        raise PostError("a face needs versors that are not zero")
    return tuple(value / length for value in vector)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def face_of_axes(at, i, j, k):
    i, j, k = normalized(i), normalized(j), normalized(k)
    if max(abs(dot(i, j)), abs(dot(j, k)), abs(dot(k, i))) > 1e-4 or dot(cross(i, j), k) < 0:
        raise PostError("a face needs orthogonal, right-handed axes")
    return Face(tuple(at), i, j, k)


def face_of_angles(at, b, c):
    """The axes of a G29."""
    b, c = math.radians(b), math.radians(c)
    i = (math.cos(c) * math.cos(b), math.sin(c) * math.cos(b), -math.sin(b))
    j = (-math.sin(c), math.cos(c), 0.0)
    return Face(tuple(at), i, j, cross(i, j))


def face_of_part(angles):
    """The frame in which a part stands that C has turned about Z, then B about Y, then A about X."""

    def turned(vector):
        x, y, z = vector
        for letter, (first, second) in (("A", (1, 2)), ("B", (2, 0)), ("C", (0, 1))):
            point = [x, y, z]
            angle = -math.radians(angles.get(letter, 0.0))
            a, b = point[first], point[second]
            point[first], point[second] = a * math.cos(angle) - b * math.sin(angle), a * math.sin(angle) + b * math.cos(angle)
            x, y, z = point
        return (x, y, z)

    return Face((0.0, 0.0, 0.0), turned((1, 0, 0)), turned((0, 1, 0)), turned((0, 0, 1)))


def tilt_of(face):
    """B and C of the normal of a face, and whether a G29 with them has its axes."""
    j = face.j
    if abs(j[2]) < 1e-9:
        c = math.degrees(math.atan2(-j[0], j[1]))
        b = math.degrees(math.atan2(-face.i[2], face.k[2]))
        if abs(b) <= 90 + 1e-9:
            return b, c, True
    if face.k[2] < -1e-9:
        raise PostError("a face that looks down cannot be reached from above")
    return math.degrees(math.acos(min(1.0, face.k[2]))), math.degrees(math.atan2(face.k[1], face.k[0])), False


def sweep_of(start, end, center, clockwise):
    """Radians of an arc in its plane, above 0; a full turn where start and end are the same place."""
    if math.dist(start, end) < SAME_PLACE:
        return math.tau
    angle = math.atan2(end[1] - center[1], end[0] - center[0]) - math.atan2(start[1] - center[1], start[0] - center[0])
    return (-angle if clockwise else angle) % math.tau


@dataclass
class State:
    """Of the control as far as it is known: positions in mm and degrees in the frame in force."""

    at: dict = field(default_factory=lambda: dict.fromkeys(AXES))  # As FreeCAD computed it; None: not known.
    written: dict = field(default_factory=dict)  # As text.
    g: int = None
    feed: float = None  # mm/min
    written_feed: str = None
    plane: int = 17
    written_plane: int = 17
    absolute: bool = True
    absolute_centers: bool = False
    five_axes: bool = False
    initial_level: bool = True  # G98
    tool: str = None
    speed: float = None
    spindle: int = None
    fixture: str = None
    face: Face = field(default_factory=Face)
    wanted: Face = field(default_factory=Face)
    tilted: bool = False  # By a face.
    zero: dict = field(default_factory=dict)  # Where a G28 has its origin, in the face as FreeCAD counts it.


class Translator:
    def __init__(self, options):
        self.options = options
        self.state = State()
        self.lines = []
        self.number = 0
        self.held = []  # Rapids before the first tool change, which the control would stop at.
        self.turned = {}  # By A, B and C of the job, with --rotary part.
        self.numbers = {}  # The tool number that has each T.
        self.turns = False  # Whether B or C turn anywhere.
        self.place = ""

    # Text

    def line(self, text):
        if self.options.line_numbers:
            self.number += 10
            text = f"N{self.number} {text}"
        self.lines.append(text)

    def comment(self, text):
        text = " ".join(text.replace("(", "[").replace(")", "]").split())
        if text and not self.options.no_comments:
            self.line(f"({text})")

    def digits(self, value, places):
        text = f"{value:.{places}f}"
        if "." in text:
            text = text.rstrip("0").rstrip(".")
        return "0" if text in ("-0", "") else text

    def length(self, value):
        return self.digits(value / MM_PER_INCH if self.options.inches else value, self.options.precision)

    def coordinate(self, axis, value):
        if axis in LINEAR:
            return self.length(value - self.state.zero.get(axis, 0.0))
        return self.digits(value, self.options.precision)

    def rounded(self, axis, value):
        """As the control will read it: for distances, as a G28 may have moved its origin."""
        unit = MM_PER_INCH if self.options.inches and axis in LINEAR else 1.0
        return float(self.coordinate(axis, value)) * unit

    def fail(self, reason):
        raise PostError(f"{self.place}: {reason}" if self.place else reason)

    def told(self, function, *arguments):
        """The result of a function, whose failure gets the place in the job."""
        try:
            return function(*arguments)
        except PostError as error:
            return self.fail(str(error))

    # The program

    def translate(self, operations, header=()):
        options, state = self.options, self.state
        operations = [operation for operation in operations if operation.active]
        self.turns = any(
            (operation.face and not operation.face.is_workpiece())
            or any(set(ROTARY) & set(words) or name in ("G24", "G28", "G29") for name, words in operation.commands)
            for operation in operations
        )
        if not options.no_header:
            for text in header:
                self.comment(text)
        preamble = options.preamble
        if preamble is None:
            preamble = f"G17 {'G70' if options.inches else 'G71'} G90 G94"
        elif options.inches and not re.search(r"G\s*0*70(?!\d)", preamble.upper()):
            preamble = "G70\n" + preamble
        for text in lines_of(preamble):
            self.line(text)
        before = None
        for operation in operations:
            if operation.face != before:
                before = operation.face
                state.wanted = operation.face or Face()
            self.operation(operation)
        self.place = "end of the program"
        if self.held:
            self.fail("rapids without a tool: the control moves only after a tool change")
        self.finish()
        return "\n".join(self.lines) + "\n"

    def finish(self):
        options, state = self.options, self.state
        self.to_three_axes()
        self.leave_face()
        self.upright()
        if options.postamble is None:
            self.stop_spindle()
        else:
            for text in lines_of(options.postamble):
                self.line(text)
        if options.home and state.tool:
            if state.fixture and options.fixtures[state.fixture] not in (None, (0.0, 0.0, 0.0)):
                self.line("G92 X0 Y0 Z0")
            self.forget()
            state.g = None
            self.rapid({"Z": options.home[2]})
            self.rapid({"X": options.home[0], "Y": options.home[1]})
        if self.lines[-1:] and re.sub(r"^N\d+ ", "", self.lines[-1]).strip().upper() in ("M02", "M2"):
            return
        self.line("M02")

    def operation(self, operation):
        self.place = operation.label
        self.comment(f"begin operation: {operation.label}")
        coolant = {"None": "", "Flood": self.options.flood, "Mist": self.options.mist}.get(operation.coolant)
        if coolant is None:
            self.fail(f"coolant {operation.coolant}: only Flood and Mist have an M function")
        if coolant:
            self.line(coolant)
        for index, (name, words) in enumerate(operation.commands):
            said = " ".join([name] + [f"{letter}{value:g}" for letter, value in sorted(words.items())])
            self.place = f"{operation.label}, command {index + 1} ({said})"
            self.rest = operation.commands[index:]
            self.command(name.strip(), words)
        self.place = operation.label
        self.to_three_axes()
        if coolant and self.options.coolant_off:
            self.line(self.options.coolant_off)

    # Commands

    def command(self, name, words):
        if not all(map(math.isfinite, words.values())):
            self.fail("a value is not a number")
        if name.startswith("("):
            return self.comment(name[1:-1] if name.endswith(")") else name[1:])
        name = name.upper()
        match = re.fullmatch(r"([GMTSN])0*(\d+(?:\.\d+)?)", name)
        if not match:
            return self.fail("this command is not known")
        letter, number = match[1], match[2]
        if letter == "T" and words.get("M") == 6:
            return self.change_tool(int(float(number)), {key: value for key, value in words.items() if key != "M"})
        if letter == "S":
            return self.set_speed(float(number))
        if letter == "M":
            return self.m_function(number, words)
        if letter != "G":
            return self.fail("this command is not known")
        return self.g_function(number, words)

    def allow(self, words, letters):
        wrong = sorted(set(words) - set(letters))
        if wrong:
            reason = "A is no axis of this control" if wrong == ["A"] else f"{', '.join(wrong)} has no meaning here"
            if wrong == ["A"] and self.options.rotary == "tool":
                reason += "; where A turns the part, there is --rotary part"
            self.fail(reason)

    def g_function(self, number, words):
        state = self.state
        if f"G{number}" in FIXTURES:
            self.allow(words, "")
            return self.mount_fixture(f"G{number}")
        if number in ("90.1", "91.1"):
            state.absolute_centers = number == "90.1"
            return self.allow(words, "")
        if "." in number:
            return self.fail(REFUSED.get(int(float(number)), "this G is not known"))
        number = int(number)
        if number in (0, 1):
            return self.straight(number, words)
        if number in (2, 3):
            return self.arc(number, words)
        if number == 4:
            return self.dwell(words)
        if number in CYCLES:
            return self.cycle(number, words)
        if number in PLANES:
            state.plane = number
        elif number in (90, 91):
            state.absolute = number == 90
        elif number in (98, 99):
            state.initial_level = number == 98
        elif number in (24, 27, 29) or (number == 28 and {"I", "J", "K"} & set(words) and {"P", "Q", "R"} & set(words)):
            return self.want_face(number, words)
        elif number in SUPERFLUOUS:
            return self.allow(words, SUPERFLUOUS[number])
        else:
            return self.fail(REFUSED.get(number, "this G has no counterpart"))
        return self.allow(words, "")

    def m_function(self, number, words):
        if "." in number:
            return self.fail("this M is not known")
        number = int(number)
        if number == 6:
            if "T" not in words:
                self.fail("a tool change without a tool number")
            return self.change_tool(int(words["T"]), {key: value for key, value in words.items() if key != "T"})
        if number in (3, 4):
            self.allow(words, "S")
            return self.start_spindle(number, words.get("S"))
        self.allow(words, "")
        if number == 5:
            return self.stop_spindle()
        if number in (7, 8, 9):
            text = {7: self.options.mist, 8: self.options.flood, 9: self.options.coolant_off}[number]
            return self.line(text) if text else None
        if number in (0, 1):
            if self.options.stop is None:
                self.fail("the dialect has no M that stops the program; name the machine's own with --stop")
            return self.line(self.options.stop) if self.options.stop else None
        if number in REFUSED_M:
            return self.fail(REFUSED_M[number])
        if not 10 <= number <= 999:
            return self.fail("this M is not known")
        return self.line(f"M{number}")

    def dwell(self, words):
        self.allow(words, "P")
        seconds = words.get("P", 0.0)
        if seconds < 0:
            self.fail("a dwell is not negative")
        if seconds > 0:
            self.line(f"G04 P{self.digits(seconds, 3)}")

    # Tool and spindle

    def t_of(self, number):
        options = self.options
        if number in options.tools:
            return options.tools[number]
        if 100000 <= number <= 999999:
            return str(number)
        if options.head is None:
            self.fail(f"tool {number} has no T: give --tool {number}=102003, or --head and --holder for all")
        if not 1 <= number <= 999:
            self.fail(f"tool {number}: the control counts tools from 1 to 999")
        return f"{options.head}{options.holder:02}{number:03}"

    def change_tool(self, number, others):
        self.allow(others, "")
        state = self.state
        name = self.t_of(number)
        other = self.numbers.setdefault(name, number)
        if other != number and name != NO_TOOL:
            self.fail(f"tools {other} and {number} are both at T{name}: give each a T of its own with --tool")
        if name == state.tool:
            return
        self.to_three_axes()
        self.leave_face()
        self.upright()
        self.stop_spindle()
        if state.fixture is None:
            self.mount_fixture("G54")
        self.line(f"M06 T{name}")
        state.tool = name
        self.forget()
        held, self.held = self.held, []
        for words in held:
            self.rapid(words)

    def set_speed(self, speed):
        if speed <= 0:
            self.fail("a spindle speed is above 0")
        if speed != self.state.speed:
            self.line(f"S{self.digits(speed, 0)}")
        self.state.speed = speed

    def start_spindle(self, number, speed):
        state = self.state
        if state.tool is None:
            self.fail("the spindle starts before the first tool change")
        speed = state.speed if speed is None else speed
        if speed is None or speed <= 0:
            self.fail("the spindle starts without a speed")
        if (number, speed) == (state.spindle, state.speed):
            return
        if state.spindle not in (None, number):
            self.stop_spindle()
        self.line(f"S{self.digits(speed, 0)} M{number:02}")
        state.spindle, state.speed = number, speed

    def stop_spindle(self):
        if self.state.spindle is not None:
            self.line("M05")
            self.state.spindle = None

    # Frames

    def forget(self):
        """Positions are not known any more: after a tool change the tip is elsewhere."""
        tilt = {axis: self.state.at[axis] for axis in ROTARY}
        self.state.at = {**dict.fromkeys(LINEAR), **tilt}
        self.state.written = {axis: text for axis, text in self.state.written.items() if axis in ROTARY}

    def mount_fixture(self, name):
        state, options = self.state, self.options
        if name == state.fixture:
            return
        if name not in options.fixtures:
            option = "--origin X,Y,Z" if name == "G54" else f"--fixture {name}=X,Y,Z"
            self.fail(f"where {name} lies on the machine is not known: give {option} in machine coordinates")
        self.to_three_axes()
        self.leave_face()
        self.upright()
        before, now = (options.fixtures.get(fixture) or (0.0, 0.0, 0.0) for fixture in (state.fixture, name))
        if state.fixture is None and options.fixtures[name] is None:
            self.comment("origin: machine")
        else:
            self.line("G92 " + " ".join(axis + self.length(value) for axis, value in zip(LINEAR, now)))
        for axis, old, new in zip(LINEAR, before, now):
            if state.at[axis] is not None:
                state.at[axis] += old - new
        state.written = {axis: text for axis, text in state.written.items() if axis in ROTARY}
        state.fixture = name

    def want_face(self, number, words):
        if number == 27:
            self.allow(words, "")
            self.state.wanted = Face()
            return
        if number == 28:  # From here, where FreeCAD believes that the tool is.
            here = [self.state.at[axis] for axis in LINEAR]
            if None in here:
                self.fail("a G28 takes its origin from where the tool is, which is not known here")
            at, letters = self.state.face.to_workpiece(here), ("XYZ", "IJK", "PQR")
        else:
            at, letters = [words.get(axis, 0.0) for axis in LINEAR], ("ABC", "IJK", "PQR")
        if number == 29:
            self.allow(words, "XYZBC")
            if abs(words.get("C", 0.0)) > 180 or abs(words.get("B", 0.0)) > 90:
                self.fail("G29 takes C from -180 to 180 and B from -90 to 90")
            self.state.wanted = face_of_angles(at, words.get("B", 0.0), words.get("C", 0.0))
            return
        self.allow(words, "XYZABCIJKPQR" if number == 24 else "XYZIJKPQR")
        axes = [[words.get(letter, 0.0) for letter in three] for three in letters]
        self.state.wanted = self.told(face_of_axes, at, *axes)

    def approach_of(self):
        """Where the rest of the operation goes first: X and Y, and the height of its first rapids."""
        found = {}
        for name, words in self.rest:
            number = re.fullmatch(r"G0*(\d+)", name.strip().upper())
            if number and int(number[1]) in (1, 2, 3):
                break
            if number and (int(number[1]) == 0 or int(number[1]) in CYCLES):
                for axis in LINEAR:
                    if axis in words and not (axis == "Z" and int(number[1]) != 0):
                        found.setdefault(axis, words[axis])
        if set(found) != set(LINEAR) or not self.state.absolute:
            self.fail("an operation on a face has to begin with rapids to X, Y and Z")
        return tuple(found[axis] for axis in LINEAR)

    def enter_face(self):
        """Goes to the wanted frame, before a motion: up, across, B and C, down, and only then mounts it."""
        state, options = self.state, self.options
        if state.wanted.is_workpiece():
            self.leave_face()
            self.upright()
        if state.wanted.near(state.face):
            return
        self.leave_face()
        if options.safe_z is None:
            self.fail("for faces, say with --safe-z how high the tool goes before B and C turn")
        b, c, plain = self.told(tilt_of, state.wanted)
        start = self.approach_of()
        above = state.wanted.to_workpiece(start)
        if above[2] > options.safe_z:
            self.fail(f"--safe-z {options.safe_z:g} is below the start of the face, Z{above[2]:.3f}")
        self.rapid({"Z": options.safe_z})
        self.rapid({"X": above[0], "Y": above[1]})
        # A face that looks up does not turn the tool, however its axes lie.
        turn = {"B": b, "C": c} if abs(b) > 1e-9 else dict.fromkeys(ROTARY, 0.0)
        if any(self.differs(axis, value) for axis, value in turn.items()):
            self.rapid(turn)
        self.rapid({"Z": above[2]})
        at, i, j, k = state.wanted.origin, state.wanted.i, state.wanted.j, state.wanted.k
        words = [axis + self.length(value) for axis, value in zip(LINEAR, at)]
        if options.faces == "g28":
            name, words = "G28", self.versors("XYZIJKPQR", i + j + k)
            state.zero = dict(zip(LINEAR, start))
        elif plain:
            name, words = "G29", [*words, f"B{self.digits(b, 6)}", f"C{self.digits(c, 6)}"]
        else:
            name, words = "G24", words + self.versors("ABCIJKPQR", i + j + k)
        self.line(" ".join([name, *words]))
        state.face, state.tilted = state.wanted, True
        self.forget()

    def versors(self, letters, values):
        """The components that are not 0, which the control assumes for the others."""
        texts = [(letter, self.digits(value, 9)) for letter, value in zip(letters, values)]
        return [letter + text for letter, text in texts if text != "0"]

    def leave_face(self):
        if self.state.face.is_workpiece():
            return
        self.line("G27")
        self.state.zero = {}
        self.state.face = Face()
        self.forget()
        self.rapid({"Z": self.options.safe_z})

    def upright(self):
        """B and C back to 0, where a face has turned them."""
        if self.state.tilted:
            self.rapid(dict.fromkeys(ROTARY, 0.0))
            self.state.tilted = False

    def turn_part(self, words):
        """A, B and C of the job turn the part: the tool turns instead, and the coordinates count in a face."""
        others = set(words) - set("ABCF")
        if others:
            self.fail("where the part turns, A, B and C have to stand alone in a rapid")
        for letter in "ABC":
            if letter in words:
                self.turned[letter] = words[letter]
        self.state.wanted = face_of_part(self.turned)

    def to_five_axes(self):
        if not self.state.five_axes:
            self.line("G49")
            self.state.five_axes = True

    def to_three_axes(self):
        if self.state.five_axes:
            self.line("G48")
            self.state.five_axes = False

    # Motion

    def target_of(self, words):
        """The end of a motion, of the axes that it names."""
        state = self.state
        target = {}
        for axis in AXES:
            if axis not in words:
                continue
            if state.absolute:
                target[axis] = words[axis]
            elif state.at[axis] is None:
                self.fail(f"G91 counts from where {axis} is, which is not known here")
            else:
                target[axis] = state.at[axis] + words[axis]
        return target

    def ready(self):
        if self.state.tool is None:
            self.fail("the tool cuts before the first tool change")

    def straight(self, number, words):
        state = self.state
        if self.options.rotary == "part" and set("ABC") & set(words):
            if number != 0:
                self.fail("the part cannot turn while the tool cuts: A, B and C only in rapids")
            return self.turn_part(words)
        self.allow(words, AXES + "F")
        if state.tool is None and number == 0 and state.absolute:
            target = self.target_of(words)
            if target:
                self.held.append(target)
            return None
        self.ready()
        if set(LINEAR) & set(words):
            self.enter_face()
        target = self.target_of(words)
        if number == 0:
            return self.rapid(target)
        self.take_feed(words)
        return self.feed(target)

    def take_feed(self, words):
        if words.get("F", 0.0) < 0:
            self.fail("a feed is not negative")
        if words.get("F", 0.0) > 0:
            self.state.feed = words["F"] * 60

    def rapid(self, target):
        state = self.state
        if self.turns and state.at["B"] is None:
            target = {**dict.fromkeys(ROTARY, 0.0), **target}
        self.move(0, target)

    def feed(self, target):
        if any(axis in target and self.differs(axis, target[axis]) for axis in ROTARY):
            self.to_five_axes()
        self.move(1, target)

    def differs(self, axis, value):
        return self.state.written.get(axis) != self.coordinate(axis, value)

    def move(self, number, target, extra=(), always=False):
        """Writes a motion, unless it goes nowhere as far as it is written."""
        state, options = self.state, self.options
        words = []
        changed = False
        for axis in AXES:
            if axis not in target:
                continue
            text = self.coordinate(axis, target[axis])
            differs = state.written.get(axis) != text
            changed |= differs
            if differs or always or not options.axis_modal:
                words.append(axis + text)
            state.at[axis] = target[axis]
            state.written[axis] = text
        if not changed and not always:
            return
        words += extra
        if not (options.modal and state.g == number):
            words.insert(0, f"G{number:02}")
        state.g = number
        if number != 0:
            words += self.feed_word()
        self.line(" ".join(words))

    def feed_word(self):
        state = self.state
        if state.feed is None:
            self.fail("no feed so far")
        text = self.digits(state.feed / MM_PER_INCH if self.options.inches else state.feed, 3)
        if text == "0":
            self.fail("the feed is 0")
        if text == state.written_feed:
            return []
        state.written_feed = text
        return [f"F{text}"]

    # Arcs

    def arc(self, number, words):
        state = self.state
        first, second, _, first_center, second_center, _ = PLANES[state.plane]
        self.allow(words, AXES + "IJKRPF")
        if words.get("P", 1.0) != 1.0:
            self.fail("arcs of more than one turn have no counterpart")
        self.ready()
        self.enter_face()
        if None in (state.at[axis] for axis in LINEAR):
            self.fail("the arc starts at a place that is not known")
        self.take_feed(words)
        target = self.target_of(words)
        start = (state.at[first], state.at[second])
        end = (target.get(first, start[0]), target.get(second, start[1]))
        clockwise = number == 2
        if "R" in words:
            center = self.center_of_radius(start, end, words, clockwise)
        else:
            # FreeCAD adds half the rise of a helix along the normal, where the center may lie anywhere.
            if not {first_center, second_center} & set(words):
                self.fail("the arc has neither center nor radius")
            if state.absolute_centers:
                center = (words.get(first_center, start[0]), words.get(second_center, start[1]))
            else:
                center = (start[0] + words.get(first_center, 0.0), start[1] + words.get(second_center, 0.0))
        radius, other = math.dist(start, center), math.dist(end, center)
        if abs(radius - other) > ARC_TOLERANCE / 2:
            self.fail(f"this is no arc: its start is {radius:.4f} mm from the center, its end {other:.4f} mm")
        target[first], target[second] = end
        self.write_arc(number, target, center, sweep_of(start, end, center, clockwise))

    def center_of_radius(self, start, end, words, clockwise):
        if set("IJK") & set(words):
            self.fail("the arc has both a radius and a center")
        radius, chord = words["R"], math.dist(start, end)
        if chord < SAME_PLACE:
            self.fail("a full turn needs a center")
        if abs(radius) * 2 < chord - ARC_TOLERANCE:
            self.fail("the radius is too small for the ends of the arc")
        height = math.sqrt(max(0.0, radius * radius - chord * chord / 4))
        side = -1.0 if clockwise == (radius > 0) else 1.0
        middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        along = ((end[0] - start[0]) / chord, (end[1] - start[1]) / chord)
        return (middle[0] - side * along[1] * height, middle[1] + side * along[0] * height)

    def write_arc(self, number, target, center, sweep):
        """An arc as it is written may not become another one by rounding."""
        state, options = self.state, self.options
        first, second, _, first_center, second_center, _ = PLANES[state.plane]
        plane = ((first, second), (first_center, second_center))
        if any(axis in target and self.differs(axis, target[axis]) for axis in ROTARY):
            self.to_five_axes()
        start = tuple(self.rounded(axis, state.at[axis]) for axis in plane[0])
        end = tuple(self.rounded(axis, target[axis]) for axis in plane[0])
        middle = tuple(self.rounded(axis, value) for axis, value in zip(plane[0], center))
        if min(math.dist(start, middle), math.dist(end, middle)) < SAME_PLACE:
            return self.move(1, target)  # Less than the last digit.
        written_sweep = sweep_of(start, end, middle, number == 2)
        if abs(written_sweep - sweep) > math.pi:
            if sweep < math.pi:
                return self.move(1, target)  # Its ends are the same place, or change their order, by rounding.
            halfway = self.halfway(number, target, center, sweep)
            self.write_arc(number, halfway, center, sweep / 2)
            return self.write_arc(number, target, center, sweep / 2)
        if state.written_plane != state.plane:
            self.line(f"G{state.plane}")
            state.written_plane = state.plane
        if options.arcs == "radius" and sweep <= math.radians(120):
            extra = [f"R{self.length(math.dist(start, middle))}"]
        else:
            extra = sorted(letter + self.coordinate(axis, value) for letter, axis, value in zip(plane[1], plane[0], center))
        return self.move(number, target, extra, always=True)

    def halfway(self, number, target, center, sweep):
        state = self.state
        first, second = PLANES[state.plane][:2]
        point = {axis: value if state.at[axis] is None else (state.at[axis] + value) / 2 for axis, value in target.items()}
        angle = -sweep / 2 if number == 2 else sweep / 2
        a, b = state.at[first] - center[0], state.at[second] - center[1]
        point[first] = center[0] + a * math.cos(angle) - b * math.sin(angle)
        point[second] = center[1] + a * math.sin(angle) + b * math.cos(angle)
        return point

    # Drilling

    def cycle(self, number, words):
        state = self.state
        self.allow(words, CYCLES[number] + "L" + ("P" if not words.get("P") else ""))
        if not state.absolute or state.plane != 17:
            self.fail("drilling cycles only in G90 and G17")
        self.ready()
        self.enter_face()
        for axis in "ZR":
            if axis not in words:
                self.fail(f"the cycle has no {axis}")
        if state.at["Z"] is None:
            self.fail("the cycle starts at a height that is not known")
        top, bottom = words["R"], words["Z"]
        if bottom >= top:
            self.fail("the hole ends above R")
        if number in (73, 83) and words.get("Q", 0.0) <= 0:
            self.fail("the cycle has no Q above 0")
        if number in (73, 83) and (top - bottom) / words["Q"] > MOST_PECKS:
            self.fail(f"Q makes more than {MOST_PECKS} pecks of one hole")
        self.take_feed(words)
        level = max(state.at["Z"], top) if state.initial_level else top
        if state.at["Z"] < top:
            self.rapid({"Z": top})
        self.rapid({axis: words[axis] for axis in "XY" if axis in words})
        for _ in range(self.repetitions(words)):
            self.hole(number, words, level)

    def repetitions(self, words):
        number = words.get("L", 1)
        if number not in range(1, MOST_REPETITIONS + 1):
            self.fail(f"L is from 1 to {MOST_REPETITIONS}")
        return int(number)

    def hole(self, number, words, level):
        top, bottom = words["R"], words["Z"]
        self.rapid({"Z": top})
        if number in (73, 83):
            self.peck(number, top, bottom, words["Q"])
        else:
            self.feed({"Z": bottom})
        if number in (82, 89):
            self.dwell({"P": words.get("P", 0.0)})
        if number in (85, 89):
            self.feed({"Z": level})
        else:
            self.rapid({"Z": level})

    def peck(self, number, top, bottom, step):
        clearance = self.options.peck_clearance
        depth = top
        while depth - bottom > SAME_PLACE:
            if number == 83 and depth < top:
                self.rapid({"Z": min(top, depth + clearance)})
            depth = max(bottom, depth - step)
            if depth - bottom < SAME_PLACE:
                depth = bottom
            self.feed({"Z": depth})
            if depth > bottom:
                self.rapid({"Z": top if number == 83 else min(top, depth + clearance)})


def post(operations, options, header=()):
    """The program as text. Raises PostError."""
    return Translator(options).translate(operations, header)


# --- Without FreeCAD -------------------------------------------------------------------------------------------------


def three_numbers(values):
    values = tuple(float(value) for value in values)
    if len(values) != 3 or not all(map(math.isfinite, values)):
        raise ValueError("of three numbers")
    return values


def operations_of_json(data):
    operations = []
    try:
        for each in data["operations"]:
            face = each.get("face")
            operations.append(
                Operation(
                    label=str(each.get("label", "")),
                    commands=[(str(name), {str(key): float(value) for key, value in words.items()}) for name, words in each["commands"]],
                    coolant=str(each.get("coolant", "None")),
                    face=face and face_of_axes(*(three_numbers(face[name]) for name in ("origin", "i", "j", "k"))),
                    active=each.get("active", True),
                )
            )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise PostError(f"this is no job: {type(error).__name__} {error}") from None
    return operations


# --- FreeCAD ---------------------------------------------------------------------------------------------------------


def base_of(item):
    """What a dressup dresses, down to the operation itself."""
    chain = [item]
    while True:
        base = getattr(chain[-1], "Base", None)
        if isinstance(base, (list, tuple)) or not hasattr(base, "Path") or len(chain) > 100:
            return chain
        chain.append(base)


def is_active(item):
    return all(getattr(each, "Active", True) for each in base_of(item))


def operations_of_objects(items, face=None):
    operations = []
    for item in items:
        if is_job(item):
            operations += operations_of_jobs([item])
            continue
        if hasattr(item, "Group") and not hasattr(item, "ToolController"):  # A compound.
            operations += operations_of_objects([each for each in item.Group if hasattr(each, "Path")], face)
            continue
        if not hasattr(item, "Path"):
            raise PostError(f"{getattr(item, 'Label', item)} is not a path. Please select only paths and compounds.")
        chain = base_of(item)
        coolant = next((each.CoolantMode for each in chain if hasattr(each, "CoolantMode")), "None")
        operations.append(
            Operation(
                label=item.Label,
                commands=[(command.Name, dict(command.Parameters)) for command in item.Path.Commands],
                coolant=str(coolant),
                face=face,
                active=is_active(item),
            )
        )
    return operations


def is_job(item):
    return all(hasattr(item, name) for name in ("Operations", "Tools", "Model", "Stock", "Fixtures"))


def controller_of(item):
    return next((each.ToolController for each in base_of(item) if getattr(each, "ToolController", None)), None)


def placement_of(job):
    if not job.Model.Group:
        raise PostError(f"{job.Label} has no model, whose place tells which face it is")
    return job.Model.Group[0].Placement


def operations_of_document(document):
    jobs = [item for item in document.Objects if is_job(item)]
    if not jobs:
        raise PostError("the document has no job")
    return operations_of_jobs(jobs)


def operations_of_jobs(jobs):
    """The model of each job but the first is turned so that its face looks up; where it lies tells the frame."""
    fixtures = list(jobs[0].Fixtures)
    for job in jobs:
        if len(job.Fixtures) > 1 or list(job.Fixtures) != fixtures:
            raise PostError(f"{job.Label}: several jobs, or a job as a whole, have one fixture and the same")
    # As FreeCAD itself does, first up above the stock.
    above = jobs[0].Stock.Shape.BoundBox.ZMax + jobs[0].SetupSheet.ClearanceHeightOffset.Value
    operations, tool_before = [Operation(name, [(name, {}), ("G0", {"Z": above})]) for name in fixtures], None
    for job in jobs:
        face = None
        if job is not jobs[0]:
            place = placement_of(jobs[0]).multiply(placement_of(job).inverse())
            axes = [tuple(place.Rotation.multVec(type(place.Base)(*axis))) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
            face = face_of_axes(tuple(place.Base), *axes)
        for item in job.Operations.Group:
            controller = controller_of(item)
            if not is_active(item):
                continue
            if controller is not None and controller is not tool_before:
                operations += operations_of_objects([controller], face)
                tool_before = controller
            operations += operations_of_objects([item], face)
    return operations


def in_editor(text):
    """FreeCAD's dialog that lets the user look at the program and change it."""
    try:
        import FreeCAD
    except ImportError:
        return text
    if not FreeCAD.GuiUp or len(text) > 100000:
        return text
    try:
        from Path.Post import Utils as utils
    except ImportError:
        from PathScripts import PostUtils as utils
    dialog = utils.GCodeEditorDialog()
    dialog.editor.setText(text)
    return dialog.editor.toPlainText() if dialog.exec_() else text


def header_lines():
    return ["Exported by FreeCAD", "Post Processor: isocnc_post", f"Output Time: {datetime.datetime.now():%Y-%m-%d %H:%M:%S}"]


def export(objectslist, filename, argstring):
    """What FreeCAD calls. Writes to `filename`, or nowhere where it is "-", and returns the program."""
    options = parse_options(argstring)
    if options.all_jobs:
        if not objectslist:
            raise PostError("nothing is selected")
        document = next((item.Document for item in objectslist if hasattr(item, "Document")), None)
        if document is None:
            import FreeCAD

            document = FreeCAD.ActiveDocument
        operations = operations_of_document(document)
    else:
        operations = operations_of_objects(objectslist)
    text = post(operations, options, header_lines())
    if options.show_editor and filename != "-":  # Else FreeCAD writes it, and has its own editor.
        text = in_editor(text)
    if filename != "-":
        with open(filename, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
    return text


def main(arguments):
    if not arguments or arguments[0] in ("-h", "--help"):
        print("usage: isocnc_post.py JOB.json [options]\n" + TOOLTIP_ARGS)
        return 0 if arguments else 2
    try:
        with open(arguments[0], encoding="utf-8") as file:
            operations = operations_of_json(json.load(file))
        sys.stdout.write(post(operations, parse_options(shlex.join(arguments[1:])), []))
    except (PostError, OSError, ValueError, RecursionError) as error:
        print(f"isocnc_post: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
