#!/usr/bin/env python3
"""Turns a closed triangle mesh (gmsh 2.2 ASCII, or OBJ) into an open bag with well-shaped triangles.

The lid is removed (level faces above a height), the triangles are evened out by edge collapses, flips and
tangential smoothing on the original surface, and the result is written as OBJ.

Usage: open_bag.py IN OUT [--remove-level-faces-above Z] [--round-creases] --edge LENGTH
"""
import argparse
import math
import sys

import numpy as np


def read_msh(path):
    lines = open(path).read().split("\n")
    i = lines.index("$Nodes")
    n = int(lines[i + 1])
    ids, points = {}, []
    for line in lines[i + 2:i + 2 + n]:
        k, *xyz = line.split()
        ids[int(k)] = len(points)
        points.append([float(c) for c in xyz])
    i = lines.index("$Elements")
    faces = []
    for line in lines[i + 2:i + 2 + int(lines[i + 1])]:
        words = [int(w) for w in line.split()]
        if words[1] == 2:
            faces.append([ids[w] for w in words[3 + words[2]:]])
    return np.array(points), np.array(faces)


def orient(faces):
    """Neighbouring faces agree; the first face decides."""
    by_edge = {}
    for f, t in enumerate(faces):
        for k in range(3):
            by_edge.setdefault(frozenset((t[k], t[(k + 1) % 3])), []).append(f)
    done, stack = {0}, [0]
    while stack:
        f = stack.pop()
        t = faces[f]
        for k in range(3):
            a, b = t[k], t[(k + 1) % 3]
            for g in by_edge[frozenset((a, b))]:
                if g not in done:
                    u = list(faces[g])
                    if (u.index(b) - u.index(a)) % 3 == 1:      # runs the same way: turn it over
                        faces[g] = faces[g][::-1]
                    done.add(g)
                    stack.append(g)
    return faces


def compact(points, faces):
    used = np.unique(faces)
    new = np.full(len(points), -1)
    new[used] = np.arange(len(used))
    return points[used], new[faces]


def angles(points, faces):
    p = points[faces]
    out = np.empty((len(faces), 3))
    for k in range(3):
        a, b = p[:, (k + 1) % 3] - p[:, k], p[:, (k + 2) % 3] - p[:, k]
        cross = np.linalg.norm(np.cross(a, b), axis=1)
        out[:, k] = np.degrees(np.arctan2(cross, (a * b).sum(1)))
    return out


