#!/usr/bin/env python3
"""Bad input: one line that names file, place and remedy, exit code 2, and the output folder as it was."""
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

program = Path(sys.argv[1]).resolve() / "formwork"
failures = []
work = Path(tempfile.mkdtemp())

# A small open cup: a square bottom and four walls, each cell two triangles.
GOOD_V = [(x, y, z) for z in (0, 0.1) for y in (0, 0.1) for x in (0, 0.1)]
GOOD_F = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]


def obj(vertices=GOOD_V, faces=GOOD_F):
    return "".join(f"v {x} {y} {z}\n" for x, y, z in vertices) + "".join("f " + " ".join(str(i + 1) for i in f) + "\n" for f in faces)


def scene(**changes):
    f = {"fixed": [{"boundary": "top"}], "plaster": {"density": 1500, "fill": {"depth_below_rim": 0}}}
    f.update(changes)
    return json.dumps({"cloths": [{"mesh": "bag.obj"}], "formwork": f}, indent=1)


def snapshot(folder):
    return {p.relative_to(folder): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def case(name, scene_text, mesh, expected, command=("run",), extra=(), mesh_name="bag.obj", field=None):
    folder = work / name.replace(" ", "_")
    (folder / "out").mkdir(parents=True)
    (folder / "out" / "summary.json").write_text('{"inflate": {"converged": true}}')
    (folder / "out" / "mine.txt").write_text("kept")
    before = snapshot(folder / "out")
    if scene_text is not None:
        (folder / "bag.json").write_text(scene_text)
    if mesh is not None:
        (folder / mesh_name).write_bytes(mesh if isinstance(mesh, bytes) else mesh.encode())
    if field is not None:
        (folder / "field.txt").write_text(field)
    arguments = [str(program), *command, str(folder / "bag.json"), *extra]
    if command[0] != "check":
        arguments += ["-o", str(folder / "out")]
    run = subprocess.run(arguments, capture_output=True, text=True, timeout=600)
    errors = [line for line in run.stderr.splitlines() if line.startswith("formwork: ")]
    if run.returncode != 2:
        failures.append(f"{name}: exit code {run.returncode}, expected 2; stderr: {run.stderr}")
    elif len(errors) != 1:
        failures.append(f"{name}: expected one error line, got: {run.stderr}")
    else:
        for words in expected:
            if words not in errors[0]:
                failures.append(f"{name}: expected \"{words}\" in: {errors[0]}")
    if snapshot(folder / "out") != before:
        failures.append(f"{name}: the output folder was changed")


case("missing scene", None, obj(), ["bag.json", "No such file", "Check the name"])
case("missing mesh", scene(), None, ["bag.json:4:", "/cloths/0/mesh", "no file \"bag.obj\""])
case("malformed JSON", scene().replace('"plaster":', '"plaster"'), obj(), ["bag.json:", "not valid JSON"])
case("trailing comma", scene().rstrip()[:-1] + ",}", obj(), ["bag.json:", "remove the comma before this }"])
case("missing comma", scene().replace('],\n  "plaster"', ']\n  "plaster"'), obj(), ["bag.json:", "a comma or colon is missing"])
case("single quotes", scene().replace('"', "'"), obj(), ["bag.json:", "double quotes"])
case("text that ends", scene()[:-3], obj(), ["bag.json:", "still open"])
case("empty scene", "// nothing\n", obj(), ["bag.json:", "the file is empty"])
case("number without end", scene().replace("1500", "1e999"), obj(), ["bag.json:", "too large"])
case("key of another object", scene(density=1500), obj(), ["/formwork/density", "exists at", "/formwork/plaster/density"])
case("unknown key", scene(plastre={}), obj(), ["/formwork/plastre", "is not a known key", "Did you mean \"plaster\""])
case("wrong type", scene(up=[0, 0]), obj(), ["/formwork/up", "three numbers"])
case("out of range", scene(plaster={"density": -1, "fill": {"level": 0}}), obj(), ["/formwork/plaster/density", "expected a number >= 0 (kg/m³), got -1"])
case("two fills", scene(plaster={"density": 1500, "fill": {"level": 0, "volume": 1}}), obj(), ["/formwork/plaster/fill", "exactly one of"])
case("no plaster", scene(plaster=None), obj(), ["/formwork/plaster is missing", "Add"])
case("empty mesh", scene(), "# nothing\n", ["bag.obj", "face"])
case("index out of range", scene(), obj(faces=[(0, 1, 99)]), ["bag.obj:9", "100"])
case("nonmanifold edge", scene(), obj(GOOD_V + [(0.05, 0.05, 0.05)], GOOD_F + [(0, 3, 8)]), ["bag.obj", "edge", "three"])
case("inconsistent orientation", scene(), obj(faces=[(0, 3, 2), *GOOD_F[1:]]), ["bag.obj", "oriented"])
case("zero area face", scene(), obj(GOOD_V + [(0.05, 0, 0.1)], [*GOOD_F[:3], (0, 5, 8), (0, 8, 4), *GOOD_F[4:], (4, 8, 5)]), ["bag.obj", "has no area"])
case("no held vertex", scene(fixed=[]), obj(), ["/formwork/fixed", "no node is held"])
case("selector holds nothing", scene(fixed=[{"sphere": {"center": [9, 9, 9], "radius": 0.1}}]), obj(), ["/formwork/fixed/0", "holds no node"])
case("unknown group", scene(fixed=[{"group": "rim"}]), obj(), ["/formwork/fixed/0/group", "no group \"rim\""])
case("no such loop", scene(fixed=[{"boundary": 3}]), obj(), ["/formwork/fixed/0/boundary", "there is no loop 3"])
case("NaN in the mesh", scene(), obj().replace("v 0.1 0 0\n", "v nan 0 0\n"), ["bag.obj:2"])
case("NaN in the scene", scene().replace("1500", "NaN"), obj(), ["bag.json:", "not valid JSON"])
case("millimetres read as metres", scene(), obj([(1000 * x, 1000 * y, 1000 * z) for x, y, z in GOOD_V]), ["bag.obj", "100 m large", "/formwork/units"])
case("metres read as millimetres", scene(units="mm"), obj(), ["bag.obj", "0.0001 m large", "/formwork/units"])
case("truncated STL", scene().replace("bag.obj", "bag.stl"), b"\0" * 80 + struct.pack("<I", 7) + b"\0" * 60, ["bag.stl", "cut short"], mesh_name="bag.stl")
case("broken PLY", scene().replace("bag.obj", "bag.ply"), "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\nabc\n", ["bag.ply:6", "not a number"], mesh_name="bag.ply")
case("unknown format", scene().replace("bag.obj", "bag.3dm"), "x", ["bag.3dm", "OBJ, PLY or STL"], mesh_name="bag.3dm")
case("endless word", scene(), "v " + "1" * 100000 + " 0 0\n" + obj(), ["bag.obj:1", "1111… is not a finite number"])
case("huge index", scene(), obj().replace("f 1 3 4", "f 1 3 99999999999999999999"), ["bag.obj:9", "expected the index of a node"])
case("folder as mesh", scene().replace("bag.obj", "out"), obj(), ["/cloths/0/mesh", "\"out\" is a folder"])
case("LFS pointer", scene(), "version https://git-lfs.github.com/spec/v1\n", ["bag.obj", "git lfs pull"])
case("bad override", scene(), obj(), ["--set nonsense", "KEY=VALUE"], extra=("--set", "nonsense"))
case("override of unknown key", scene(), obj(), ["--set plaster.densty=1", "Did you mean \"density\""], extra=("--set", "plaster.densty=1"))
case("unknown stage", scene(), obj(), ["\"segmnt\" is not a stage", "segment"], extra=("--from", "segmnt"))
case("stage without its files", scene(), obj(), ["is missing", "Run the stages before it"], extra=("--from", "panels"))
case("obstacles", json.dumps({"cloths": [{"mesh": "bag.obj"}], "obstacles": [{"mesh": "bag.obj"}], "formwork": {}}), obj(), ["obstacles"])
case("check finds it too", scene(), obj(faces=[(0, 3, 2), *GOOD_F[1:]]), ["bag.obj", "oriented"], command=("check",))
ALONE = {"segment": {"field": "field.txt"}}   # `formwork segment` on a mesh and a field, without plaster
LINES = ["0.1 1.2 1.0\n"] * len(GOOD_F)
SHIFTED = [(x + 1, y, z) for x, y, z in GOOD_V]
for name, mesh, lines, words in [
        ("field of wrong length", obj(), LINES[:-1], ["field.txt", "9", "10"]),
        ("field with NaN", obj(), [*LINES[:3], "nan 1.2 1.0\n", *LINES[4:]], ["field.txt:4"]),
        ("field on two components", obj(GOOD_V + SHIFTED, GOOD_F + [tuple(i + 8 for i in f) for f in GOOD_F]), LINES * 2, ["2 components"]),
        ("field on a vertex without faces", obj(GOOD_V + [(0.05, 0.05, 0.05)]), LINES, ["bag.obj", "1 vertex belongs to no face", "Remove"]),
        ("field on a nonmanifold edge", obj(GOOD_V + [(0.05, 0.05, 0.05)], GOOD_F + [(0, 3, 8)]), [*LINES, LINES[0]], ["bag.obj", "edge", "three"])]:
    case(name, json.dumps({"cloths": [{"mesh": "bag.obj"}], "formwork": ALONE}), mesh, words, command=("segment",), field="".join(lines))
case("closed mesh", scene(), obj(faces=GOOD_F + [(4, 5, 7), (4, 7, 6)]), ["/formwork/fixed/0/boundary", "closed"])



def said(arguments, expected):
    """Slips in the command itself, and doubts about values that are legal."""
    run = subprocess.run([str(program), *arguments], capture_output=True, text=True, timeout=600, cwd=work)
    for words in expected:
        if words not in run.stdout + run.stderr:
            failures.append(f"{arguments}: expected \"{words}\" in: {run.stdout[-300:]}{run.stderr}")


(work / "bag.obj").write_text(obj())
(work / "light.json").write_text(scene(plaster={"density": 1.5, "fill": {"level": 235}}))
(work / "lying.json").write_text(scene(up="y"))
said(["rn", "bag.json"], ["\"rn\" is not a command", "Did you mean \"run\""])
said(["run", "bag.json", "--form", "sew"], ["--form is not an option", "Did you mean \"--from\""])
said([], ["give a command", "inflate"])
said(["check", "light.json", "-q"], ["1.5 kg/m³ is very light", "far above the bag"])
said(["check", "lying.json", "-q"], ["the opening looks sideways", "set \"up\": \"z\""])

for failure in failures:
    print(failure)
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
