#!/usr/bin/env python3
"""Holds volumes that isorun removes against closed forms, and its time against FreeCAD's simulator of milling.

Slots in eight directions have the volume (pi r^2 + 2 r L) d. FreeCAD's PathSimulator (Debian package freecad-python3) cuts
the same ones, and the same moves as isorun; without it, its columns stay empty. Its time is that of cutting alone, isorun's
that of the whole process. Prints Markdown tables. Exit status: 0 every target met, 1 some missed, 2 could not measure.
"""

import argparse
import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import editor
import material
from compare import CannotMeasure, run

RADIUS = 10
LENGTH = 100
DEPTH = 5
SIDE = 160  # Of the square blank of a slot, mm.
THICKNESS = 18
RETRACTED = 40
DIRECTIONS = 8
LARGEST_ERROR = {0.5: 0.003, 0.1: 0.0003}  # By the spacing.
FREECAD = ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/Mod", "/usr/share/freecad/Mod"]


def slot(number):
    """The ends of a slot, away from where dexels and directions would fit by chance."""
    angle = math.pi * number / DIRECTIONS + 0.05
    x, y = LENGTH / 2 * math.cos(angle), LENGTH / 2 * math.sin(angle)
    middle = SIDE / 2 + 0.17
    return [[round(middle + sign * x, 3), round(middle + sign * y, 3)] for sign in (-1, 1)]


def slot_moves(number):
    (x0, y0), (x1, y1) = slot(number)
    return [["G0", x0, y0, RETRACTED], ["G1", x0, y0, -DEPTH], ["G1", x1, y1, -DEPTH], ["G0", x1, y1, RETRACTED]]


def slot_program(number):
    (x0, y0), (x1, y1) = slot(number)
    lines = ["M06 T101001", "S12000 M03", f"G00 X{x0} Y{y0} Z{RETRACTED}", f"G01 Z-{DEPTH} F1000", f"X{x1} Y{y1}"]
    return "\n".join([*lines, f"G00 Z{RETRACTED}", "M05", "M02", ""]).encode()


def moves_of(program):
    """The moves of a program that has nothing but X, Y, Z and the modal G00 and G01."""
    g, at, moves = "G0", {"X": 0.0, "Y": 0.0, "Z": float(RETRACTED)}, []
    for line in program.decode().splitlines():
        words = line.split()
        if not words or words[0][0] in "(MS":
            continue
        for word in words:
            if word[0] == "G":
                g = f"G{int(word[1:])}"
            elif word[0] in at:
                at[word[0]] = float(word[1:])
        moves.append([g, at["X"], at["Y"], at["Z"]])
    return moves


def cut_with_freecad():
    """In a process of its own: jobs from standard input, what each removes and takes to standard output."""
    import time

    sys.path += FREECAD
    import FreeCAD
    import Part
    import Path as FreeCadPath
    import PathSimulator

    def left_of(simulation):
        """The mesh is in two parts, which together enclose the volume."""
        volume = 0
        for mesh in simulation.GetResultMesh():
            points, facets = mesh.Topology
            volume += sum(points[i].dot(points[j].cross(points[k])) for i, j, k in facets) / 6
        return volume

    def cut(job):
        simulation = PathSimulator.PathSim()
        simulation.BeginSimulation(Part.makeBox(*job["blank"], THICKNESS), job["spacing"])
        simulation.SetToolShape(Part.makeCylinder(RADIUS, 50), job["spacing"] / 20)
        blank = left_of(simulation)
        commands = [FreeCadPath.Command(g, {"X": x, "Y": y, "Z": z + THICKNESS}) for g, x, y, z in job["moves"]]
        at = FreeCAD.Placement(FreeCAD.Vector(0, 0, RETRACTED + THICKNESS), FreeCAD.Rotation())
        begin = time.process_time()
        for command in commands:
            at = simulation.ApplyCommand(at, command)
        seconds = time.process_time() - begin
        return {"volume": blank - left_of(simulation), "seconds": seconds}

    print(json.dumps([cut(job) for job in json.load(sys.stdin)]))


