"""Makes jobs with FreeCAD, posts them, and keeps the commands that FreeCAD computed: freecad_test.py runs it by freecadcmd.

The environment variable POSTS_JOBS names the folder to write to: JOB.json with the commands, JOB.iso as posted from
FreeCAD's own objects; POSTS_FREECAD names that of the post.
"""

import json
import os
import sys
import traceback
from pathlib import Path as File

import FreeCAD
import Part
import Path
from FreeCAD import Rotation, Vector
from PathScripts import (
    PathCustom,
    PathDressupHoldingTags,
    PathDressupRampEntry,
    PathDrilling,
    PathEngrave,
    PathHelix,
    PathJob,
    PathPocketShape,
    PathPost,
    PathPostProcessor,
    PathProfile,
)

ARGUMENTS = {
    "faces": "--all-jobs --origin 600,450,-380 --head 1 --holder 2 --safe-z 250 --no-show-editor --no-header",
    "drilling": "--origin 350,220,-180 --tool 12=103012 --no-show-editor --no-header",
    "surface": "--origin 350,220,-180 --tool 4=103004 --no-show-editor --no-header",
}
USUAL = "--origin 350,220,-180 --head 1 --holder 1 --no-show-editor --no-header"


def new_job(shape, name, tool=1, feeds=(1800, 600), speed=16000):
    document = FreeCAD.ActiveDocument
    body = document.addObject("Part::Feature", "Body" + name)
    body.Shape = shape
    document.recompute()
    job = PathJob.Create(name, [body])
    document.recompute()
    set_tool(job.Tools.Group[0], tool, feeds, speed)
    document.recompute()
    return job


def set_tool(controller, number, feeds, speed):
    controller.ToolNumber = number
    controller.HorizFeed, controller.VertFeed = (f"{feed} mm/min" for feed in feeds)
    controller.SpindleSpeed, controller.SpindleDir = speed, "Forward"


def face_at(job, matches):
    model = job.Model.Group[0]
    return (model, [f"Face{index}" for index, face in enumerate(model.Shape.Faces, 1) if matches(face)])


def level(z):
    return lambda face: isinstance(face.Surface, Part.Plane) and abs(face.BoundBox.ZMax - z) + abs(face.BoundBox.ZMin - z) < 1e-6


def cylinder(radius, depth, x, y, z):
    return Part.makeCylinder(radius, depth, Vector(x, y, z))


def make_pocket():
    job = new_job(Part.makeBox(90, 70, 20).cut(Part.makeBox(50, 34, 8, Vector(20, 18, 12))).cut(cylinder(6, 8, 70, 35, 12)), "Pocket")
    pocket = PathPocketShape.Create("Pocket (rough)")
    pocket.Base = [face_at(job, level(12))]
    pocket.CoolantMode = "Flood"
    return [job]


def make_profile():
    plate = Part.makeBox(100, 60, 12)
    plate = plate.makeFillet(8, [edge for edge in plate.Edges if abs(edge.Length - 12) < 1e-6])
    job = new_job(plate, "Profile", tool=2)
    profile = PathProfile.Create("Profile")
    FreeCAD.ActiveDocument.recompute()
    tags = PathDressupHoldingTags.Create(profile, "Tags")
    tags.Height = 3
    tags.Width = 8
    job.Operations.Group = [tags]
    return [job]


def make_drilling():
    shape = Part.makeBox(120, 60, 25)
    for x, y, radius in ((15, 15, 2.5), (105, 15, 2.5), (15, 45, 2.5), (105, 45, 2.5), (60, 30, 2.5)):
        shape = shape.cut(cylinder(radius, 40, x, y, -5))
    job = new_job(shape, "Drilling", tool=12, speed=4500)
    PathDrilling.Create("Drill")
    FreeCAD.ActiveDocument.recompute()
    dwell = PathDrilling.Create("Dwell")
    dwell.DwellEnabled, dwell.DwellTime, dwell.ReturnLevel = True, 0.5, "G99"
    peck = PathDrilling.Create("Peck")
    peck.PeckEnabled, peck.PeckDepth = True, "7 mm"
    return [job]


