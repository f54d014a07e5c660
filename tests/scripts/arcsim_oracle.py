"""ArcSim's time step written down once more, dense and slow: an oracle for `arcsim` (test_arcsim_oracle.py).

It shares no code with this project. It transcribes the published facts: the 30³ table, the secant law, the approximate
tangent, bending with the stiffness of the angle one step earlier, two start relaxations with the handles' anchoring
between them, wind with the normal of one step earlier, penalty handles.
"""
import itertools
import math

import numpy as np


def table_of(rows, mult):
    """k at G_uu = -1/4 + i/30, G_vv = -1/4 + j/30, G_uv = k/30."""
    i, j, k = np.meshgrid(*[np.arange(30)] * 3, indexing="ij")
    cu, cv, cw = 1 + 2 * (-0.25 + i / 30), 1 + 2 * (-0.25 + j / 30), 2 * k / 30
    l1 = (cu + cv) / 2 + np.hypot((cu - cv) / 2, cw)
    angle = np.where(k == 0, np.where(cu >= cv, 0, math.pi / 2), 0.5 * np.arctan2(2 * cw, cu - cv))
    a = np.clip(8 * np.abs(angle) / math.pi, 0, 4 - 1e-6)
    s = np.clip(6 * (np.sqrt(l1) - 1), 0, 1 - 1e-6)[..., None]
    ia = np.floor(a).astype(int)
    fa = (a - ia)[..., None]
    rows = np.array(rows)
    return mult * 2 * np.maximum((1 - s) * rows[0] + s * ((1 - fa) * rows[1 + ia] + fa * rows[2 + ia]), 0)


def stiffness(table, G):
    at = np.clip([(G[0] + 0.25) * 30, (G[1] + 0.25) * 30, abs(G[2]) * 30], 0, 29 - 1e-5)
    low = np.floor(at).astype(int)
    f = at - low
    return sum(np.prod([f[d] if c[d] else 1 - f[d] for d in range(3)]) * table[tuple(low + c)] for c in map(np.array, itertools.product((0, 1), repeat=3)))


def bending_stiffness(rows, mult, e, theta, l, a):
    b = min(0.1 * theta * l / a, 4)
    ib = int(min(max(math.floor(b), 0), 3))
    fb = b - ib
    d = 4 * abs(math.atan2(e[1], e[0])) / math.pi
    d = 4 - d if d > 2 else d
    id_ = min(int(d), 1)
    fd = d - id_
    value = sum(wd * wb * rows[id_ + y][ib + x] for y, wd in ((0, 1 - fd), (1, fd)) for x, wb in ((0, 1 - fb), (1, fb)))
    return mult * max(value, 0)


def unit(a):
    return a / np.linalg.norm(a)


