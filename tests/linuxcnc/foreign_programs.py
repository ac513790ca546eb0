"""Random programs of LinuxCNC, as posts and people write them: what isofmt --from linuxcnc is to translate."""

import math
import random

MM_PER_INCH = 25.4
PLANES = {17: ("X", "Y", "Z", "I", "J"), 18: ("Z", "X", "Y", "K", "I"), 19: ("Y", "Z", "X", "J", "K")}
SYSTEMS = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"]
CYCLES = [73, 81, 82, 83, 85, 86, 89]


def number(value: float, decimals: int = 4) -> str:
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class ForeignWriter:
    """Writes one program line by line, and knows where the tool is in the coordinates of the program, in mm."""

    def __init__(self, seed: int, steps: int):
        self.random = random.Random(seed)
        self.lines: list[str] = ["%", f"(program {seed})"]
        self.unit = 1.0
        self.plane = 17
        self.incremental = False
        self.centers_absolute = False
        self.inverse_time = False
        self.to_r = False
        self.motion = -1
        self.at = dict.fromkeys("XYZ", 0.0)  # In the coordinate system in force.
        self.offset = dict.fromkeys("XYZ", 0.0)  # Machine coordinates of its zero.
        self.zeros = {name: dict.fromkeys("XYZ", 0.0) for name in SYSTEMS}
        self.shift = dict.fromkeys("XYZ", 0.0)
        self.system = "G54"
        self.write("G21 G17 G90 G94 G40 G49 G80 G98 G54")
        self.write("T1 M6")
        self.write("G43 H1")
        self.write("S8000 M3")
        self.go(0, {axis: round(self.random.uniform(-50, 50), 3) for axis in "XYZ"})
        self.write("F900")
        for _ in range(steps):
            self.step()
        self.write(self.random.choice(["M2", "M30"]))
        self.lines.append("%")

    def write(self, text: str) -> None:
        if self.often(0.3):
            text = text.lower()
        if self.often(0.3):
            text = text.replace(" ", "")
        if self.often(0.1):
            text += self.random.choice([" (a remark)", " ; a remark", "(one)"])
        self.lines.append(f"N{len(self.lines) * 10} {text}" if self.often(0.5) else text)

    def often(self, share: float) -> bool:
        return self.random.random() < share

    def step(self) -> None:
        steps = {
            self.rapid: 3,
            self.line: 5,
            self.arc: 12,
            self.cycle: 6,
            self.change_plane: 2,
            self.change_distance: 2,
            self.change_centers: 1,
            self.change_units: 1,
            self.change_system: 2,
            self.change_shift: 1,
            self.change_feed_mode: 1,
            self.reference: 1,
            self.machine: 1,
            self.other: 2,
        }
        self.random.choices(list(steps), list(steps.values()))[0]()

    def length(self, maximum: float) -> float:
        """In mm, and short in the units in force."""
        return round(self.random.uniform(-maximum, maximum) / self.unit, 3) * self.unit

    def feed(self) -> list[str]:
        if self.inverse_time:
            return [f"F{number(self.random.uniform(60, 500), 2)}"]
        return [f"F{number(self.random.uniform(100, 8000) / self.unit, 1)}"] if self.often(0.3) else []

    def axis_words(self, targets: dict[str, float]) -> list[str]:
        """The words, and the tool where they lead it: what is written counts."""
        words = []
        for axis, target in targets.items():
            value = (target - self.at[axis] if self.incremental else target) / self.unit
            text = number(value, 6)
            words.append(axis + text)
            self.at[axis] = float(text) * self.unit + (self.at[axis] if self.incremental else 0)
        return words

    def go(self, g: int, targets: dict[str, float], further: list[str] | None = None) -> None:
        words = [*self.axis_words(targets), *(further or []), *(self.feed() if g else [])]
        if self.motion != g or self.often(0.4):
            words.append(f"G{g}")
        self.motion = g
        self.random.shuffle(words)
        self.write(" ".join(words))

    def targets(self, axes: str = "XYZ") -> dict[str, float]:
        some = self.random.sample(axes, self.random.randint(1, len(axes)))
        return {axis: self.length(200) for axis in some}

    def rapid(self) -> None:
        self.go(0, self.targets())

    def line(self) -> None:
        self.go(1, self.targets())

    def arc(self) -> None:
        u, v, normal, i, j = PLANES[self.plane]
        at = complex(self.at[u], self.at[v])
        turn = self.random.uniform(0, 2 * math.pi)
        radius = self.random.uniform(5, 80)
        center = at + radius * complex(math.cos(turn), math.sin(turn))
        g = self.random.choice([2, 3])
        form = self.random.choice(["center", "center", "full", "radius", "large", "turns"])
        if self.inverse_time and form in ("full", "turns"):  # rs274 gives these the minimum feed.
            form = "center"
        degrees = {"radius": self.random.uniform(3, 170), "large": self.random.uniform(190, 350)}.get(
            form, self.random.uniform(5, 355)
        )
        sweep = math.radians(degrees if g == 3 else -degrees)
        end = center + (at - center) * complex(math.cos(sweep), math.sin(sweep))
        targets = {} if form == "full" else {u: end.real, v: end.imag}
        if form == "full" and self.often(0.5) and not self.incremental and self.is_exact(at):
            targets = {u: at.real, v: at.imag}
        if self.often(0.4):
            targets[normal] = self.at[normal] + self.length(10)
        if form in ("radius", "large"):
            further = [f"R{number(radius * (1 if form == 'radius' else -1) / self.unit, 6)}"]
        else:
            away = center if self.centers_absolute else center - at
            further = [i + number(away.real / self.unit, 6), j + number(away.imag / self.unit, 6)]
        if form == "turns":
            further.append(f"P{self.random.randint(1, 3)}")
        self.go(g, targets, further)

    def is_exact(self, at: complex) -> bool:
        return all(abs(part / self.unit - round(part / self.unit, 6)) < 1e-10 for part in (at.real, at.imag))

    def cycle(self) -> None:
        """Two or three holes, from a place above them."""
        if self.inverse_time:
            return
        u, v, normal, *_ = PLANES[self.plane]
        g = self.random.choice(CYCLES)
        level = self.at[normal]
        r = level + round(self.random.uniform(-20, 5) / self.unit, 3) * self.unit
        depth = round(self.random.uniform(2, 20) / self.unit, 3) * self.unit
        if self.often(0.5):
            self.to_r = not self.to_r
            self.write("G99" if self.to_r else "G98")
        if g == 86:
            self.write("M3")
        words = [f"G{g}"]
        if self.incremental:
            words += [f"R{number((r - level) / self.unit, 6)}", f"{normal}{number(-depth / self.unit, 6)}"]
        else:
            words += [f"R{number(r / self.unit, 6)}", f"{normal}{number((r - depth) / self.unit, 6)}"]
        if g in (73, 83):
            words.append(f"Q{number(self.random.uniform(1, 8) / self.unit, 3)}")
        if g in (82, 86, 89):
            words.append(f"P{number(self.random.uniform(0.1, 2), 2)}")
        repeats = self.random.randint(2, 3) if self.incremental and self.often(0.3) else 1
        if repeats > 1:
            words.append(f"L{repeats}")
        hole = self.targets(u + v)
        words += self.axis_words(hole)
        if repeats > 1:  # The increments count once for each hole.
            for word in words:
                if word[0] in hole:
                    self.at[word[0]] += float(word[1:]) * self.unit * (repeats - 1)
        self.write(" ".join(words))
        for _ in range(self.random.randint(0, 2)):
            self.write(" ".join(self.axis_words(self.targets(u + v))))
        self.write("G80")
        self.motion = -1
        self.at[normal] = math.nan  # rs274 says where; the next motion gives it anew.
        self.write("G90")
        self.incremental = False
        self.go(0, {normal: self.length(200)})

    def change_plane(self) -> None:
        self.plane = self.random.choice([17, 17, 18, 19])
        self.write(f"G{self.plane}")

    def change_distance(self) -> None:
        self.incremental = not self.incremental
        self.write("G91" if self.incremental else "G90")

    def change_centers(self) -> None:
        self.centers_absolute = not self.centers_absolute
        self.write("G90.1" if self.centers_absolute else "G91.1")

    def change_units(self) -> None:
        inches = self.unit == 1
        self.unit = MM_PER_INCH if inches else 1.0
        self.write("G20" if inches else "G21")

    def change_feed_mode(self) -> None:
        self.inverse_time = not self.inverse_time
        self.write("G93" if self.inverse_time else f"G94 F{number(self.random.uniform(100, 5000) / self.unit, 1)}")

    def reframe(self) -> None:
        offset = {axis: self.zeros[self.system][axis] + self.shift[axis] for axis in "XYZ"}
        for axis in "XYZ":
            self.at[axis] += self.offset[axis] - offset[axis]
        self.offset = offset

    def change_system(self) -> None:
        place = self.random.randrange(9)
        if self.often(0.5):
            values = {axis: self.length(200) for axis in self.random.sample("XYZ", self.random.randint(1, 3))}
            self.zeros[SYSTEMS[place]].update(values)
            words = [axis + number(value / self.unit) for axis, value in values.items()]
            self.write(" ".join([f"G10 L2 P{place + 1}", *words]))
            self.reframe()
        if self.often(0.7):
            self.system = SYSTEMS[place]
            self.write(self.system)
            self.reframe()

    def change_shift(self) -> None:
        if self.often(0.4):
            self.shift = dict.fromkeys("XYZ", 0.0)
            self.write("G92.1")
            self.reframe()
            return
        values = {axis: self.length(100) for axis in self.random.sample("XYZ", self.random.randint(1, 3))}
        self.write(" ".join(["G92", *(axis + number(value / self.unit) for axis, value in values.items())]))
        for axis, value in values.items():
            self.shift[axis] += self.at[axis] - value
            self.offset[axis] += self.at[axis] - value
            self.at[axis] = value

    def reference(self) -> None:
        axes = self.random.sample("XYZ", self.random.randint(0, 3))
        if axes and self.often(0.6):
            was = self.incremental
            self.write(" ".join(["G91 G28", *(f"{axis}0" for axis in axes)]))
            self.incremental = True
            if not was:
                self.change_distance()
        else:
            values = {axis: self.length(100) for axis in axes}
            self.write(" ".join([self.random.choice(["G28", "G30"]), *self.axis_words(values)]))
        for axis in axes or "XYZ":
            self.at[axis] = -self.offset[axis]

    def machine(self) -> None:
        if self.incremental:
            self.change_distance()
        axes = self.random.sample("XYZ", self.random.randint(1, 3))
        values = {axis: self.length(100) for axis in axes}
        words = [axis + number(value / self.unit) for axis, value in values.items()]
        self.write(" ".join(["G53 G0", *words]))
        self.motion = 0
        for axis, value in values.items():
            self.at[axis] = value - self.offset[axis]

    def other(self) -> None:
        speed = f"S{self.random.randint(1000, 20000)}"
        self.write(
            self.random.choice(
                ["G4 P0.5", "M5", f"{speed} M4", "M3", speed, "G61", "G64 P0.01", "T1 M6", "G40", "(note)"]
            )
        )
