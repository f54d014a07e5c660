"""Draws the tables of scripts/chart_speed_accuracy: methods (a panel a case, Pareto front marked) and settings."""
import csv

COLOURS = {"static": "#0b6e4f", "backward_euler": "#c8452f", "newton_euler": "#2f6fc8", "bdf2": "#8a4fc8",
           "dynamic_relaxation": "#d99a1c", "projective": "#444444"}
MARKERS = {"static": "o", "backward_euler": "s", "newton_euler": "^", "bdf2": "v", "dynamic_relaxation": "D", "projective": "P"}
LEAST = 1e-10   # errors below are drawn there


def value(row, key):
    return float(row[key]) if row[key] else None


def worst(row):
    """The larger of the errors of depth and volume: one of them alone may pass through zero on its way."""
    return max(LEAST, float(row["error"]), float(row["volume_error"] or 0))


def pareto(points):
    """The points that no other beats in both time and error, by rising time."""
    front, best = [], float("inf")
    for t, e in sorted(points):
        if e < best:
            front.append((t, e))
            best = e
    return front


def frame(axis, title, xlabel="CPU time, s", ylabel="largest error, depth or volume"):
    from matplotlib.ticker import NullFormatter
    axis.set(xscale="log", yscale="log", title=title)
    for side in (axis.xaxis, axis.yaxis):
        side.set_minor_formatter(NullFormatter())
    axis.title.set_fontsize(10)
    axis.set_xlabel(xlabel, fontsize=8)
    axis.set_ylabel(ylabel, fontsize=8)
    axis.tick_params(labelsize=7)
    axis.grid(alpha=0.25, which="major")


def mark_failures(axis, failures):
    """Failed runs stand in a row above the plot, with what they were."""
    for k, text in enumerate(failures):
        axis.text(0.99, 0.985 - 0.042 * k, f"✕ {text}", transform=axis.transAxes, ha="right", va="top", fontsize=5.5, color="#a01515")


def methods_panel(axis, title, rows):
    frame(axis, title)
    good = [r for r in rows if r["status"] == "ok"]
    for method in COLOURS:
        own = [r for r in good if r["method"] == method]
        axis.plot([value(r, "cpu_s") for r in own], [worst(r) for r in own], MARKERS[method], color=COLOURS[method],
                  markersize=4.5, alpha=0.8, label=method.replace("_", " "), linestyle="none")
    front = pareto([(value(r, "cpu_s"), worst(r)) for r in good])
    axis.step([t for t, _ in front], [e for _, e in front], where="post", color="black", linewidth=1, label="Pareto front")
    low, high = axis.get_ylim()
    if high < 20 * low:   # equal errors: do not blow up their last digits
        axis.set_ylim(low / 5, high * 5)
    failed = [f"{r['method'].replace('_', ' ')} {r['settings']}, {r['vertices']}: {r['status']}" for r in rows if r["status"] != "ok"]
    mark_failures(axis, list(dict.fromkeys(failed)))


def series_panel(axis, title, rows, label_of, x="cpu_s", y="error"):
    """One line per label, through the meshes or tolerances."""
    frame(axis, title, "vertices" if x == "vertices" else "CPU time, s", {"cpu_s": "CPU time, s", "error": "error of the depth", "worst": "largest error, depth or volume",
                                                                        "volume_error": "error of the volume"}[y])
    rows = [r | {"worst": str(worst(r)) if r["error"] else ""} for r in rows]
    good = [r for r in rows if r["status"] == "ok" and r[y] and r[x]]
    labels = list(dict.fromkeys(map(label_of, good)))
    for k, label in enumerate(labels):
        own = [r for r in good if label_of(r) == label]
        axis.plot([value(r, x) for r in own], [max(value(r, y), LEAST) for r in own], marker="osD^vPX<>*hd"[k % 12], markersize=4, linewidth=1, label=label)
    failed = [f"{label_of(r)}, {r['vertices']}: {r['status']}" for r in rows if r["status"] != "ok"]
    mark_failures(axis, list(dict.fromkeys(failed)))
    if labels:
        axis.legend(fontsize=5, framealpha=0.6)