class Cloth:
    def __init__(self, vt, x, v, faces, labels, damage, rest_angle, materials, keep_creases):
        """materials: dicts with rows, bending, density and the scene's multipliers."""
        self.x, self.v, self.faces, self.labels = x.copy(), v.copy(), faces, labels
        self.n = len(x)
        self.materials = materials
        self.tables = [table_of(m["stretching"], m["stretching_mult"] * m["thicken"]) for m in materials]
        self.D, self.area = [], []
        self.mass = np.zeros(self.n)
        for f, face in enumerate(faces):
            u = [vt[c[1]] for c in face]
            D = np.array([u[1] - u[0], u[2] - u[0]]).T
            self.D.append(D)
            self.area.append(np.linalg.det(D) / 2)
            m = materials[labels[f]]
            for node, _ in face:
                self.mass[node] += m["density"] * m["density_mult"] * m["thicken"] * self.area[-1] / 3
        self.soft = [1 + materials[labels[f]]["weakening"] * damage[f] for f in range(len(faces))]
        # Edges: side 0 runs through the edge from node a to b in its own order.
        sides = {}
        for f, face in enumerate(faces):
            for k in range(3):
                (a, ua), (b, ub), (c, _) = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
                sides[a, b] = (f, c, vt[ua] - vt[ub])
        self.edges = []
        for (a, b), (f, c, e) in sides.items():
            if a < b and (b, a) in sides:
                g, d, e2 = sides[b, a]
                self.edges.append(dict(nodes=(a, b, c, d), l=(np.linalg.norm(e) + np.linalg.norm(e2)) / 2, a=self.area[f] + self.area[g],
                                       sides=((labels[f], e), (labels[g], -e2)), rest=rest_angle.get((a, b), 0.0)))
        self.refresh()
        if keep_creases:
            for e, theta in zip(self.edges, self.theta):
                e["rest"] = theta

    def fold(self, edge, x):
        """theta and its gradient."""
        p = [x[i] for i in edge["nodes"]]
        n0, n1 = unit(np.cross(p[1] - p[0], p[2] - p[0])), unit(np.cross(p[3] - p[0], p[1] - p[0]))
        e = unit(p[0] - p[1])
        theta = math.atan2(e @ np.cross(n0, n1), n0 @ n1)
        along = p[1] - p[0]
        w = [(p[i] - p[0]) @ along / (along @ along) for i in (2, 3)]
        h = [np.linalg.norm(p[i] - p[0] - w[i - 2] * along) for i in (2, 3)]
        g = [-((1 - w[0]) * n0 / h[0] + (1 - w[1]) * n1 / h[1]), -(w[0] * n0 / h[0] + w[1] * n1 / h[1]), n0 / h[0], n1 / h[1]]
        return theta, np.concatenate(g)

    def refresh(self):
        self.theta = [self.fold(e, self.x)[0] for e in self.edges]
        self.normal = [unit(np.cross(*[self.x[f[k][0]] - self.x[f[0][0]] for k in (1, 2)])) for f in self.faces]

    def internal(self, x):
        """Force (3n), energy, and a list of (degrees of freedom, J, beta)."""
        f, energy, parts = np.zeros(3 * self.n), 0.0, []
        for t, face in enumerate(self.faces):
            nodes = [c[0] for c in face]
            dofs = np.concatenate([[3 * i, 3 * i + 1, 3 * i + 2] for i in nodes])
            Di = np.linalg.inv(self.D[t])
            P = np.array([x[nodes[1]] - x[nodes[0]], x[nodes[2]] - x[nodes[0]]]).T @ Di
            G = (P.T @ P - np.eye(2)) / 2
            k = stiffness(self.tables[self.labels[t]], (G[0, 0], G[1, 1], G[0, 1])) / self.soft[t]
            S = np.array([[k[0] * G[0, 0] + k[1] * G[1, 1], k[3] * G[0, 1]], [k[3] * G[0, 1], k[2] * G[1, 1] + k[1] * G[0, 0]]])
            A = self.area[t]
            F = -A * P @ S @ Di.T
            f[dofs] += np.concatenate([-F[:, 0] - F[:, 1], F[:, 0], F[:, 1]])
            energy += A * (k[0] * G[0, 0] ** 2 / 2 + k[2] * G[1, 1] ** 2 / 2 + k[1] * G[0, 0] * G[1, 1] + k[3] * G[0, 1] ** 2)
            d = Di.T @ np.array([[-1, 1, 0], [-1, 0, 1]])
            fuu, fvv = np.kron(d[0], P[:, 0]), np.kron(d[1], P[:, 1])
            fuv = (np.kron(d[0], P[:, 1]) + np.kron(d[1], P[:, 0])) / 2
            Buu, Bvv = np.kron(np.outer(d[0], d[0]), np.eye(3)), np.kron(np.outer(d[1], d[1]), np.eye(3))
            pu, pv = max(G[0, 0], 0), max(G[1, 1], 0)
            H = (k[0] * (np.outer(fuu, fuu) + pu * Buu) + k[2] * (np.outer(fvv, fvv) + pv * Bvv) +
                 k[1] * (np.outer(fuu, fvv) + np.outer(fvv, fuu) + pu * Bvv + pv * Buu) + 2 * k[3] * np.outer(fuv, fuv))
            parts.append((dofs, -A * H, self.materials[self.labels[t]]["damping"]))
        for edge, lagged in zip(self.edges, self.theta):
            theta, grad = self.fold(edge, x)
            k = min(bending_stiffness(m["bending"], m["bending_mult"] * m["thicken"], e, lagged, edge["l"], edge["a"])
                    for m, e in ((self.materials[label], e) for label, e in edge["sides"]))
            c = k * edge["l"] ** 2 / (4 * edge["a"])
            dofs = np.concatenate([[3 * i, 3 * i + 1, 3 * i + 2] for i in edge["nodes"]])
            f[dofs] -= c * (theta - edge["rest"]) * grad
            energy += c / 2 * (theta - edge["rest"]) ** 2
            parts.append((dofs, -c * np.outer(grad, grad), self.materials[edge["sides"][0][0]]["damping"]))
        return f, energy, parts

    def relax(self):
        start = self.x.copy()
        total = lambda x: self.internal(x)[1] + ((x - start) ** 2).sum() / 2
        for _ in range(10):
            f, _, parts = self.internal(self.x)
            A = np.eye(3 * self.n)
            for dofs, J, _ in parts:
                A[np.ix_(dofs, dofs)] -= J
            dx = np.linalg.solve(A, f - (self.x - start).ravel()).reshape(-1, 3)
            if total(self.x) - total(self.x + dx) < 1e-12:
                break
            self.x = self.x + dx
        self.refresh()

    def step(self, h, gravity, wind, handles):
        """handles: (node, kappa, target) and (node, node, kappa)."""
        f, _, parts = self.internal(self.x)
        v = self.v.ravel()
        A = np.diag(np.repeat(self.mass, 3))
        force = f + (self.mass[:, None] * gravity).ravel()
        for t, face in enumerate(self.faces):
            nodes = [c[0] for c in face]
            w = wind["velocity"] - self.v[nodes].mean(axis=0)
            n = self.normal[t]
            wn = n @ w
            load = self.area[t] * (wind["density"] * abs(wn) * wn * n + wind["drag"] * (w - wn * n))
            for i in nodes:
                force[3 * i:3 * i + 3] += load / 3
        b = h * force
        for dofs, J, beta in parts:
            A[np.ix_(dofs, dofs)] -= h * (h + beta) * J
            b[dofs] += h * (h + beta) * J @ v[dofs]
        for handle in handles:
            if len(handle) == 3 and not np.isscalar(handle[2]):
                i, kappa, target = handle
                s = slice(3 * i, 3 * i + 3)
                A[s, s] += h * h * kappa * np.eye(3)
                b[s] -= h * kappa * (self.x[i] - target + h * self.v[i])
            else:
                i, j, kappa = handle
                pull = h * kappa * (self.x[i] - self.x[j] + h * (self.v[i] - self.v[j]))
                for p, q, sign in ((i, j, 1), (j, i, -1)):
                    s, r = slice(3 * p, 3 * p + 3), slice(3 * q, 3 * q + 3)
                    A[s, s] += h * h * kappa * np.eye(3)
                    A[s, r] -= h * h * kappa * np.eye(3)
                    b[s] -= sign * pull
        self.v = self.v + np.linalg.solve(A, b).reshape(-1, 3)
        self.refresh()
        self.x = self.x + h * self.v


