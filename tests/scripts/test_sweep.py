#!/usr/bin/env python3
"""A sweep that is killed goes on where it was: nothing lost, nothing run twice, failed points are rows."""
import csv
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

program = Path(sys.argv[1]) / "formwork"
work = Path(tempfile.mkdtemp())
out = work / "out"


def formwork(*arguments, expect=0):
    run = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True, timeout=300)
    assert run.returncode == expect, (arguments, run.returncode, run.stderr)
    return run


def stamps():
    return {p.parent.name: p.stat().st_mtime_ns for p in out.glob("points/*/status.json")}


def rows():
    with open(out / "results.csv", newline="") as table:
        return list(csv.DictReader(table))


def still_running():
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = entry.read_bytes().split(b"\0")
        except OSError:
            continue
        if any(str(out).encode() in w for w in words):
            return True
    return False


formwork("mesh", "sock", "--radius", 0.03, "--height", 0.08, "--edge", 0.003, "-o", work / "sock.obj")
(work / "scene.json").write_text(json.dumps({
    "cloths": [{"mesh": "sock.obj"}],
    "formwork": {"fixed": [{"boundary": "top"}], "plaster": {"density": 1000, "fill": {"depth_below_rim": 0.01}},
                 "inflate": {"material": {"model": "isotropic", "rest": [300, 2, 300, 37.5], "max": [600, 2, 600, 75]}}}}))
(work / "sweep.json").write_text(json.dumps({
    "scene": "scene.json", "to": "inflate", "processes": 2,
    "parameters": [{"key": "plaster.density", "values": [500, 800, 1100, 1400, -1]}],
    "charts": [{"x": "plaster.density", "y": "inflate.max_stretch"}, {"x": "plaster.density", "y": "inflate.max_strech"}]}))

# Killed as soon as one point is finished.
sweep = subprocess.Popen([str(program), "sweep", str(work / "sweep.json"), "-o", str(out), "--quiet"])
while not stamps() and sweep.poll() is None:
    time.sleep(0.01)
sweep.send_signal(signal.SIGKILL)
sweep.wait()
for _ in range(200):
    if not still_running():
        break
    time.sleep(0.05)
assert not still_running(), "points went on after their sweep was killed"
before = stamps()

# Goes on: exit code 3, since one point has a density below zero.
run = formwork("sweep", work / "sweep.json", "-o", out, expect=3)
assert "Did you mean \"inflate.max_stretch\"" in run.stderr, run.stderr
after = stamps()
assert len(after) == 5, after
assert all(after[k] == before[k] for k in before), "a finished point ran twice"
table = rows()
assert [r["status"] for r in table] == ["done"] * 4 + ["wrong input"], table
assert "/formwork/plaster/density" in table[4]["message"], table[4]
stretches = [float(r["inflate.max_stretch"]) for r in table[:4]]
assert stretches == sorted(stretches) and stretches[0] > 1, stretches
charts = list((out / "charts").glob("*.png"))
assert [c.name for c in charts] == ["inflate-max_stretch_over_plaster-density.png"], charts

# Once more: nothing to do; one point alone: neither.
formwork("sweep", work / "sweep.json", "-o", out, "--quiet", expect=3)
formwork("sweep", work / "sweep.json", "-o", out, "--point", 0)
formwork("sweep", work / "sweep.json", "-o", out, "--point", 4, expect=2)
assert stamps() == after, "a finished point ran twice"

# Another mesh under the same name: every point is run again.
formwork("mesh", "sock", "--radius", 0.031, "--height", 0.08, "--edge", 0.004, "-o", work / "sock.obj")
formwork("sweep", work / "sweep.json", "-o", out, "--point", 0)
assert stamps()["0000"] != after["0000"], "a changed mesh went unnoticed"
formwork("sweep", work / "sweep.json", "-o", out, "--collect", "--quiet")
assert [r["status"] for r in rows()] == ["done"] + ["missing"] * 4, rows()
print("0 failures")
