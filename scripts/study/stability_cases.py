"""The scenes of the stability atlas: places where methods for filled bags fail, each with what must happen there.

A case is a tuple: row (number and name), mesh (x, vt, faces), scene (the `formwork` object), expect ("shape" with a
reference depth in metres, a relative tolerance and where it comes from, "error" with words of the message, or "self": what
the default settings find), and the stage, when it is not `inflate`. Numbers are the rows of the list of failures; those
from 19 on are our own finds.
"""
import json
import math
import pathlib

ISO300_CONST = {"model": "isotropic", "rest": [300, 2, 300, 298], "max": [300, 2, 300, 298]}
ISO300 = {"model": "isotropic", "rest": [300, 2, 300, 298], "max": [600, 2, 600, 598]}
ISO36K_CONST = {"model": "isotropic", "rest": [36000, 1000, 36000, 35000], "max": [36000, 1000, 36000, 35000]}
WOVEN = {"density": 0.15, "bending": [[1e-6] * 5] * 3,
         "stretching": [[36000, 1000, 64000, 1000]] + [[360000, 10000, 640000, 10000]] * 5}
TAB300_CONST = {"density": 0.15, "bending": [[1e-6] * 5] * 3, "stretching": [[300, 2, 300, 18.75]] * 6}

BALANCED = {**WOVEN, "stretching": [[36000, 1000, 36000, 1000], [360000, 10000, 300000, 10000], [250000, 9000, 240000, 30000],
                                    [150000, 8000, 150000, 60000], [240000, 9000, 250000, 30000], [300000, 10000, 360000, 10000]]}
MATERIALS = {"woven.json": WOVEN, "tab300.json": TAB300_CONST, "balanced.json": BALANCED}
REFERENCE = json.loads((pathlib.Path(__file__).resolve().parents[2] / "tests/data/benchmarks/reference.json").read_text())


# --- meshes ---------------------------------------------------------------------------------------------------

def ring_disk(radius, rings, height=lambda r: 0.0, scale=1.0, down=False):
    """A disk of concentric rings of 6, 12, 18 ... nodes; rim nodes on the circle; vt = rest coordinates * scale."""
    points, faces, start = [(0.0, 0.0)], [], [0]
    for k in range(1, rings + 1):
        start.append(len(points))
        points += [(radius * k / rings * math.cos(2 * math.pi * i / (6 * k)),
                    radius * k / rings * math.sin(2 * math.pi * i / (6 * k))) for i in range(6 * k)]
    for k in range(1, rings + 1):
        inner = lambda i, k=k: start[k - 1] + (i % (6 * (k - 1)) if k > 1 else 0)
        outer = lambda i, k=k: start[k] + i % (6 * k)
        for sector in range(6):
            for i in range(k):
                o, n = sector * k + i, sector * (k - 1) + i
                faces.append((inner(n), outer(o), outer(o + 1)))
                if i + 1 < k:
                    faces.append((inner(n), outer(o + 1), inner(n + 1)))
    x = [(px, py, height(math.hypot(px, py))) for px, py in points]
    return x, [(px * scale, py * scale) for px, py in points], [f[::-1] for f in faces] if down else faces


def cylinder(radius, height, around, up, bottom=None):
    """A sock: wall from z = -height to 0, and a disk bottom of rings when `bottom` is True."""
    rows = max(1, up)
    x, faces = [], []
    for j in range(rows + 1):
        for i in range(around):
            a = 2 * math.pi * (i + 0.5 * (j % 2)) / around
            x.append((radius * math.cos(a), radius * math.sin(a), -height + height * j / rows))
    for j in range(rows):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            c, d = (j + 1) * around + i, (j + 1) * around + (i + 1) % around
            faces += [(a, b, d), (a, d, c)] if j % 2 else [(a, b, c), (b, d, c)]
    rings = around // 6                                   # bottom: rings of 6k nodes, the last one is the wall's
    disk, _, disk_faces = ring_disk(radius, rings)
    outer = len(disk) - 6 * rings
    index = {k: (k - outer if k >= outer else len(x) + k) for k in range(len(disk))}
    x += [(p, q, -height) for p, q, _ in disk[:outer]]
    faces += [(index[a], index[c], index[b]) for a, b, c in disk_faces]
    return x, None, faces


def with_stray_nodes(mesh):
    """One node without faces, and one vt that no face names."""
    x, u, f = mesh
    return x[:5] + [(0.3, 0.3, 0.1)] + x[5:], None, [tuple(i + (i >= 5) for i in t) for t in f]


