#!/usr/bin/env python3
"""Every scene in conf/ fits the schema that the program prints, passes `check`, and so does `init`'s."""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import jsonschema

root = Path(__file__).resolve().parents[2]
program = Path(sys.argv[1]) / "formwork"
failures = []


def strip_comments(text):
    """// and /* */ outside strings."""
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or "", text, flags=re.S)


schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
scenes = [p for p in sorted((root / "conf").glob("*.json")) if p.name != "scene.schema.json"]
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([program, "init", f"{folder}/mybag", "-q"], check=True)
    if subprocess.run([program, "init", f"{folder}/mybag", "-q"], capture_output=True).returncode != 2:
        failures.append("init writes over what is there")
    for scene in [*scenes, Path(folder) / "mybag/scene.json"]:
        data = json.loads(strip_comments(scene.read_text()))
        for error in validator.iter_errors(data):
            failures.append(f"{scene.name}: {'/'.join(map(str, error.path))}: {error.message}")
        if not all((scene.parent / cloth["mesh"]).exists() for cloth in data["cloths"]):
            continue   # the bunny is fetched by a script
        run = subprocess.run([program, "check", scene], capture_output=True, text=True)
        if run.returncode != 0:
            failures.append(f"{scene.name}: check: {run.stderr}")
            continue
        # The effective scene reads back to itself.
        effective = run.stdout[:run.stdout.index("\n}\n") + 3]
        again = scene.parent / ("effective-" + scene.name) if scene.parent != root / "conf" else Path(folder) / ("effective-" + scene.name)
        if scene.parent == root / "conf":
            effective = effective.replace('"../', f'"{root}/').replace('"materials/', f'"{root}/conf/materials/')
        again.write_text(effective)
        for error in validator.iter_errors(json.loads(effective)):
            failures.append(f"effective {scene.name}: {'/'.join(map(str, error.path))}: {error.message}")
        if subprocess.run([program, "check", again, "-q"], capture_output=True).returncode != 0:
            failures.append(f"{scene.name}: the effective scene does not pass check")

for bad in ({"cloths": [{"mesh": "a.obj"}], "formwork": {"unit": "m"}}, {"cloths": [{"mesh": 3}]},
            {"cloths": [{"mesh": "a.obj"}], "formwork": {"plaster": {"density": 1, "fill": {"level": 0, "volume": 1}}}}):
    if not list(validator.iter_errors(bad)):
        failures.append(f"the schema accepts {bad}")

for failure in failures:
    print(failure)
print(f"{len(scenes)} scenes, {len(failures)} failures")
sys.exit(1 if failures else 0)
