#!/usr/bin/env python3
"""The sewn bag runs in `arcsim` as a plain cloth: sewn_rest.obj with the woven fabric, its rim held, under its own weight.

The flat panels are its rest shape there too, the first frame is the surface that was cut, relaxed as ArcSim does before
frame 0 (panels of a coarse mesh do not lie flat without stretch), and `formwork compare` reads the folders: two runs with equal steps are equal, a run with half the step is close to them, and a tolerance below that is
reported by exit code 1.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parents[2]
build = Path(sys.argv[1])
failures = []


def check(fact, what):
    if not fact:
        failures.append(what)


def run(*command, code=0):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != code:
        failures.append(f"{' '.join(map(str, command))}: exit code {done.returncode}, expected {code}\n{done.stderr[-2000:]}")
    return done


def read_obj(path):
    nodes, flat, faces = [], [], []
    for line in path.read_text().splitlines():
        key, *rest = line.split() or [""]
        if key == "v":
            nodes.append(tuple(map(float, rest[:3])))
        elif key == "vt":
            flat.append(tuple(map(float, rest[:2])))
        elif key == "f":
            faces.append([tuple(int(i) - 1 for i in corner.split("/")[:2]) for corner in rest])
    return nodes, flat, faces


def edges_of(faces):
    """Squared flat lengths per face: what the cloth's rest shape is."""
    return [[(u[a][0] - u[b][0]) ** 2 + (u[a][1] - u[b][1]) ** 2 for a, b in ((0, 1), (1, 2), (2, 0))] for u in faces]


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    run(build / "formwork", "mesh", "column", "--height", "0.12", "--bottom-radius", "0.03", "--top-radius", "0.04", "--edge", "0.012",
        "-o", folder / "bag.obj")
    scene = {"cloths": [{"mesh": "bag.obj"}],
             "formwork": {"fixed": [{"boundary": "top"}], "plaster": {"density": 1500, "fill": {"depth_below_rim": 0}},
                          "segment": {"min_width": 0.02}, "panels": {"max_distortion": 1}}}
    (folder / "bag.json").write_text(json.dumps(scene))
    run(build / "formwork", "run", folder / "bag.json", "-o", folder / "out", "--to", "panels", "-q")
    rest = folder / "out/panels/sewn_rest.obj"
    if failures:
        print("\n".join(failures))
        sys.exit(1)
    nodes, flat, faces = read_obj(rest)
    top = max(z for _, _, z in nodes)
    rim = [i for i, p in enumerate(nodes) if p[2] > top - 1e-6]
    for steps in (1, 2):
        cloth = {"frame_time": 0.01, "frame_steps": 4 * steps, "end_frame": 4, "gravity": [0, 0, -9.81], "wind": {"density": 0},
                 "cloths": [{"mesh": str(rest), "materials": [{"data": str(root / "conf/materials/woven_table3.json")}]}],
                 "handles": [{"nodes": rim}], "disable": ["remeshing", "collision", "proximity", "strainlimiting", "plasticity"]}
        (folder / f"cloth{steps}.json").write_text(json.dumps(cloth))
        for copy in "ab" if steps == 1 else "a":
            run(build / "arcsim", folder / f"cloth{steps}.json", folder / f"{steps}{copy}", "--quiet")
    frames = sorted(p.name for p in (folder / "1a").glob("*_00.obj"))
    check(len(frames) == 5, f"frames {frames}")
    if not failures:
        start_nodes, start_flat, start_faces = read_obj(folder / "1a" / frames[0])
        apart = max(abs(a - b) for p, q in zip(nodes, start_nodes) for a, b in zip(p, q))
        check(len(start_nodes) == len(nodes) and apart < 0.5 * 0.012, f"the first frame is not near the surface that was cut: {apart} m")
        ours = edges_of([[flat[u] for _, u in face] for face in faces])
        theirs = edges_of([[start_flat[u] for _, u in face] for face in start_faces])
        check(len(ours) == len(theirs) and all(abs(a - b) < 1e-9 for p, q in zip(ours, theirs) for a, b in zip(p, q)),
              "the panels' rest shape is not the one that arcsim works with")
        run(build / "formwork", "compare", folder / "1a", folder / "1b", "--tolerance", "0")
        run(build / "formwork", "compare", folder / "1a", folder / "2a", "--tolerance", "0.01")
        text = run(build / "formwork", "compare", folder / "1a", folder / "2a", "--tolerance", "1e-9", code=1).stdout
        check(frames[-1] in text, f"compare does not name the frames: {text[:300]}")

print("\n".join(failures))
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
