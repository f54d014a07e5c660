"""Filled bags with exact answers, on meshes of a wanted size: what scripts/chart_speed_accuracy runs.

Exact values: tests/data/benchmarks/reference.json (ordinary differential equations, error below 1e-8) and, for the strip
that hangs under its own weight, a quadrature here. Each case writes mesh.obj and returns the `formwork` object.
"""
import json
import math
import pathlib

import stability_cases as shapes

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
REFERENCE = json.loads((ROOT / "tests/data/benchmarks/reference.json").read_text())
ROWS = {"iso300": ([300, 2, 300, 298], [600, 2, 600, 598]),
        "iso36k": ([36000, 1000, 36000, 35000], [360000, 10000, 360000, 350000])}


def isotropic(name, law, compression="full"):
    rest, most = ROWS[name]
    return {"model": "isotropic", "rest": rest, "max": most if law == "secant" else rest, "compression": compression}


def bag_scene(material, plaster, **more):
    return {"fixed": [{"boundary": "all"}], "plaster": plaster,
            "inflate": {"material": material, "density": 0.2, "self_weight": False}, **more}


class Case:
    """A family of meshes of one bag, the exact depth (m) and, where known, volume (m³)."""

    def __init__(self, name, write, depth, volume=None):
        self.name, self.write, self.depth, self.volume = name, write, depth, volume

    def errors(self, summary):
        depth = abs(summary["depth_below_rim_m"] / self.depth - 1)
        return depth, abs(summary["capacity_m3"] / self.volume - 1) if self.volume else None


def disk_case(name, c, material):
    def write(folder, vertices):
        x, u, faces = shapes.ring_disk(c["a"], max(2, round(math.sqrt(vertices / 3))))
        shapes.write_obj(folder / "mesh.obj", (x, None, [f[::-1] for f in faces]))   # normals down: pressure pushes along them
        plaster = ({"density": 0, "overpressure": c["p"]} if "p" in c else
                   {"density": c["rho"], "gravity": 9.81, "fill": {"level": c.get("head", 0)}})
        return bag_scene(material, plaster)
    return Case(name, write, c["depth"], c["volume"])


def sock_case(name, c, material):
    def write(folder, vertices):
        rings = max(3, round(math.sqrt(vertices / (3 + 6 * c["h"] / c["a"]))))
        rows = max(2, round(rings * c["h"] / c["a"]))
        shapes.write_obj(folder / "mesh.obj", shapes.cylinder(c["a"], c["h"], 6 * rings, rows + rows % 2))
        return {**bag_scene(material, {"density": c["rho"], "gravity": 9.81, "fill": {"level": c["head"]}}),
                "fixed": [{"boundary": "top"}]}
    return Case(name, write, c["depth"], c["volume"])


def strip_mesh(length, across, along, place):
    """A strip of `along` x `across` cells with alternating diagonals; place(s, t) -> x; vt = (s, t) in metres."""
    edge = length / along
    u = [(edge * i, edge * j) for j in range(across + 1) for i in range(along + 1)]
    faces = []
    for j in range(across):
        for i in range(along):
            a, b = j * (along + 1) + i, j * (along + 1) + i + 1
            c, d = a + along + 1, b + along + 1
            faces += [(a, b, d), (a, d, c)] if (i + j) % 2 else [(a, b, c), (b, d, c)]
    return [place(s, t) for s, t in u], u, faces


def trough_case(name, c, material):
    """Plane strain: nodes move in their cross section only; starts as a parabola of about the cloth's length."""
    length, width = c["L0"], c["W"]
    sag = math.sqrt(3 / 8 * width * (length - width))

    def write(folder, vertices):
        along = max(8, round(vertices / 4))
        mesh = strip_mesh(length, 3, along, lambda s, t: (width * s / length, t, -4 * sag * s / length * (1 - s / length)))
        shapes.write_obj(folder / "mesh.obj", mesh)
        scene = bag_scene(material, {"density": 1500, "gravity": 9.81, "fill": {"level": c["head"]}}, rest="vt")
        scene["fixed"] = [{"all": True, "axes": "y"}, {"box": {"min": [-1e-6, -1, -1], "max": [1e-6, 1, 1]}},
                          {"box": {"min": [width - 1e-6, -1, -1], "max": [width + 1e-6, 1, 1]}}]
        return scene
    return Case(name, write, c["bottom_below_supports"])


def hanging_strip_case(name, length=1.0, density=20.0, k=300.0):
    """A strip that hangs under its own weight: S = k (lambda² - 1)/2, lambda S = rho g (L - s); no coupling, so that the
    width does not change. Its depth is the integral of lambda."""
    def stretch(force):
        low, high = 1.0, 10.0
        for _ in range(80):
            mid = 0.5 * (low + high)
            low, high = (mid, high) if k * mid * (mid * mid - 1) / 2 < force else (low, mid)
        return low
    n = 4000
    depth = sum(stretch(density * 9.81 * length * (1 - (i + 0.5) / n)) for i in range(n)) * length / n

    def write(folder, vertices):
        across = max(2, round(math.sqrt(vertices / 10)))
        mesh = strip_mesh(length, across, 10 * across, lambda s, t: (t, 0.0, -s))
        shapes.write_obj(folder / "mesh.obj", mesh)
        material = {"model": "isotropic", "rest": [k, 0, k, k], "max": [k, 0, k, k], "compression": "full"}
        return {"fixed": [{"box": {"min": [-1, -1, -1e-6], "max": [1, 1, 1e-6]}}],
                "plaster": {"density": 0, "gravity": 9.81}, "rest": "vt",
                "inflate": {"material": material, "density": density, "self_weight": True}}
    return Case(name, write, depth)


def weave_case(name, c, data):
    def write(folder, vertices):
        (folder / "weave.json").write_text((ROOT / "tests/data/benchmarks" / data).read_text())
        shapes.write_obj(folder / "mesh.obj", shapes.ring_disk(c["a"], max(2, round(math.sqrt(vertices / 3)))))
        material = {"model": "tensor", "data": "weave.json", "stretching_mult": 0.5, "compression": "full"}
        return bag_scene(material, {"density": c["rho"], "gravity": 9.81, "fill": {"level": 0}})
    return Case(name, write, c["depth"], c["volume"])


def all_cases():
    b4, b5, b6, b6c = (REFERENCE[k] for k in ("b4", "b5", "b6", "b6c"))
    cases = [disk_case("filled disk", b6[8], isotropic("iso300", "const")),
             disk_case("clamped disk, uniform pressure", b4[4], isotropic("iso300", "secant")),
             sock_case("sock", b6[5], isotropic("iso300", "secant")),
             trough_case("trough", b5[5], isotropic("iso300", "secant")),
             hanging_strip_case("hanging strip"),
             sock_case("stiff sock, wrinkled", b6[6], isotropic("iso36k", "const", "tension_field")),
             weave_case("weave", b6c[1], "tab300_secant.json")]
    return {c.name: c for c in cases}