def narrow_column():
    """A sock that widens upwards: the pipeline cuts it into several panels."""
    x, _, f = cylinder(0.04, 0.12, 42, 20)
    return [(px * (1 + 2 * (pz + 0.12)), py * (1 + 2 * (pz + 0.12)), pz) for px, py, pz in x], None, f


def write_obj(path, mesh, scale=1.0):
    x, u, faces = mesh
    with open(path, "w") as out:
        for p in u or []:
            out.write("vt %.12g %.12g\n" % tuple(scale * c for c in p))
        for p in x:
            out.write("v %.12g %.12g %.12g\n" % tuple(scale * c for c in p))
        for t in faces:
            out.write("f " + " ".join(f"{i + 1}/{i + 1}" if u else str(i + 1) for i in t) + "\n")


def two_socks():
    x, _, f = cylinder(0.05, 0.05, 24, 4)
    n = len(x)
    return x + [(p[0] + 0.3, p[1], p[2]) for p in x], None, f + [tuple(i + n for i in t) for t in f]


def sliver_disk():
    """A disk with one node moved almost onto the edge across from it: heights of 1e-5 m."""
    x, u, f = ring_disk(0.1, 10)
    a, b, c = f[120]
    pa, pb = x[a], x[b]
    mid = tuple(0.5 * (s + t) for s, t in zip(pa, pb))
    toward = [s - m for s, m in zip(x[c], mid)]
    length = math.sqrt(sum(t * t for t in toward))
    x[c] = tuple(m + t / length * 1e-5 for m, t in zip(mid, toward))
    return x, None, f


def flipped_face():
    x, u, f = ring_disk(0.1, 8)
    f[30] = f[30][::-1]
    return x, None, f


def three_faces_on_an_edge():
    x, u, f = ring_disk(0.1, 8)
    a, b, _ = f[30]
    return x + [(0.0, 0.0, 0.05)], None, f + [(a, b, len(x))]


def zero_area():
    x, u, f = ring_disk(0.1, 8)
    a, b, c = f[30]
    x[c] = tuple(0.5 * (s + t) for s, t in zip(x[a], x[b]))
    return x, None, f


def inverted_uv():
    x, u, f = ring_disk(0.1, 8)
    u = list(u)
    u[5] = (u[5][0] + 0.05, u[5][1] + 0.05)               # a node pulled across its neighbours in the plane
    return x, u, f


def hemisphere(radius, rings):
    """Below z = 0; rings of 6k nodes at equal polar angles."""
    x, _, f = ring_disk(1.0, rings)
    out = []
    for px, py, _ in x:
        r = math.hypot(px, py)
        a = r * math.pi / 2
        s = radius * math.sin(a) / r if r > 0 else 0
        out.append((px * s, py * s, -radius * math.cos(a) if r < 1 - 1e-9 else 0.0))
    return out, None, [t[::-1] for t in f]


# --- cases ------------------------------------------------------------------------------------------------------

def scene(material, level=0.0, density=1500, fixed=None, fabric=0.15, **more):
    return {"fixed": [{"boundary": "all"}] if fixed is None else fixed,
            "plaster": {"density": density, "gravity": 9.81, "fill": {"level": level}},
            "inflate": {"material": material, "density": fabric, "self_weight": False}, **more}