class Mesh:
    """A mesh that is edited: faces per node, boundary nodes stay where they are."""

    def __init__(self, points, faces):
        self.x = [np.array(p) for p in points]
        self.f = {i: list(t) for i, t in enumerate(faces)}
        self.around = {}
        for i, t in self.f.items():
            for v in t:
                self.around.setdefault(v, set()).add(i)

    def faces_of(self, a, b):
        return [i for i in self.around[a] if i in self.around[b]]

    def neighbours(self, v):
        return {w for i in self.around[v] for w in self.f[i] if w != v}

    def is_rim(self, v):
        return len(self.neighbours(v)) != len(self.around[v])

    def min_angle(self, t):
        """Degrees; it lies opposite to the shortest side. Plain floats: called millions of times."""
        p = [self.x[v].tolist() for v in t]
        shortest, b, c = sorted(math.dist(p[k], p[k - 1]) for k in range(3))
        if shortest == 0:
            return 0.0
        return math.degrees(math.acos(max(-1.0, min(1.0, (b * b + c * c - shortest * shortest) / (2 * b * c)))))

    def normal(self, t):
        a, b, c = (self.x[v] for v in t)
        return np.cross(b - a, c - a)

    def edges(self):
        return {tuple(sorted((t[k], t[(k + 1) % 3]))) for t in self.f.values() for k in range(3)}

    def collapse_short(self, limit):
        count = 0
        for a, b in sorted(self.edges()):
            if a not in self.around or b not in self.around or b not in self.neighbours(a):
                continue
            if np.linalg.norm(self.x[a] - self.x[b]) > limit:
                continue
            if self.is_rim(b):
                a, b = b, a
            if self.is_rim(b) or len(self.neighbours(a) & self.neighbours(b)) != 2:
                continue
            rest = [i for i in self.around[b] if a not in self.f[i]]
            moved = {i: [a if v == b else v for v in self.f[i]] for i in rest}
            if any(self.normal(moved[i]) @ self.normal(self.f[i]) <= 0 for i in rest):
                continue
            for i in self.faces_of(a, b):
                for v in self.f[i]:
                    self.around[v].discard(i)
                del self.f[i]
            for i in rest:
                self.f[i] = moved[i]
                self.around[a].add(i)
            del self.around[b]
            count += 1
        return count

    def flip_for_angles(self, feature_cosine):
        count = 0
        for a, b in sorted(self.edges()):
            pair = self.faces_of(a, b)
            if len(pair) != 2:
                continue
            c, d = ([v for v in self.f[i] if v not in (a, b)][0] for i in pair)
            if d in self.neighbours(c):
                continue
            first, second = self.f[pair[0]], self.f[pair[1]]
            if (first.index(b) - first.index(a)) % 3 != 1:
                a, b = b, a
            new = ([a, d, c], [d, b, c])                   # the old pair was (a, b, c) and (b, a, d)
            n0, n1 = self.normal(first), self.normal(second)
            cosine = n0 @ n1 / (np.linalg.norm(n0) * np.linalg.norm(n1))
            if cosine < feature_cosine or any(self.normal(t) @ (n0 + n1) <= 0 for t in new):
                continue                                    # a crease, or it would fold
            if min(map(self.min_angle, new)) <= min(map(self.min_angle, (first, second))) + 1e-9:
                continue
            for i, t in zip(pair, new):
                for v in self.f[i]:
                    self.around[v].discard(i)
                self.f[i] = t
                for v in t:
                    self.around[v].add(i)
            count += 1
        return count

    def smooth(self, feature_cosine):
        """Moves every free node half way to the mean of its neighbours, within its tangent plane."""
        for v in sorted(self.around):
            if self.is_rim(v):
                continue
            normals = [self.normal(self.f[i]) for i in self.around[v]]
            n = sum(normals)
            n = n / np.linalg.norm(n)
            if min(m @ n / np.linalg.norm(m) for m in normals) < feature_cosine:
                continue                                    # on a crease (the foot's edge)
            step = np.mean([self.x[w] for w in sorted(self.neighbours(v))], axis=0) - self.x[v]
            step = 0.5 * (step - (step @ n) * n)
            before = min(self.min_angle(self.f[i]) for i in self.around[v])
            old = self.x[v]
            self.x[v] = old + step
            if min(self.min_angle(self.f[i]) for i in self.around[v]) < min(before, 35):
                self.x[v] = old

    def arrays(self):
        return compact(np.array(self.x), np.array([self.f[i] for i in sorted(self.f)]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source")
    parser.add_argument("target")
    parser.add_argument("--remove-level-faces-above", type=float, default=math.inf)
    parser.add_argument("--edge", type=float, required=True)
    parser.add_argument("--round-creases", action="store_true",
                        help="work across creases too: for scanned shapes, whose creases are those of coarse triangles")
    options = parser.parse_args()
    flip_cosine, smooth_cosine = (0.7, -1.0) if options.round_creases else (0.94, 0.8)

    points, faces = read_msh(options.source)
    faces = orient(faces)
    p = points[faces]
    if np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 1], p[:, 2])).sum() < 0:
        faces = faces[:, ::-1]                              # outward
    z = points[faces][:, :, 2]
    lid = (z.min(1) > options.remove_level_faces_above) & (z.max(1) - z.min(1) < 1e-9)
    points, faces = compact(points, faces[~lid])

    mesh = Mesh(points, faces)
    for _ in range(12):
        mesh.collapse_short(0.55 * options.edge)
        mesh.flip_for_angles(flip_cosine)
        mesh.smooth(smooth_cosine)
    points, faces = mesh.arrays()
    worst = angles(points, faces).min()
    with open(options.target, "w") as out:
        for x in points:
            out.write("v %.7g %.7g %.7g\n" % tuple(x))
        for t in faces:
            out.write("f %d %d %d\n" % tuple(t + 1))
    print(f"{options.target}: {len(points)} nodes, {len(faces)} faces, smallest angle {worst:.1f} degrees")
    return 0 if worst > 20 else 1


if __name__ == "__main__":
    sys.exit(main())