def make_helix():
    job = new_job(Part.makeBox(80, 60, 20).cut(cylinder(9, 30, 25, 30, -5)).cut(cylinder(14, 12, 58, 30, 8)), "Helix", tool=3)
    helix = PathHelix.Create("Helix")
    helix.CoolantMode = "Mist"
    return [job]


def make_ramp():
    """A contour whose ways down are helices."""
    plate = Part.makeBox(80, 50, 10)
    plate = plate.makeFillet(12, [edge for edge in plate.Edges if abs(edge.Length - 10) < 1e-6])
    job = new_job(plate, "Ramp", tool=6)
    profile = PathProfile.Create("Profile")
    FreeCAD.ActiveDocument.recompute()
    ramp = FreeCAD.ActiveDocument.addObject("Path::FeaturePython", "RampEntryDressup")
    dressup = PathDressupRampEntry.ObjectDressup(ramp)
    job.Proxy.addOperation(ramp, profile)
    ramp.Base = profile
    dressup.setup(ramp)
    ramp.Method, ramp.Angle = "Helix", 6
    job.Operations.Group = [ramp]
    return [job]


def make_surface():
    """A barrel, whose sections FreeCAD cuts and turns into a path: PathSurface takes OpenCAMLib, which Debian has not."""
    barrel = Part.makeCylinder(60, 80, Vector(40, 0, -40), Vector(0, 1, 0))
    job = new_job(Part.makeBox(80, 80, 30).common(barrel), "Surface", tool=4, feeds=(2400, 500))
    top = max(job.Model.Group[0].Shape.Faces, key=lambda face: face.Area if isinstance(face.Surface, Part.Cylinder) else 0)
    wires = []
    for index in range(9):
        edges = top.slice(Vector(0.1, 1, 0).normalize(), 8.0 + 8.0 * index)
        wires += [wire for wire in edges if wire.Length > 5]
    path = Path.fromShapes(wires, feedrate=40, feedrate_v=10, resume_height=35, retraction=40, preamble=False, return_end=False)
    FreeCAD.ActiveDocument.recompute()
    custom = PathCustom.Create("Surface")
    custom.Gcode = path.toGCode().splitlines()
    return [job]


def make_engraving():
    job = new_job(Part.makeBox(70, 40, 10), "Engraving", tool=5, speed=18000)
    document = FreeCAD.ActiveDocument
    outline = Part.makePolygon([Vector(10, 10, 10), Vector(25, 30, 10), Vector(40, 10, 10)])
    arc = Part.Arc(Vector(45, 12, 10), Vector(55, 30, 10), Vector(62, 14, 10)).toShape()
    curve = Part.BSplineCurve()
    curve.interpolate([Vector(10, 33, 10), Vector(30, 36, 10), Vector(45, 32, 10), Vector(60, 37, 10)])
    drawn = document.addObject("Part::Feature", "Drawn")
    drawn.Shape = Part.makeCompound([outline, Part.Wire(arc), Part.Wire(curve.toShape())])
    engrave = PathEngrave.Create("Engrave")
    engrave.BaseShapes = [drawn]
    document.recompute()
    engrave.StartDepth, engrave.FinalDepth = 10, 9.5
    engrave.setExpression("StartDepth", None)
    engrave.setExpression("FinalDepth", None)
    engrave.StartDepth, engrave.FinalDepth = 10, 9.5
    return [job]