def cases(folder):
    """All cases; materials in files are written to `folder`."""
    for name, data in MATERIALS.items():
        (folder / name).write_text(json.dumps(data))
    woven = {"model": "tensor", "data": "woven.json", "sampling": "exact", "stretching_mult": 0.5}
    tab300 = {"model": "tensor", "data": "tab300.json", "sampling": "exact", "stretching_mult": 0.5}
    dish = lambda r: -0.01 * (1 - (r / 0.15) ** 2)
    shape = lambda depth, tolerance, source: {"shape": depth, "tolerance": tolerance, "source": source}
    error = lambda *words: {"error": words}
    b6 = "axisymmetric reference, error < 1e-8"
    sewn = lambda **more: scene(ISO300, segment={"min_width": 0.02, "max_distortion": 0.1}, panels={"max_distortion": 1},
                                sew={"material": {"model": "isotropic", **{k: ISO300[k] for k in ("rest", "max")}}, "stitch_stiffness": 5e5, "seam_stiffness": 5e5, **more},
                                fixed=[{"boundary": "top"}])
    in_steps = scene(ISO300_CONST)
    in_steps["inflate"]["solver"] = {"method": "backward_euler", "time_step": 0.1, "end_time": 100, "tolerance": 1e-6}
    balanced = {"model": "tensor", "data": "balanced.json", "sampling": "exact", "stretching_mult": 0.5}
    by_volume = scene(ISO300_CONST)
    by_volume["plaster"]["fill"] = {"volume": REFERENCE["b6"][8]["volume"]}
    b4 = REFERENCE["b4"][4]
    blown = scene(ISO300, density=0)
    blown["plaster"] = {"density": 0, "overpressure": b4["p"]}
    return [
        ("1 big implicit step from a shallow dish", ring_disk(0.15, 8, dish, 1.0), scene(ISO300_CONST), shape(0.099612736, 1.5e-2, b6)),
        ("2 stiff weave on light cloth", ring_disk(0.15, 16), scene(woven), {"self": True}),
        ("3a stitches of 5e5 N/m, 300 N/m cloth", narrow_column(), sewn(seams="stitch"), {"self": True}, "sew"),
        ("3b the seam's nodes shared, thread of 5e5 N/m", narrow_column(), sewn(), {"self": True}, "sew"),
        ("4a slack cloth: rest 10 % too large", ring_disk(0.15, 16, dish, 1.10), scene(ISO300_CONST, rest="vt"), {"self": True}),
        ("4b stiff hemisphere filled to its rim", hemisphere(0.15, 14), scene(ISO36K_CONST), {"self": True}),
        ("5 slivers of 1e-5 m", sliver_disk(), scene(ISO300_CONST), shape(0.040974435, 2e-2, b6)),
        ("6a rest face without area", zero_area(), scene(ISO300), error("area")),
        ("6b inverted rest face", inverted_uv(), scene(ISO300, rest="vt"), error("area", "invert", "clockwise", "flipped", "overlap")),
        ("7 nothing held", cylinder(0.05, 0.1, 24, 8), scene(ISO300, fixed=[]), error("held", "fixed")),
        ("8a ballooning sock", cylinder(0.15, 0.30, 36, 12), scene(ISO300_CONST), error("balloon")),
        ("8b ballooning disk", ring_disk(0.45, 14), scene(ISO300_CONST), error("balloon")),
        ("9 flat at the level", ring_disk(0.15, 16), scene(ISO300_CONST), shape(0.099612736, 4e-3, b6)),
        ("10 level 0.1 m below the rim", cylinder(0.1, 0.2, 48, 14), scene(ISO300, level=-0.1), shape(0.2939207 - 0.1, 1e-2, b6)),
        ("11 equal stretches everywhere (pole, rest)", ring_disk(0.1, 16), scene(ISO300_CONST), shape(0.040974435, 4e-3, b6)),
        ("12 table end inside the bag", ring_disk(0.2, 16), scene(ISO300, density=1800), shape(0.13876774, 6e-3, b6)),
        ("13 free rim below the level", cylinder(0.05, 0.1, 24, 8), scene(ISO300, level=0.01, fixed=[{"box": {"min": [-1, -1, -0.101], "max": [1, 1, -0.09]}}]), {"self": True}),
        ("14a two bags, one not held", two_socks(), scene(ISO300, fixed=[{"box": {"min": [-0.1, -0.1, -0.001], "max": [0.1, 0.1, 0.001]}}]), error("held", "fixed", "component")),
        ("14b a node without faces", with_stray_nodes(ring_disk(0.15, 16)), scene(ISO300_CONST), shape(0.099612736, 4e-3, b6)),
        ("15a three faces on an edge", three_faces_on_an_edge(), scene(ISO300), error("three or more faces", "manifold")),
        ("15b one face turned over", flipped_face(), scene(ISO300), error("orient")),
        ("16 millimetres read as metres", (lambda m: ([tuple(1000 * c for c in p) for p in m[0]], None, m[2]))(ring_disk(0.15, 8)), scene(ISO300_CONST), error("unit", "mm")),
        ("17 square-symmetric table", ring_disk(0.1, 16), scene(tab300), shape(0.042787, 6e-3, "Richardson on a disk, 7e-5")),
        ("18 steps of 0.1 s until at rest", ring_disk(0.15, 16), in_steps, shape(0.099612736, 4e-3, b6)),
        ("19 a weave, equal stretches at the pole", ring_disk(0.15, 16), scene(balanced), {"self": True}),
        ("20 filled by volume, not level", ring_disk(0.15, 16), by_volume, shape(0.099612736, 8e-3, b6)),
        ("21 overpressure alone", ring_disk(b4["a"], 16, down=True), blown, shape(b4["depth"], 6e-3, "b4, error < 1e-8")),
    ]
