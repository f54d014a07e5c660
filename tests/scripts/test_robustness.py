#!/usr/bin/env python3
"""Ctrl-C, kill, a full disk, a read-only folder, hostile names: earlier results stay whole, messages say what to do."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

failures = []
work = Path(tempfile.mkdtemp())
work.chmod(0o755)   # another user runs the program in the read-only case, and may not enter where it was built
program = Path(shutil.copy(Path(sys.argv[1]) / "formwork", work / "formwork"))
environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}


def expect(ok, what):
    print(("ok    " if ok else "FAIL  ") + what)
    if not ok:
        failures.append(what)


def formwork(*arguments, **options):
    return subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True, timeout=900, env=environment, **options)


def snapshot(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(Path(folder).rglob("*")) if p.is_file()}


def is_whole(folder):
    """Every file of a folder reads to its end; nothing half-written lies under a final name."""
    for file in Path(folder).rglob("*"):
        if not file.is_file() or file.suffix == ".tmp":
            continue
        if file.suffix == ".json":
            json.loads(file.read_text())
        elif file.suffix in (".obj", ".csv") and not file.read_bytes().endswith(b"\n"):
            return False
    return True


def figures(folder):
    """The numbers of summary.json that do not depend on the clock or the machine's memory."""
    summary = json.loads((folder / "summary.json").read_text())
    for stage in summary.values():
        for key in ("wall_s", "cpu_s", "peak_rss_mb"):
            stage.pop(key, None)
    return summary


def make_scene(folder, mesh="bag.obj", **changes):
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([str(program), "mesh", "vase", "--edge", "0.014", "-q", "-o", str(folder / "bag.obj")], check=True)
    f = {"fixed": [{"boundary": "top"}], "plaster": {"density": 1500, "fill": {"depth_below_rim": 0.005}}}
    f.update(changes)
    (folder / "bag.json").write_text(json.dumps({"cloths": [{"mesh": mesh}], "formwork": f}))
    return folder / "bag.json"


scene = make_scene(work / "scene")
reference = work / "reference"
run = formwork("run", scene, "-o", reference)
expect(run.returncode in (0, 3), f"the reference runs to its end (exit {run.returncode})")


def stopped_after_inflate(out, send):
    """Starts a run and sends a signal as soon as the first stage is in summary.json. Returns exit code and stderr."""
    process = subprocess.Popen([str(program), "run", str(scene), "-o", str(out)], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=environment)
    finished = out / "finished.json"
    while process.poll() is None and not (finished.exists() and '"inflate"' in finished.read_text()):
        time.sleep(0.002)
    process.send_signal(send)
    return process.wait(timeout=900), process.stderr.read()


# ---- Ctrl-C, then --resume
out = work / "interrupted"
code, errors = stopped_after_inflate(out, signal.SIGINT)
expect(code == 130, f"Ctrl-C ends with 130 (got {code})")
expect("--resume" in errors, "and says how to go on")
expect(not list(out.rglob("*.tmp")), "and leaves no temporary file")
expect(list(figures(out)) == ["inflate"], "the finished stage is in summary.json, no other")
results = ("inflated.obj", "rest.obj", "strain.csv")   # the report adds viewer files beside them
before = [(out / "inflate" / name).stat().st_mtime_ns for name in results]
run = formwork("run", scene, "-o", out, "--resume")
expect("inflate: already finished" in run.stderr, "--resume keeps the finished stage")
expect([(out / "inflate" / name).stat().st_mtime_ns for name in results] == before, "and does not touch its files")
expect(figures(out) == figures(reference), "the resumed run ends with the same figures")
run = formwork("run", scene, "-o", out, "--resume")
expect(run.stderr.count("already finished") >= 4, "a second --resume has nothing to do")
run = formwork("inflate", scene, "-o", out, "--resume", "--set", "plaster.density=1600")
expect("already finished" not in run.stderr, "--resume of a changed scene computes again")

# ---- kill -9
out = work / "killed"
code, _ = stopped_after_inflate(out, signal.SIGKILL)
expect(code == -signal.SIGKILL and is_whole(out), "kill -9 leaves whole files")
run = formwork("run", scene, "-o", out, "--resume")
expect("inflate: already finished" in run.stderr and figures(out) == figures(reference), "--resume goes on after kill -9")
for moment in (0.05, 0.15, 0.3, 0.5):
    process = subprocess.Popen([str(program), "run", str(scene), "-o", str(out)], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, env=environment)
    time.sleep(moment)
    process.kill()
    process.wait()
    expect(is_whole(out), f"killed after {moment} s over earlier results: every file is whole")

