#!/usr/bin/env python3
"""Every row of the list of failures, with the default settings: each converges to its reference or stops with the message
that it asks for (scripts/stability_atlas), and stiff stitches hold panels as sharing their nodes does."""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parents[2]
build = Path(sys.argv[1])

with tempfile.TemporaryDirectory() as folder:
    done = subprocess.run([sys.executable, root / "scripts/stability_atlas", "-o", folder, "--formwork", build / "formwork", "--methods", "default",
                           "--timeout", "120"], capture_output=True, text=True)
    with open(Path(folder) / "atlas.csv") as table:
        rows = {row["case"].partition(" ")[0]: row for row in csv.DictReader(table)}
print(done.stdout[-6000:], done.stderr[-2000:])
missing = [str(n) for n in range(1, 19) if not any(name.rstrip("abc") == str(n) for name in rows)]
if missing:
    print("rows without a case:", ", ".join(missing))
stitched, shared = (float(rows[name]["depth_m"]) for name in ("3a", "3b"))
print(f"depth with stitches {stitched}, with shared nodes {shared}")
sys.exit(done.returncode != 0 or bool(missing) or abs(stitched / shared - 1) > 1e-4)