def freecad(jobs):
    """What FreeCAD makes of them; None without it."""
    if not (Path(FREECAD[0]) / "PathSimulator.so").exists():
        return None
    peer = subprocess.run([sys.executable, __file__, "--freecad"], input=json.dumps(jobs), capture_output=True, text=True, check=False)
    if peer.returncode != 0:
        raise CannotMeasure(f"FreeCAD: {peer.stderr.strip().splitlines()[-1:]}")
    return json.loads(peer.stdout.splitlines()[-1])


def written(folder, name, program, blank, spacing):
    """The command that runs a program in a blank of its own."""
    at = Path(folder) / name
    at.mkdir()
    case = material.Case(name, "", material.FLAT_10, blank, spacing, 0)
    (at / "isocnc.json").write_text(json.dumps(material.configuration(case)))
    (at / "program.iso").write_bytes(program)
    return [str(at / "program.iso")]


def errors_text(errors):
    mean = statistics.fmean(errors)
    return f"{100 * max(map(abs, errors)):.3f} % at most, {100 * mean:+.3f} % in the mean"


def measure_volumes(isorun, folder):
    exact = (math.pi * RADIUS**2 + 2 * RADIUS * LENGTH) * DEPTH
    print(f"\n{DIRECTIONS} slots of {LENGTH} mm, radius {RADIUS} mm, {DEPTH} mm deep\n")
    print("| spacing | isorun, error of the volume | target | met | FreeCAD |\n|---|---|---|---|---|")
    are_met = True
    for spacing, limit in LARGEST_ERROR.items():
        errors = []
        for i in range(DIRECTIONS):
            file = written(folder, f"slot {spacing} {i}", slot_program(i), [SIDE, SIDE], spacing)
            output = subprocess.run([*isorun, "--json", *file], capture_output=True, text=True, check=True)
            errors.append(json.loads(output.stdout)["verification"]["removedVolume"] / exact - 1)
        peer = freecad([{"blank": [SIDE, SIDE], "spacing": spacing, "moves": slot_moves(i)} for i in range(DIRECTIONS)])
        beside = errors_text([each["volume"] / exact - 1 for each in peer]) if peer else "not installed"
        is_met = max(map(abs, errors)) <= limit
        are_met &= is_met
        print(f"| {spacing} mm | {errors_text(errors)} | {100 * limit:g} % | {'yes' if is_met else '**no**'} | {beside} |", flush=True)
    return are_met


def measure_times(build, isorun, folder, lines):
    print(f"\n{lines:,} moves of 1 mm, radius {RADIUS} mm, processor time\n")
    print("| blank | spacing | isorun, the whole run | FreeCAD, cutting alone | ratio | target | met |\n|---|---|---|---|---|---|---|")
    are_met = True
    for kind, side, spacing in (("walk", 1000, 0.5), ("walk-narrow", 250, 0.1)):
        program = editor.corpus(build, kind, lines)
        file = written(folder, kind, program, [side, side], spacing)
        ours = statistics.median(run([*isorun, *file]).cpu for _ in range(3))
        peer = freecad([{"blank": [side, side], "spacing": spacing, "moves": moves_of(program)}])
        if not peer:
            print(f"| {side} x {side} mm | {spacing} mm | {ours:.2f} s | not installed | | | |", flush=True)
            continue
        theirs = peer[0]["seconds"]
        is_met = ours <= theirs
        are_met &= is_met
        print(f"| {side} x {side} mm | {spacing} mm | {ours:.2f} s | {theirs:.2f} s | {ours / theirs:.2f} | at most 1 | {'yes' if is_met else '**no**'} |", flush=True)
    return are_met


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=editor.BUILD, help="the build to measure")
    parser.add_argument("--lines", type=int, default=100_000, help="moves of the programs that are timed")
    options = parser.parse_args()
    isorun = [str(options.build / "bin/isorun"), "--verify"]
    with tempfile.TemporaryDirectory() as folder:
        are_right = measure_volumes(isorun, folder)
        return measure_times(options.build, isorun, folder, options.lines) and are_right


if __name__ == "__main__":
    if sys.argv[1:] == ["--freecad"]:
        cut_with_freecad()
    else:
        editor.run("voxels.py", main)