def make_faces():
    """A block with a pocket on top and one in its front: the second job's model is turned so that the front looks up."""
    shape = Part.makeBox(120, 80, 60).cut(Part.makeBox(60, 30, 6, Vector(30, 25, 54))).cut(Part.makeBox(70, 5, 24, Vector(25, 0, 18)))
    top = new_job(shape, "Top", tool=1)
    pocket = PathPocketShape.Create("Pocket on top")
    pocket.Base = [face_at(top, level(54))]
    FreeCAD.ActiveDocument.recompute()
    front = new_job(shape, "Front", tool=2)
    model = front.Model.Group[0]
    # The front, y = 0, becomes the upper side: y of the block goes down, z of the block goes along y.
    model.Placement = FreeCAD.Placement(Vector(0, 0, 80), Rotation(Vector(1, 0, 0), -90))
    front.Stock.Placement = FreeCAD.Placement()
    FreeCAD.ActiveDocument.recompute()
    hole = PathPocketShape.Create("Pocket in front", parentJob=front)
    hole.Base = [face_at(front, level(75))]
    return [top, front]


def face_of(place):
    axes = [list(place.Rotation.multVec(Vector(*axis))) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return {"origin": list(place.Base), "i": axes[0], "j": axes[1], "k": axes[2]}


def objects_of(job, jobs):
    """In the order in which FreeCAD posts them; the post itself lists those of several jobs."""
    if len(jobs) > 1:
        return [job.Tools.Group[0], *job.Operations.Group]
    (objects,) = PathPost.CommandPathPost().buildPostList(job)
    return objects


def kept(jobs):
    """A text with a command on each line."""
    operations = []
    if len(jobs) > 1:
        (fixture,) = jobs[0].Fixtures
        above = jobs[0].Stock.Shape.BoundBox.ZMax + jobs[0].SetupSheet.ClearanceHeightOffset.Value
        operations.append(json.dumps({"label": fixture, "commands": [[fixture, {}], ["G0", {"Z": above}]]}))
    for job in jobs:
        face = None
        if job is not jobs[0]:
            face = face_of(jobs[0].Model.Group[0].Placement.multiply(job.Model.Group[0].Placement.inverse()))
        for item in objects_of(job, jobs):
            coolant = getattr(item, "CoolantMode", None) or getattr(getattr(item, "Base", None), "CoolantMode", "None")
            head = {"label": item.Label, "coolant": coolant} | ({"face": face} if face else {})
            commands = [json.dumps([each.Name, dict(sorted(each.Parameters.items()))]) for each in item.Path.Commands]
            operations.append(json.dumps(head)[:-1] + ', "commands": [\n' + ",\n".join(commands) + "]}")
    return "[\n" + ",\n".join(operations) + "]"


def make(name, folder, post):
    document = FreeCAD.newDocument(name)
    jobs = globals()["make_" + name]()
    document.recompute()
    for job in jobs:
        assert job.Operations.Group, f"{name} has no operation"
    arguments = ARGUMENTS.get(name, USUAL)
    post.export(objects_of(jobs[0], jobs), str(folder / f"{name}.iso"), arguments)
    if len(jobs) == 1:
        post.export(jobs, str(folder / f"{name}.job.iso"), arguments)
    version = ".".join(FreeCAD.Version()[:2]) + "." + FreeCAD.Version()[2].split()[0]
    head = {"made": f"by FreeCAD {version}, tests/posts/freecad_jobs.py", "arguments": arguments}
    (folder / f"{name}.json").write_text(json.dumps(head)[:-1] + ', "operations": ' + kept(jobs) + "}\n")
    FreeCAD.closeDocument(document.Name)


def main():
    folder = File(os.environ["POSTS_JOBS"])
    sys.path.insert(0, os.environ["POSTS_FREECAD"])
    post = PathPostProcessor.PostProcessor.load("isocnc")
    assert (post.units, post.machineName) == ("Metric", "ISOCNC") and "--origin" in post.tooltipArgs
    names = sorted(name.removeprefix("make_") for name in globals() if name.startswith("make_"))
    for name in names:
        make(name, folder, post)
    (folder / "done").write_text(" ".join(names))


try:
    main()
except BaseException:  # freecadcmd would go on with its prompt.
    traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(1)
os._exit(0)