def rotation(q):
    w, x, y, z = unit(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def pose_of(t, is_rate=False):
    """(translation, scale, quaternion) as 8 numbers."""
    angle, *axis = t.get("rotate", [0, 0, 0, 0])
    q = np.array([1.0, 0, 0, 0])
    if any(axis):
        q = np.concatenate([[math.cos(math.radians(angle) / 2)], math.sin(math.radians(angle) / 2) * unit(np.array(axis, float))])
    elif is_rate:
        q = np.zeros(4)
    return np.concatenate([t.get("translate", [0, 0, 0]), [t.get("scale", 0.0 if is_rate else 1.0)], q])


def pose_at(motion, time):
    X = [pose_of(k.get("transform", {})) for k in motion]
    T = [k["time"] for k in motion]
    V = []
    for i, key in enumerate(motion):
        if "velocity" in key:
            V.append(pose_of(key["velocity"], True))
        elif 0 < i < len(motion) - 1:
            V.append((X[i + 1] - X[i - 1]) / (T[i + 1] - T[i - 1]))
        else:
            V.append(np.zeros(8))
    if time <= T[0]:
        return X[0]
    if time >= T[-1]:
        return X[-1]
    i = max(k for k in range(len(T)) if T[k] <= time)
    d = T[i + 1] - T[i]
    s = (time - T[i]) / d
    return ((1 + 2 * s) * (1 - s) ** 2 * X[i] + s * s * (3 - 2 * s) * X[i + 1] + d * s * (1 - s) ** 2 * V[i] + d * s * s * (s - 1) * V[i + 1])


def apply(pose, x):
    return pose[:3] + pose[3] * rotation(pose[4:]) @ x


def undo(pose, x):
    return rotation(pose[4:]).T @ (x - pose[:3]) / pose[3]


class Handles:
    def __init__(self, scene, cloth, mesh):
        self.scene, self.cloth, self.mesh = scene, cloth, mesh
        self.anchors = {}

    def nodes(self, h):
        return [i for i, l in enumerate(self.mesh["node_label"]) if l == h["label"]] if "label" in h else h["nodes"]

    def springs(self, time):
        out = []
        for number, h in enumerate(self.scene["handles"]):
            start, end, fade = h.get("start_time", 0), h.get("end_time", math.inf), h.get("fade_time", 0)
            strength = 0 if time < start else 1 if time <= end else (1 - (time - end) / fade) ** 4 if time < end + fade else 0
            if strength == 0:
                continue
            kappa = strength * self.scene["magic"]["handle_stiffness"]
            pose = pose_at(self.scene["motions"][h["motion"]], time) if "motion" in h else pose_of({})
            if h.get("type") == "glue":
                out.append((*h["nodes"], kappa))
            elif h.get("type") == "circle":
                r = h["circumference"] / (2 * math.pi)
                for i in self.nodes(h):
                    angle = 2 * math.pi * (np.array(h["u"]) @ self.mesh["vt"][self.mesh["vert_of"][i]]) / h["circumference"]
                    goal = np.array(h["center"]) + r * (math.cos(angle) * np.array(h["axis0"]) + math.sin(angle) * np.array(h["axis1"]))
                    length = sum(np.linalg.norm(self.mesh["vt"][a[1]] - self.mesh["vt"][b[1]]) for a, b in self.mesh["edges"]
                                 if i in (a[0], b[0]) and all(self.mesh["node_label"][c[0]] == h["label"] for c in (a, b)))
                    out.append((i, kappa * length, apply(pose, goal)))
            else:
                if number not in self.anchors:
                    self.anchors[number] = [undo(pose, self.cloth.x[i]) for i in self.nodes(h)]
                out += [(i, kappa, apply(pose, a)) for i, a in zip(self.nodes(h), self.anchors[number])]
        return out


def run(scene, mesh, materials):
    """Positions at the end of every frame."""
    spec = scene["cloths"][0]
    t = pose_of(spec["transform"])
    x = np.array([apply(t, p) for p in mesh["x"]])
    vel = {k: np.array(spec["velocity"].get(k, [0, 0, 0]), float) for k in ("linear", "angular", "origin")}
    v = np.array([vel["linear"] + np.cross(vel["angular"], p - vel["origin"]) for p in x])
    scaled = {**mesh, "vt": mesh["vt"] * t[3]}
    cloth = Cloth(scaled["vt"], x, v, mesh["faces"], mesh["labels"], mesh["damage"], mesh["rest_angle"],
                  [{"density_mult": 1, "stretching_mult": 1, "bending_mult": 1, "thicken": 1, "damping": 0, "weakening": 0, **m,
                    **materials[m["data"]]} for m in spec["materials"]], scene["magic"].get("preserve_creases", False))
    handles = Handles(scene, cloth, scaled)
    cloth.relax()
    handles.springs(0)
    cloth.relax()
    wind = {"density": 1, "drag": 0, "velocity": [0, 0, 0], **scene.get("wind", {})}
    wind["velocity"] = np.array(wind["velocity"], float)
    steps = scene.get("frame_steps", scene.get("save_frames"))
    h = scene["frame_time"] / steps if "frame_time" in scene else scene["timestep"]
    frames, time = [cloth.x], 0.0
    for _ in range(scene.get("end_frame") or round(scene["duration"] / (h * steps))):
        for _ in range(steps):
            time += h
            cloth.step(h, np.array(scene["gravity"]), wind, handles.springs(time))
        frames.append(cloth.x)
    return frames
