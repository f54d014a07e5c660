#!/usr/bin/env python3
"""Reads every pattern file with a reader that is not ours: ezdxf, an XML parser, poppler, the csv and json
modules. Sizes to 0.01 mm, closed curves, layers, texts.

Usage: test_patterns.py BUILD_DIR              patterns of four bags that the tests make
       test_patterns.py --read FOLDER ...     patterns of finished runs: FOLDER/panels
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

import ezdxf

failures = []
SVG = "{http://www.w3.org/2000/svg}"


def check(ok, what):
    if not ok:
        failures.append(what)
        print("FAILED:", what)


def near(a, b, tolerance, what):
    check(abs(a - b) <= tolerance, f"{what}: {a} against {b}")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def rows(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def box(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return max(xs) - min(xs), max(ys) - min(ys)


def length(points):
    return sum(((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2) ** 0.5 for a, b in zip(points, points[1:]))


def path_points(d):
    return [tuple(map(float, p.split(","))) for p in re.findall(r"-?[\d.]+,-?[\d.]+", d)]


def check_svg(folder, panels, seams):
    root = ET.parse(folder / "panels.svg").getroot()
    width, height = root.get("width"), root.get("height")
    check(width.endswith("mm") and height.endswith("mm"), "svg: size in mm")
    view = list(map(float, root.get("viewBox").split()))
    near(view[2], float(width[:-2]), 1e-6, "svg: one user unit is 1 mm")
    near(view[3], float(height[:-2]), 1e-6, "svg: one user unit is 1 mm")
    layers = {g.get("id"): g for g in root.findall(SVG + "g")}
    check(set(layers) == {"cut", "sew", "fold", "notch", "grain", "label", "guide"}, f"svg: layers {sorted(layers)}")
    check(layers["cut"].get("stroke") == "#ff0000" and layers["sew"].get("stroke") == "#0000ff", "svg: red cut, blue sew")
    cuts = layers["cut"].findall(SVG + "path")
    check(len(cuts) == len(panels), "svg: one cut line per panel")
    for path, panel in zip(cuts, panels):
        d = path.get("d")
        check(d.endswith("Z"), f"svg: {panel['name']} is closed")
        points = path_points(d)
        w, h = box(points)
        near(w, float(panel["cut_warp_size_mm"]), 0.01, f"svg: {panel['name']} along the warp")
        near(h, float(panel["cut_weft_size_mm"]), 0.01, f"svg: {panel['name']} along the weft")
        near(length(points + points[:1]), float(panel["cut_perimeter_mm"]), 0.05, f"svg: {panel['name']} perimeter")
        for x, y in points:
            check(0 <= x <= view[2] and 0 <= y <= view[3], "svg: every point on the page")
    for seam in seams:   # the sew line of a seam is as long on both pieces, and as long as the table says
        sides = [p for p in layers["sew" if seam["panel_b"] else "fold"].findall(SVG + "path") if p.get("data-seam") == seam["seam"]]
        check(len(sides) == (2 if seam["panel_b"] else 1), f"svg: sides of {seam['name']}")
        for path in sides:
            near(length(path_points(path.get("d"))), float(seam["length_a_mm"]), 0.02 + 0.0005 * path.get("d").count(" "),
                 f"svg: length of {seam['name']}")
    bar = path_points(next(p for p in layers["guide"] if p.get("id") == "scale-100mm").get("d"))
    near(box(bar)[0], 100, 1e-6, "svg: scale bar")
    written = [t.text for t in layers["label"].iter(SVG + "text")]
    drawn = [p.get("data-text") for p in layers["label"].iter(SVG + "path")]
    check(bool(written) != bool(drawn), "svg: lettering is text or paths")
    labels = " ".join(written + drawn)
    for panel in panels:
        check(f"{panel['name']} of {len(panels)}" in labels, f"svg: label of {panel['name']}")
    styles = [row["first_notch"] for row in seams if row["panel_b"]]
    check(len(set(styles)) == len(styles), "seams: every seam has notches of its own")
    for seam in seams:   # on both pieces: what it is sewn to, and how long it is
        sides = [seam["panel_a"], seam["panel_b"]] if seam["panel_b"] else [""]
        for side in sides:
            text = rf"{seam['name']} > {side}  [\d.]+ mm" if side else rf"{seam['name']} hem  [\d.]+ mm"
            found = re.findall(text, labels)
            check(found, f"svg: label of {seam['name']} to {side}")
            for label in found:
                near(float(label.split()[-2]), float(seam["length_a_mm"]), 0.06, f"svg: length of {seam['name']}")
    for panel in panels:
        alone = ET.parse(folder / "pieces" / f"{panel['name']}.svg").getroot()
        near(float(alone.get("width")[:-2]), float(alone.get("viewBox").split()[2]), 1e-6, "svg: a piece alone is 1:1")
        outline = next(p for p in alone.iter(SVG + "path") if p.get("id") == f"{panel['name']}-cut")
        near(box(path_points(outline.get("d")))[0], float(panel["cut_warp_size_mm"]), 0.01, f"svg: {panel['name']} alone along the warp")
        check(len([p for p in alone.iter(SVG + "path") if (p.get("id") or "").endswith("-cut")]) == 1, "svg: one piece in its file")
    run("rsvg-convert", "-w", "400", str(folder / "panels.svg"), "-o", str(folder / "panels.png"))


def check_dxf(folder, panels):
    document = ezdxf.readfile(folder / "panels.dxf")
    check(document.dxfversion == "AC1009", "dxf: R12")
    check(not document.audit().errors, f"dxf: {[e.message for e in document.audit().errors][:3]}")
    space = document.modelspace()
    for layer in ("CUT", "SEW"):
        lines = space.query(f'POLYLINE[layer=="{layer}"]')
        check(len(lines) == len(panels), f"dxf: {layer} lines")
        for line, panel in zip(lines, panels):
            check(line.is_closed, f"dxf: {layer} of {panel['name']} is closed")
            points = [(v.x, v.y) for v in line.points()]
            check(points[0] != points[-1], "dxf: the first point is not repeated")
            prefix = "cut_" if layer == "CUT" else ""
            near(box(points)[0], float(panel[prefix + "warp_size_mm"]), 0.01, f"dxf: {layer} of {panel['name']} along the warp")
            near(box(points)[1], float(panel[prefix + "weft_size_mm"]), 0.01, f"dxf: {layer} of {panel['name']} along the weft")
    check(len(space.query('LINE[layer=="GRAIN"]')) == len(panels), "dxf: grain lines")
    check(len(space.query('LINE[layer=="NOTCH"]')) > 0, "dxf: notches")
    check({e.dxf.layer for e in space} == {"CUT", "SEW", "NOTCH", "GRAIN", "LABEL"}, "dxf: layers")
    lines = [tuple(sorted(((round(e.dxf.start.x, 3), round(e.dxf.start.y, 3)), (round(e.dxf.end.x, 3), round(e.dxf.end.y, 3)))))
             for e in space.query("LINE")]
    check(len(lines) == len(set(lines)), "dxf: no line twice")
    texts = len(space.query('TEXT[layer=="LABEL"]'))
    check(bool(texts) != bool(len(space.query('POLYLINE[layer=="LABEL"]'))), "dxf: lettering is text or polylines")
    check(document.layers.get("CUT").color == 1 and document.layers.get("SEW").color == 5, "dxf: colours")


def check_astm(folder, panels):
    data = (folder / "panels-astm.dxf").read_bytes()
    check(all(b < 128 for b in data), "astm: 7-bit text")
    check(b"TABLES" not in data and b"MODEL_SPACE" not in data, "astm: no tables, no layout blocks")
    document = ezdxf.readfile(folder / "panels-astm.dxf")
    check(not document.audit().errors, "astm: audit")
    inserts = document.modelspace().query("INSERT")
    check(len(inserts) == len(panels), "astm: one insert per piece")
    style = [t.dxf.text for t in document.modelspace().query("TEXT")]
    check(style[0].startswith("ASTM/D13Proposal") and "Units: METRIC" in style, "astm: style text")
    for insert, panel in zip(inserts, panels):
        check(re.fullmatch(r"[A-Z0-9_]{1,20}", insert.dxf.name), f"astm: block name {insert.dxf.name}")
        block = document.blocks.get(insert.dxf.name)
        layers = {e.dxf.layer for e in block}
        check({"1", "7", "14", "15", "84", "87"} <= layers and layers & {"2", "3"}, f"astm: layers of {panel['name']}: {sorted(layers)}")
        boundary, copy = block.query('POLYLINE[layer=="1"]')[0], block.query('POLYLINE[layer=="84"]')[0]
        check(boundary.is_closed and block.query('POLYLINE[layer=="14"]')[0].is_closed, f"astm: {panel['name']} is closed")
        points = [(v.x, v.y) for v in boundary.points()]
        check(points == [(v.x, v.y) for v in copy.points()], "astm: layer 84 repeats layer 1")
        near(box(points)[0], float(panel["cut_warp_size_mm"]), 0.011, f"astm: {panel['name']} along the warp")
        near(box(points)[1], float(panel["cut_weft_size_mm"]), 0.011, f"astm: {panel['name']} along the weft")
        texts = [t.dxf.text for t in block.query('TEXT[layer=="1"]')]
        check(f"Piece Name: {panel['name']}" in texts and "Quantity: 1" in texts, "astm: piece text")
        marked = len(block.query('POINT[layer=="2"]')) + len(block.query('POINT[layer=="3"]'))
        sewn = len(list(block.query('POLYLINE[layer=="14"]')[0].points()))
        check(marked == len(points) + sewn, "astm: every outline point is a turn or a curve point")


def check_pdf(folder, paper, panels, name):
    file = folder / f"panels-{paper}.pdf"
    info = run("pdfinfo", str(file))
    sizes = {"a4": (210, 297), "a3": (297, 420), "letter": (215.9, 279.4)}
    w, h = map(float, re.search(r"Page size:\s+([\d.]+) x ([\d.]+) pts", info).groups())
    near(w * 25.4 / 72, sizes[paper][0], 0.01, "pdf: page width")
    near(h * 25.4 / 72, sizes[paper][1], 0.01, "pdf: page height")
    pages = int(re.search(r"Pages:\s+(\d+)", info).group(1))
    text = run("pdftotext", "-layout", str(file), "-")
    # Lettering that is turned comes out letter by letter; what runs across glued sheets, in two parts.
    letters = re.sub(r"\s", "", run("pdftotext", "-raw", str(file), "-"))
    check(name in text and "100 mm x 100 mm" in text and "Print at 100 %" in text, "pdf: overview texts")
    check(f"sheet {pages - 1} of {pages - 1}" in text, "pdf: sheets are counted")
    for panel in panels:
        check(f"{panel['name']}of" in letters, f"pdf: label of {panel['name']}")
    # The printed square, measured on the rendered first page.
    dpi = 200
    run("pdftoppm", "-r", str(dpi), "-f", "1", "-l", "1", "-gray", str(file), str(folder / "page"))
    picture = next(folder.glob("page-*.pgm")).read_bytes()
    magic, wide, high, depth, pixels = re.match(rb"(P5)\s+(\d+)\s+(\d+)\s+(\d+)\s(.*)", picture, re.S).groups()
    wide, high = int(wide), int(high)
    dark = lambda x, y: pixels[y * wide + x] < 160
    mm = lambda v: v * dpi / 25.4
    row = high - 1 - round(mm(10 + 5 + 30))   # a row through the square, above its words
    columns = [x for x in range(round(mm(5)), round(mm(130))) if dark(x, row)]
    near((columns[-1] - columns[0]) * 25.4 / dpi, 100, 0.2, "pdf: the square is 100 mm wide")


def check_tables(folder, panels, seams, litres):
    data = json.loads((folder / "seams.json").read_text())
    check(data["units"] == "mm" and len(data["seams"]) == len(seams), "json: seams")
    for entry, row in zip(data["seams"], seams):
        check(entry["name"] == row["name"], "json: names")
        near(entry["sides"][0]["length_mm"], length(entry["sides"][0]["points_mm"]), 1e-6, "json: lengths are those of the points")
        if row["panel_b"]:
            check(float(row["mismatch_between_notches"]) < 0.002, f"seams: {row['name']} matches within 0.2 %")
            cuts = [0.0, *entry["notches"], 1.0]
            gaps = [(b - a) * float(row["length_a_mm"]) for a, b in zip(cuts, cuts[1:])]
            check(max(gaps) <= 100, f"notches of {row['name']} are at most 100 mm apart")
            seam_mm = float(row["length_a_mm"])
            check(all(abs(a - (1 - b)) * seam_mm > min(4, seam_mm / 4) for a in entry["notches"] for b in entry["notches"]),
                  f"notches of {row['name']} cannot be read backwards")
    check(sorted(name for s in data["assembly"] for name in s["seams"]) == sorted(row["name"] for row in seams), "json: every seam has its step")
    check([s["step"] for s in data["assembly"]] == list(range(1, len(data["assembly"]) + 1)), "json: steps are numbered")
    faces = rows(folder / "faces.csv")
    check([int(f["face"]) for f in faces] == list(range(sum(int(p["faces"]) for p in panels))), "faces: every face of the cut mesh once")
    for row in panels:
        own = [float(f["distortion"]) for f in faces if f["panel"] == row["name"]]
        near(max(own), float(row["max_distortion"]), 1e-3 * max(own) + 1e-9, f"faces: largest distortion of {row['name']}")
        check(int(row["flips"]) == 0 and int(row["overlaps"]) == 0, "panels: no flips, no overlaps")
    bill = {row["item"]: row for row in rows(folder / "bom.csv")}
    if litres:
        near(float(bill["liquid"]["quantity"]), litres, 1e-6, "bom: litres")
    area = sum(float(p["cut_area_m2"]) for p in panels)
    near(float(bill["fabric_area"]["quantity"]), area, 1e-4 * area, "bom: area")


def check_sewn_rest(folder, panels):
    """vt are the panels in metres: each group's area is the panel's."""
    verts, groups, group = [], {}, None
    nodes = 0
    for line in (folder / "sewn_rest.obj").read_text().splitlines():
        words = line.split()
        if words[:1] == ["vt"]:
            verts.append((float(words[1]), float(words[2])))
        elif words[:1] == ["v"]:
            nodes += 1
        elif words[:1] == ["g"]:
            group = words[1]
        elif words[:1] == ["f"]:
            a, b, c = (verts[int(w.split("/")[1]) - 1] for w in words[1:4])
            area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
            check(area > 0, "obj: faces are counter-clockwise in the plane")
            groups[group] = groups.get(group, 0) + area
    check(len(verts) >= nodes, "obj: nodes are shared")
    for panel in panels:
        near(groups[panel["name"]], float(panel["area_m2"]), 1e-6, f"obj: area of {panel['name']}")


def check_folder(place, name, litres=None):
    panels, seams = rows(place / "panels.csv"), rows(place / "seams.csv")
    check_svg(place, panels, seams)
    check_dxf(place, panels)
    check_astm(place, panels)
    for file in place.glob("panels-*.pdf"):
        if file.stem != "panels-a0":
            check_pdf(place, file.stem.split("-")[1], panels, name)
    check_tables(place, panels, seams, litres)
    check_sewn_rest(place, panels)
    check(not list(place.glob("*.tmp*")), "no temporary files are left")


def main():
    with tempfile.TemporaryDirectory() as folder:
        if sys.argv[1] == "--read":
            for run_folder in map(Path, sys.argv[2:]):
                place = Path(folder) / run_folder.name
                shutil.copytree(run_folder / "panels", place)
                check_folder(place, run_folder.name)
                print(run_folder, "read")
        else:
            program = Path(sys.argv[1]) / "tests" / "test_formwork"
            subprocess.run([program, "[.write-patterns]"], check=True, env={**os.environ, "PATTERN_FOLDER": folder}, stdout=subprocess.DEVNULL)
            for name, papers in (("sphere", {"a4"}), ("pieces24", {"a4"}), ("column", {"a3"}), ("dart", {"letter", "a0"})):
                place = Path(folder) / name
                check({f.stem.split("-")[1] for f in place.glob("panels-*.pdf")} == papers, "pdf: one file per paper that was asked for")
                check_folder(place, name, litres=12.3)
    print("no failures" if not failures else f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