def dynamic_panel(axis, path):
    """Motion, not rest: a sheet that swings down, ArcSim's published cost per step beside ours (docs/time_steps)."""
    frame(axis, "motion: sheet that swings down, 441 nodes", ylabel="largest node error at 0.4 s, m")
    if not path.exists():
        return
    with open(path) as lines:
        rows = [r for r in csv.DictReader(lines) if r["scene"] == "hang_iso" and float(r["t_s"]) == 0.4 and r["max_error_m"] and float(r["max_error_m"]) > 0]
    with open(path.parent / "arcsim_published.csv") as lines:
        published = [r for r in csv.DictReader(lines) if r["scene"] == "hang_iso" and float(r["t_s"]) == 0.4]
    for method in ("backward_euler", "newton_euler", "bdf2"):
        own = [r for r in rows if r["method"] == method]
        axis.plot([value(r, "cpu_s") for r in own], [value(r, "max_error_m") for r in own], MARKERS[method] + "-", color=COLOURS[method],
                  markersize=4, linewidth=1, label=method.replace("_", " ") + (" (ArcSim's step)" if method == "backward_euler" else ""))
    axis.plot([1e-3 * value(r, "cpu_ms_per_step") * 0.4 / value(r, "h_s") for r in published], [value(r, "max_error_m") for r in published], "o--",
              color="0.5", markersize=4, linewidth=1, label="ArcSim 0.2.1, as published")
    axis.legend(fontsize=6)


def draw(rows, time_steps, folder):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    def of(*studies, **fixed):
        return [r for r in rows if r["study"] in studies and all(r[k] == v for k, v in fixed.items())]

    cases = list(dict.fromkeys(r["case"] for r in of("methods", "large scene")))
    columns = 3
    lines = -(-(len(cases) + 1) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns, 3.7 * lines))
    for axis, case in zip(axes.flat, cases):
        title = "column, as large as a building's: against the static method" if case == "column" else case
        methods_panel(axis, title, of("methods", "mesh", "tolerance", "large scene", case=case))
    dynamic_panel(axes.flat[len(cases)], time_steps)
    for axis in axes.flat[len(cases) + 1:]:
        axis.set_visible(False)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=len(labels), fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0, 1, 0.97))
    save(figure, folder / "methods")

    figure, axes = plt.subplots(3, 3, figsize=(14.5, 11.5))
    case_of = lambda r: r["case"]
    series_panel(axes[0][0], "mesh: error", of("mesh", threads="1"), case_of, x="vertices", y="worst")
    series_panel(axes[0][1], "mesh: time", of("mesh", threads="1"), case_of, x="vertices", y="cpu_s")
    series_panel(axes[0][2], "tolerance of the residual 0.1 to 1e-8, disk", of("tolerance", case="filled disk"), lambda r: r["method"].replace("_", " "), y="worst")
    series_panel(axes[1][0], "load: depth", of("load"), lambda r: f"{r['case']}, {r['settings'][5:]}", x="vertices")
    series_panel(axes[1][1], "load: volume", of("load"), lambda r: f"{r['case']}, {r['settings'][5:]}", x="vertices", y="volume_error")
    bars(axes[1][2], "pressure Jacobian, sock, 1000 vertices", of("Jacobian", case="sock"))
    bars(axes[2][0], "linear solver, filled disk, largest mesh", largest(of("linear solver", case="filled disk")))
    bars(axes[2][1], "sampling and compression, 4000 vertices", largest(of("sampling")) + largest(of("compression")))
    bars(axes[2][2], "threads, filled disk: CPU time of all", of("threads"), "threads")
    figure.tight_layout()
    save(figure, folder / "settings")


def largest(rows):
    most = max((int(r["vertices"]) for r in rows), default=0)
    return [r for r in rows if int(r["mesh"]) >= 0.8 * most or int(r["vertices"]) == most]


def bars(axis, title, rows, labels_by="settings"):
    key = "cpu_s"
    axis.set_title(title, fontsize=10)
    several = len({r["case"] for r in rows}) > 1
    labels = [(f"{r['case'].split(',')[0]}: " if several else r["method"].replace("_", " ") + ", ") + r["settings"].partition(" ")[2]
              for r in rows] if labels_by == "settings" else [f"{r['vertices']} vertices, {r['threads']} thread" + "s" * (r["threads"] != "1") for r in rows]
    axis.barh(range(len(rows)), [value(r, key) or 0 for r in rows], color=[COLOURS[r["method"]] for r in rows], height=0.7)
    for k, r in enumerate(rows):
        text = f" {float(r[key]):.3g} s, error {worst(r):.1e}" if r["status"] == "ok" else f" ✕ {r['status']}"
        axis.text(value(r, key) or 0, k, text, va="center", fontsize=6, color="black" if r["status"] == "ok" else "#a01515")
    axis.set_yticks(range(len(rows)), labels, fontsize=5.5)
    axis.invert_yaxis()
    axis.margins(x=0.35)
    axis.set_xlabel("CPU time, s", fontsize=8)
    axis.tick_params(axis="x", labelsize=7)


def save(figure, path):
    figure.savefig(path.with_suffix(".png"), dpi=85)
    figure.savefig(path.with_suffix(".svg"))
    print(path.with_suffix(".png"), path.with_suffix(".svg"))