# ---- the output folder keeps what the program did not write
out = work / "shared"
(out / "inflate").mkdir(parents=True)
(out / "panels").mkdir()
mine = {"notes.txt": b"mine", "inflate/photo.jpg": b"\xff\xd8", "panels/P01.svg.bak": b"old"}
for name, content in mine.items():
    (out / name).write_bytes(content)
formwork("run", scene, "-o", out, "--to", "panels")
formwork("run", scene, "-o", out, "--to", "inflate")
expect(all((out / name).read_bytes() == content for name, content in mine.items()), "files of others in the output folder stay")

# ---- places that cannot be written
(work / "a_file").write_text("x")
run = formwork("run", scene, "-o", work / "a_file")
expect(run.returncode == 2 and "a_file" in run.stderr and (work / "a_file").read_text() == "x", f"an output folder that is a file is refused: {run.stderr.strip()}")
run = subprocess.run(f"{program} schema > /dev/full", shell=True, capture_output=True, text=True)
expect(run.returncode == 2 and "No space left" in run.stderr, f"output that cannot be written is an error: {run.returncode} {run.stderr.strip()}")
out = work / "read_only"
shutil.copytree(reference, out)
before = snapshot(out)
as_nobody = {}
if os.geteuid() == 0:
    as_nobody = {"user": 65534, "cwd": work}   # root writes everywhere
for folder in (out, *[p for p in out.rglob("*") if p.is_dir()]):
    folder.chmod(0o555)
run = formwork("run", scene, "-o", out, **as_nobody)
expect(run.returncode == 2 and "Permission denied" in run.stderr and "-o" in run.stderr, f"a read-only folder: {run.stderr.strip()}")
expect(snapshot(out) == before, "and its results stay")
for folder in (out, *[p for p in out.rglob("*") if p.is_dir()]):
    folder.chmod(0o755)

# ---- a full disk
disk = work / "disk"
disk.mkdir()
mounted = os.geteuid() == 0 and subprocess.run(["mount", "-t", "tmpfs", "-o", "size=12m", "tmpfs", str(disk)], capture_output=True).returncode == 0
if mounted:
    try:
        out = disk / "out"
        formwork("run", scene, "-o", out)
        space = os.statvfs(disk)
        (disk / "ballast").write_bytes(b"\0" * (space.f_bavail * space.f_bsize - 20_000))
        run = formwork("run", scene, "-o", out, "--set", "plaster.density=1600")
        expect(run.returncode == 2 and "No space left on device" in run.stderr and "free space" in run.stderr, f"a full disk: {run.stderr.strip()}")
        expect(is_whole(out) and not list(out.rglob("*.tmp")), "and every file is whole, no temporary file stays")
        (disk / "ballast").unlink()
        run = formwork("run", scene, "-o", out, "--resume")
        expect(figures(out) == figures(reference), "with space again, --resume gives the right figures")
    finally:
        subprocess.run(["umount", str(disk)], check=True)
else:
    print("skip  a full disk: needs root and mount")

# ---- names from files are names, never paths, commands or markup
folder = work / "names"
hostile = make_scene(folder, fixed=[{"group": "../../escaped"}], report={"title": "</script><script>alert(1)</script>"})
lines = (folder / "bag.obj").read_text().splitlines()
height = max(float(line.split()[3]) for line in lines if line.startswith("v "))
top = {i for i, line in enumerate((x for x in lines if x.startswith("v ")), 1) if abs(float(line.split()[3]) - height) < 1e-9}
faces = [line for line in lines if line.startswith("f ")]
at_rim = [f for f in faces if any(int(c.split("/")[0]) in top for c in f.split()[1:])]
rest = [f for f in faces if f not in at_rim]
(folder / "bag.obj").write_text("\n".join(["o $(touch pwned)", *[x for x in lines if x.startswith("v")], "g ../../escaped", *at_rim,
                                           "g $(touch pwned); `touch pwned` <img src=x onerror=alert(2)>", *rest, ""]))
shutil.copy(folder / "bag.json", folder / "$(touch pwned).json")
before_outside = set(os.listdir(work))
run = formwork("run", "$(touch pwned).json", cwd=folder)
written = set(snapshot(folder / "out" / "$(touch pwned)"))
expect(run.returncode in (0, 3), f"hostile names run (exit {run.returncode}: {run.stderr.strip()[-200:]})")
named = [name for name in written if re.search(r"pwned|escaped|onerror", name)]
expect(not named, f"no file is named after them: {named}")
expect(set(os.listdir(work)) == before_outside and not list(work.rglob("pwned")), "nothing is written elsewhere, nothing is executed")
report = (folder / "out" / "$(touch pwned)" / "report.html").read_text()
expect("<script>alert" not in report and "<img src=x" not in report, "and they are text in the report, not markup")

shutil.rmtree(work)
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
