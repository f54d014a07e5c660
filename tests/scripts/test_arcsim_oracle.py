#!/usr/bin/env python3
"""`arcsim` on scenes that nobody stored, against a second program (arcsim_oracle.py): the same digits.

The scenes put together what the stored ones do not: two materials, a seam whose sides differ in length, damaged faces,
rest angles, damping, drag, motions with given and with guessed rates, handles by label, on a circle, of glue, that start,
end and fade, creases that are kept, and the old style of giving the step.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import arcsim_oracle

build = Path(sys.argv[1])


def two_panels(seed, columns=5, rows=4, size=0.02):
    """Two panels, joined along the middle column, whose seam is 3 % longer on the right; jittered, bent, labelled."""
    random = np.random.default_rng(seed)
    jitter = lambda: size * 0.15 * random.uniform(-1, 1, 2)
    middle = columns // 2
    flat = np.array([np.array([size * i, size * j]) + (jitter() if 0 < i < columns - 1 and 0 < j < rows - 1 else 0) for j in range(rows) for i in range(columns)])
    x = np.array([[p[0], p[1], 0.25 * p[0] ** 2 / size * 0.2 + 0.02 * size * random.uniform(-1, 1)] for p in flat])
    vt = [p for p in flat] + [p * [1, 1.03] for p in flat[middle::columns]]
    vert = lambda i, j, right: len(flat) + j if right and i == middle else j * columns + i
    faces, labels = [], []
    for j in range(rows - 1):
        for i in range(columns - 1):
            right = i >= middle
            c = [((j + dj) * columns + i + di, vert(i + di, j + dj, right)) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces += [[c[0], c[1], c[2]], [c[0], c[2], c[3]]] if (i + j) % 2 else [[c[0], c[1], c[3]], [c[1], c[2], c[3]]]
            labels += [int(right)] * 2
    label = [7 if i < columns else 3 if i >= columns * (rows - 1) else 0 for i in range(len(flat))]
    vert_of, edges = {}, {}
    for f in faces:
        for a, b in zip(f, f[1:] + f[:1]):
            vert_of.setdefault(a[0], a[1])
            edges.setdefault(tuple(sorted((a[0], b[0]))), (a, b))
    rest = {tuple(sorted((columns + 1, columns + 2))): 0.3}
    return dict(vt=np.array(vt), x=x, faces=faces, labels=labels, node_label=label, damage=[0.5 * (k % 3) for k in range(len(faces))],
                rest_angle=rest, vert_of=vert_of, edges=list(edges.values()))


def write_mesh(path, m):
    with open(path, "w") as out:
        for p in m["vt"]:
            out.write("vt %.17g %.17g\n" % tuple(p))
        for p, label in zip(m["x"], m["node_label"]):
            out.write("v %.17g %.17g %.17g\n" % tuple(p) + (f"nl {label}\n" if label else ""))
        for (a, b), angle in m["rest_angle"].items():
            out.write(f"e {a + 1} {b + 1}\nea {angle!r}\n")
        for f, label, damage in zip(m["faces"], m["labels"], m["damage"]):
            out.write("f " + " ".join(f"{n + 1}/{t + 1}" for n, t in f) + f"\ntl {label}\ntd {damage}\n")


SOFT = {"density": 0.15, "stretching": [[300, 20, 250, 40], [600, 10, 500, 60], [550, 30, 450, 90], [400, 40, 420, 120], [450, 25, 600, 80], [500, 15, 700, 70]],
        "bending": [[1e-5, 2e-5, 3e-5, 3e-5, 4e-5], [2e-5, 1e-5, 4e-5, 5e-5, 5e-5], [3e-5, 3e-5, 2e-5, 6e-5, 7e-5]]}
STIFF = {"density": 0.4, "stretching": [[8000, 300, 12000, 900], [30000, -50, 60000, 2500], [20000, 900, 40000, 7000], [18000, 700, 26000, 4000], [40000, 500, 38000, 2500], [42000, 800, 55000, 6000]],
         "bending": [[4e-5, 2e-5, 1e-5, 1e-5, 1e-5], [1e-5] * 5, [5e-5, 6e-5, 8e-5, 9e-5, 9e-5]]}
OFF = ["proximity", "strainlimiting", "collision", "remeshing", "separation", "popfilter", "plasticity"]


def scenes():
    base = {"frame_time": 0.04, "frame_steps": 8, "end_frame": 4, "gravity": [0.5, -1, -9.81], "disable": OFF, "motions": [], "handles": []}
    cloth = {"mesh": "mesh.obj", "transform": {"translate": [0.1, -0.2, 0.3], "scale": 1.5, "rotate": [35, 1, 2, 0.5]},
             "velocity": {"linear": [0.2, 0.1, -0.1], "angular": [1, -2, 3], "origin": [0.1, -0.2, 0.3]}}
    materials = [{"data": "soft.json", "density_mult": 1.2, "stretching_mult": 0.8, "bending_mult": 2, "damping": 0.002, "weakening": 0.7},
                 {"data": "stiff.json", "thicken": 1.3, "damping": 0.002, "weakening": 0.2}]
    turn = [{"time": 0}, {"time": 0.06, "transform": {"translate": [0.01, 0, 0.005], "rotate": [20, 0, 1, 0]}},
            {"time": 0.11, "transform": {"translate": [0.02, 0.01, 0], "scale": 1.1, "rotate": [40, 0, 1, 0.2]}}]
    push = [{"time": 0.01, "velocity": {"translate": [0.3, 0, 0]}}, {"time": 0.12, "transform": {"translate": [0, 0.01, 0]}, "velocity": {"scale": 0.5}}]
    yield "free flight in wind with drag", {**base, "cloths": [{**cloth, "materials": materials}], "magic": {"handle_stiffness": 1e3},
                                            "wind": {"density": 1.3, "velocity": [3, -1, 2], "drag": 0.4}}
    yield "held by label, moved with guessed and given rates, in still air", {
        **base, "cloths": [{**cloth, "materials": materials}], "magic": {"handle_stiffness": 2e3}, "motions": [turn, push],
        "handles": [{"label": 3, "motion": 0}, {"nodes": [0, 2], "motion": 1, "start_time": 0.03, "end_time": 0.09, "fade_time": 0.05}]}
    yield "on a circle and glued, in vacuum", {
        **base, "cloths": [{**cloth, "materials": materials[::-1]}], "magic": {"handle_stiffness": 40}, "wind": {"density": 0},
        "handles": [{"type": "circle", "label": 7, "circumference": 0.4, "u": [1, 0.1], "center": [0.1, -0.2, 0.3], "axis0": [1, 0, 0], "axis1": [0, 0, 1]},
                    {"type": "glue", "nodes": [15, 19], "end_time": 0.1, "fade_time": 0.03}]}
    old = {k: v for k, v in base.items() if k not in ("frame_time", "frame_steps", "end_frame")}
    yield "creases kept, the step given in the old style", {
        **old, "timestep": 0.004, "save_frames": 5, "duration": 0.08, "cloths": [{**cloth, "materials": materials}],
        "magic": {"handle_stiffness": 1e3, "preserve_creases": True}, "handles": [{"label": 7}]}


def read_nodes(path):
    return np.array([line.split()[1:4] for line in path.read_text().splitlines() if line.startswith("v ")], float)


worst = 0.0
with tempfile.TemporaryDirectory() as name:
    for number, (what, scene) in enumerate(scenes()):
        folder = Path(name) / str(number)
        folder.mkdir()
        mesh = two_panels(number)
        write_mesh(folder / "mesh.obj", mesh)
        for file, data in (("soft.json", SOFT), ("stiff.json", STIFF)):
            (folder / file).write_text(json.dumps(data))
        (folder / "scene.json").write_text(json.dumps(scene))
        expected = arcsim_oracle.run(scene, mesh, {"soft.json": SOFT, "stiff.json": STIFF})
        done = subprocess.run([str(build / "arcsim"), str(folder / "scene.json"), str(folder / "out"), "--quiet"], capture_output=True, text=True)
        if done.returncode != 0:
            print(done.stderr)
            sys.exit(1)
        for frame, x in enumerate(expected):
            difference = np.abs(read_nodes(folder / "out" / f"{frame:04d}_00.obj") - x).max()
            moved = np.abs(x - expected[0]).max()
            worst = max(worst, difference)
            print(f"{what}: frame {frame}: moved {moved:.3g} m, difference {difference:.2g} m")
if worst > 1e-9:
    print(f"largest difference {worst:.3g} m, allowed 1e-9")
    sys.exit(1)
