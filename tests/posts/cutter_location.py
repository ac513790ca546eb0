"""What a machine does for the steps of a case of posts/kit, as events of a trace; and the same steps as FreeCAD's commands."""

import math

COOLANT = {"flood": 8, "mist": 7, "off": 9}
NORMALS = {(0, 0, 1): 17, (0, 1, 0): 18, (1, 0, 0): 19}
WORKPIECE = {"origin": [0, 0, 0], "i": [1, 0, 0], "j": [0, 1, 0], "k": [0, 0, 1]}


class Machine:
    """Positions are machine coordinates of the tip; a frame is an affine map to them."""

    def __init__(self, origin):
        self.origin = origin
        self.frame = WORKPIECE
        self.at = [0.0] * 5
        self.turns = None
        self.speed = None
        self.events = []

    def outward(self, point):
        frame = self.frame
        return [
            self.origin[n] + frame["origin"][n] + point[0] * frame["i"][n] + point[1] * frame["j"][n] + point[2] * frame["k"][n]
            for n in range(3)
        ]

    def inward(self):
        away = [self.at[n] - self.origin[n] - self.frame["origin"][n] for n in range(3)]
        return [sum(a * b for a, b in zip(away, self.frame[axis])) for axis in "ijk"]

    def go(self, kind, point, b=None, c=None, **more):
        point = [old if new is None else new for new, old in zip(point, self.inward())]
        to = self.outward(point) + [self.at[3] if b is None else b, self.at[4] if c is None else c]
        if math.dist(to, self.at) > 1e-9 or "sweepDeg" in more:
            self.events.append({"kind": kind, "from": self.at, "to": to, **more})
        self.at = to

    def height(self, kind, z, **more):
        self.go(kind, [None, None, z], **more)

    def drill(self, step):
        top, bottom, feed = step["top"], step["bottom"], {"feed": step["feed"]}
        self.go("rapid", [*step["at"], None])
        self.height("rapid", top)
        depths = [bottom]
        if step["drill"] in ("chip", "peck"):
            count = math.ceil((top - bottom) / step["step"] - 1e-9)
            depths = [max(bottom, top - step["step"] * (n + 1)) for n in range(count)]
        for index, depth in enumerate(depths):
            if index and step["drill"] == "peck":
                self.height("rapid", depths[index - 1] + step["clearance"])
            self.height("feed", depth, **feed)
            if index + 1 < len(depths):
                self.height("rapid", top if step["drill"] == "peck" else depth + step["clearance"])
        if step["drill"] == "dwell":
            self.events.append({"kind": "dwell", "seconds": step["dwell"]})
        self.height("rapid", step["retract"])

    def step(self, step):
        if "tool" in step:
            number = step["tool"]
            self.events.append({"kind": "tool", "head": int(number[0]), "holder": int(number[1:3]), "tool": int(number[3:])})
            self.turns = None
        elif "spindle" in step:
            if step["spindle"]:
                self.events.append({"kind": "spindle", "speed": step["spindle"]})
            number = (4 if step.get("turn") == "counterclockwise" else 3) if step["spindle"] else 5
            self.events.append({"kind": "spindle", "number": number})
        elif "coolant" in step:
            self.events.append({"kind": "m", "number": COOLANT[step["coolant"]]})
        elif "dwell" in step and "drill" not in step:
            self.events.append({"kind": "dwell", "seconds": step["dwell"]})
        elif "frame" in step:
            self.frame = step["frame"] or WORKPIECE
        elif "drill" in step:
            self.drill(step)
        elif step["move"] == "arc":
            normal = [sum(n * self.frame[axis][m] for n, axis in zip(step["normal"], "ijk")) for m in range(3)]
            start, center = self.inward(), list(step["center"])
            along = step["normal"].index(1)
            center[along] = start[along]
            self.go("arc", step["to"], center=self.outward(center), normal=normal, sweepDeg=step["sweep"], feed=step["feed"])
        else:
            more = {"feed": step["feed"]} if step["move"] == "feed" else {}
            self.go(step["move"], step["to"], step.get("b"), step.get("c"), **more)


def expected_of(case):
    machine = Machine(case["origin"])
    for step in case["steps"]:
        machine.step(step)
    return machine.events


def freecad_job_of(case):
    """The steps as a job of FreeCAD, and the arguments of its post. Between faces, the post goes by itself."""
    operations, tools, frame, at = [], {}, None, [None] * 3
    clearance = 0.25
    has_faces = any(step.get("frame") for step in case["steps"])

    def add(name, **words):
        if not operations or operations[-1].get("face") != frame:
            operations.append({"label": case["name"], "commands": []} | ({"face": frame} if frame else {}))
        operations[-1]["commands"].append([name, words])

    for step in case["steps"][:-1]:  # The post itself stops the spindle at the end.
        if "tool" in step:
            number = tools.setdefault(step["tool"], len(tools) + 1)
            add("M6", T=number)
        elif "spindle" in step:
            if step["spindle"]:
                add("M4" if step.get("turn") == "counterclockwise" else "M3", S=step["spindle"])
            else:
                add("M5")
        elif "coolant" in step:
            add(f"M{COOLANT[step['coolant']]}")
        elif "frame" in step:
            frame = step["frame"]
        elif "drill" in step:
            code = {"plain": 81, "dwell": 82, "chip": 73, "peck": 83}[step["drill"]]
            words = {"Q": step["step"]} if "step" in step else {"P": step["dwell"]} if "dwell" in step else {}
            clearance = step.get("clearance", clearance)
            add("G99")
            add(f"G{code}", X=step["at"][0], Y=step["at"][1], Z=step["bottom"], R=step["top"], F=step["feed"] / 60, **words)
            add("G0", Z=step["retract"])
            at = [*step["at"], step["retract"]]
        elif "dwell" in step:
            add("G4", P=step["dwell"])
        elif step.get("approach") and has_faces:
            at = [old if new is None else new for new, old in zip(step["to"], at)]
        elif step["move"] == "arc":
            add(f"G{NORMALS[tuple(step['normal'])]}")
            along = step["normal"].index(1)
            center = {
                letter: value - start
                for n, (letter, value, start) in enumerate(zip("IJK", step["center"], at))
                if n != along
            }
            words = dict(zip("XYZ", step["to"])) | center | {"F": step["feed"] / 60}
            add("G3" if step["sweep"] > 0 else "G2", **words)
            at = step["to"]
        else:
            words = {axis: value for axis, value in zip("XYZ", step["to"]) if value is not None}
            words |= {axis.upper(): step[axis] for axis in "bc" if axis in step}
            if step["move"] == "feed":
                words["F"] = step["feed"] / 60
            add("G0" if step["move"] == "rapid" else "G1", **words)
            at = [old if new is None else new for new, old in zip(step["to"], at)]
    arguments = [f"--origin {','.join(f'{value:g}' for value in case['origin'])}", f"--peck-clearance {clearance:g}", "--safe-z 200"]
    arguments += [f"--tool {number}={name}" for name, number in tools.items()]
    return {"operations": operations}, " ".join(arguments)
