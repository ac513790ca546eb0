"""Evaluates FreeCAD's commands by the rules of FreeCAD and LinuxCNC, in machine coordinates. Shares nothing with the post.

Commands are [name, {letter: value}], in mm, mm/s and seconds; see docs/posts.md for what the post adds between faces.
"""

import math

from events import Motion, Other, along_line, arc_motion

IDENTITY = ((0.0, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))


class FreeCadPath:
    def __init__(self, origins, tool_names, safe_z=None, peck_clearance=0.25, coolant=None):
        self.origins = origins
        self.tool_names = tool_names
        self.safe_z = safe_z
        self.peck_clearance = peck_clearance
        self.coolant = {"Flood": 8, "Mist": 7, "None": None} | (coolant or {})
        self.events = []
        self.origin = (0.0, 0.0, 0.0)
        self.frame = IDENTITY
        self.machine = (0.0, 0.0, 0.0)  # The tip, in machine coordinates.
        self.turn = (0.0, 0.0)
        self.tool = self.speed = self.direction = None
        self.plane = 17
        self.absolute, self.centers_absolute, self.initial_level = True, False, True
        self.feed = 0.0
        self.held = []

    # Frames

    def to_machine(self, point):
        at, axes = self.frame
        return tuple(
            self.origin[n] + at[n] + sum(value * axis[n] for value, axis in zip(point, axes)) for n in range(3)
        )

    def here(self):
        """The tip in the frame in force."""
        at, axes = self.frame
        away = [self.machine[n] - self.origin[n] - at[n] for n in range(3)]
        return [sum(a * b for a, b in zip(away, axis)) for axis in axes]

    def direction_of(self, vector):
        return tuple(sum(value * axis[n] for value, axis in zip(vector, self.frame[1])) for n in range(3))

    # Motions

    def go(self, kind, point, turn=None):
        end, turn = self.to_machine(point), turn or self.turn
        self.events.append(Motion(kind, along_line(self.machine, end), (self.turn, turn), self.feed if kind != "rapid" else 0.0))
        self.machine, self.turn = end, turn

    def to_axis(self, kind, index, value):
        point = self.here()
        point[index] = value
        self.go(kind, point)

    def target(self, words):
        point = self.here()
        for index, axis in enumerate("XYZ"):
            if axis in words:
                point[index] = words[axis] + (0.0 if self.absolute else point[index])
        turn = tuple(
            words[axis] + (0.0 if self.absolute else old) if axis in words else old for axis, old in zip("BC", self.turn)
        )
        return point, turn

    def arc(self, code, words):
        start = self.here()
        end, turn = self.target(words)
        u, v, w = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}[self.plane]
        letters = "IJK"
        if "R" in words:
            radius = words["R"]
            chord = [end[u] - start[u], end[v] - start[v]]
            length = math.hypot(*chord)
            # The center lies to the left of the chord for a short counterclockwise arc.
            left = math.sqrt(max(0.0, radius**2 - length**2 / 4)) * (1 if (code == 3) == (radius > 0) else -1)
            center = [
                (start[u] + end[u]) / 2 - chord[1] / length * left,
                (start[v] + end[v]) / 2 + chord[0] / length * left,
            ]
        else:
            base = (0.0, 0.0) if self.centers_absolute else (start[u], start[v])
            center = [words.get(letters[u], start[u] if self.centers_absolute else 0.0) + base[0],
                      words.get(letters[v], start[v] if self.centers_absolute else 0.0) + base[1]]
        first = math.atan2(start[v] - center[1], start[u] - center[0])
        last = math.atan2(end[v] - center[1], end[u] - center[0])
        sweep = last - first
        if math.hypot(end[u] - start[u], end[v] - start[v]) < 1e-6:
            sweep = math.tau if code == 3 else -math.tau
        elif code == 3:
            sweep += math.tau if sweep < 0 else 0.0
        else:
            sweep -= math.tau if sweep > 0 else 0.0
        middle, normal = [0.0] * 3, [0.0] * 3
        middle[u], middle[v], middle[w] = center[0], center[1], start[w]
        normal[w] = 1.0
        finish = self.to_machine(end)
        arc = (self.to_machine(middle), self.direction_of(normal), sweep)
        self.events.append(arc_motion(self.machine, finish, *arc, (self.turn, turn), self.feed))
        self.machine, self.turn = finish, turn

    def drill(self, code, words):
        x, y, z = self.here()
        top, bottom = words["R"], words["Z"]
        clear = max(z, top) if self.initial_level else top
        if z < top:
            self.to_axis("rapid", 2, top)
        self.go("rapid", [words.get("X", x), words.get("Y", y), max(z, top)])
        for _ in range(int(words.get("L", 1))):
            self.hole(code, words, top, bottom, clear)

    def hole(self, code, words, top, bottom, clear):
        self.to_axis("rapid", 2, top)
        if code in (73, 83):
            reached = top
            while reached > bottom:
                if code == 83 and reached != top:
                    self.to_axis("rapid", 2, min(top, reached + self.peck_clearance))
                reached = max(reached - words["Q"], bottom)
                if abs(reached - bottom) < 1e-6:
                    reached = bottom
                self.to_axis("feed", 2, reached)
                if reached != bottom:
                    self.to_axis("rapid", 2, top if code == 83 else min(top, reached + self.peck_clearance))
        else:
            self.to_axis("feed", 2, bottom)
        if code in (82, 89) and words.get("P", 0) > 0:
            self.events.append(Other(("dwell", words["P"])))
        self.to_axis("feed" if code in (85, 89) else "rapid", 2, clear)

    # Faces: up, across, B and C, down, and only then into the face.

    def mount(self, face, commands):
        if self.frame != IDENTITY:
            self.frame = IDENTITY
            self.to_axis("rapid", 2, self.safe_z)
        if face is None:
            if self.turn != (0.0, 0.0):
                self.go("rapid", self.here(), (0.0, 0.0))
            return
        axes = tuple(tuple(face[name]) for name in "ijk")
        first = {}
        for name, words in commands:
            if name in ("G0", "G00"):
                for axis in "XYZ":
                    first.setdefault(axis, words.get(axis)) if axis in words else None
        start = [first[axis] for axis in "XYZ"]
        point = [face["origin"][n] + sum(value * axis[n] for value, axis in zip(start, axes)) for n in range(3)]
        self.to_axis("rapid", 2, self.safe_z)
        self.go("rapid", [point[0], point[1], self.safe_z])
        k = axes[2]
        if abs(axes[1][2]) < 1e-9:
            turn = (math.degrees(math.atan2(-axes[0][2], k[2])), math.degrees(math.atan2(-axes[1][0], axes[1][1])))
        else:
            turn = (math.degrees(math.atan2(math.hypot(k[0], k[1]), k[2])), math.degrees(math.atan2(k[1], k[0])))
        turn = (0.0, 0.0) if abs(k[2] - 1) < 1e-12 else turn
        self.go("rapid", self.here(), turn)
        self.to_axis("rapid", 2, point[2])
        self.frame = (tuple(face["origin"]), axes)

    # Everything else

    def change_tool(self, number):
        if self.tool_names[number] == self.tool:
            return
        if self.frame != IDENTITY:
            self.mount(None, [])
        self.stop()
        if self.origin == (0.0, 0.0, 0.0):
            self.origin = self.origins["G54"]
        self.tool = self.tool_names[number]
        self.events.append(Other(("tool", self.tool)))
        for words in self.held:
            self.go("rapid", self.target(words)[0])
        self.held = []

    def stop(self):
        if self.direction:
            self.events.append(Other(("spindle", 5)))
            self.direction = None

    def start(self, code, speed):
        if (code, speed) == (self.direction, self.speed):
            return
        if self.direction not in (None, code):
            self.stop()
        self.speed, self.direction = speed, code
        self.events += [Other(("spindle", speed)), Other(("spindle", code))]

    def run(self, operations):
        face_before = None
        for operation in operations:
            coolant = self.coolant[operation.get("coolant", "None")]
            if coolant:
                self.events.append(Other(("m", coolant)))
            face = operation.get("face")
            moves = any(name in ("G0", "G1") for name, _ in operation["commands"])
            if face != face_before and moves:
                self.mount(face, operation["commands"])
                face_before = face
            elif moves and face and self.frame == IDENTITY:
                self.mount(face, operation["commands"])
            for name, words in operation["commands"]:
                self.command(name, words)
            if coolant:
                self.events.append(Other(("m", 9)))
        if self.frame != IDENTITY:
            self.mount(None, [])
        self.stop()
        return self.events

    def command(self, name, words):
        if name.startswith("("):
            return
        letter, code = name[0], float(name[1:])
        if letter == "M":
            if code == 6:
                self.change_tool(int(words["T"]))
            elif code in (3, 4):
                self.start(int(code), words["S"])
            elif code == 5:
                self.stop()
            else:
                self.events.append(Other(("m", int(code))))
            return
        assert letter == "G", name
        if code in (1, 2, 3) or code in (73, 81, 82, 83, 85, 89):
            self.feed = words["F"] * 60 if words.get("F") else self.feed
        if code == 0:
            if self.tool is None:
                self.held.append(words)
            else:
                self.go("rapid", *self.target(words))
        elif code == 1:
            self.go("feed", *self.target(words))
        elif code in (2, 3):
            self.arc(int(code), words)
        elif code == 4:
            self.events.append(Other(("dwell", words["P"])))
        elif code in (17, 18, 19):
            self.plane = int(code)
        elif 54 <= code < 60:
            self.origin = self.origins[name]
        elif code in (73, 81, 82, 83, 85, 89):
            self.drill(int(code), words)
        elif code in (90, 91):
            self.absolute = code == 90
        elif code in (90.1, 91.1):
            self.centers_absolute = code == 90.1
        elif code in (98, 99):
            self.initial_level = code == 98
        else:
            assert code in (21, 40, 49, 80, 94), name
