#!/usr/bin/env python3
"""README and docs/: every command in them is run in the order in which it stands, every file that they show is written,
every link leads somewhere, and docs/scene.md is what the program prints."""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

build = Path(sys.argv[1]).resolve()
project = Path(__file__).resolve().parents[2]
pages = [project / "README.md", *sorted((project / "docs").glob("*.md"))]
environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
failures = []

# These install, build or run all tests: continuous integration runs them as they stand (.ci/run).
not_here = ("scripts/demo", "scripts/test")


def run_page(page, folder):
    """A page's commands share one folder in which the project's own folders appear."""
    for name in ("conf", "meshes", "scripts", "docs"):
        (folder / name).symlink_to(project / name)
    (folder / "build").symlink_to(build)
    for info, body in re.findall(r"^```(\w+[^\n]*)\n(.*?)^```", page.read_text(), re.M | re.S):
        language, _, target = info.partition(" ")
        if language == "json" and target:
            (folder / target).write_text(body)
        for line in body.splitlines() if language == "sh" else []:
            command, _, remark = line.partition("  #")
            if not command.strip():
                continue
            if command.strip() in not_here:
                if subprocess.run(["bash", "-n", project / command.strip()]).returncode != 0:
                    failures.append(f"{page.name}: {command}: not a script")
                continue
            expected = int(re.search(r"exit (\d+)", remark).group(1)) if "exit " in remark else 0
            run = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, timeout=1200, env=environment)
            print(f"{page.name}: {command.strip()} -> {run.returncode}")
            if run.returncode != expected:
                failures.append(f"{page.name}: {command.strip()}: exit {run.returncode}, expected {expected}: {run.stderr.strip()[-600:]}")
            if expected:   # the page quotes what is printed: "…" stands for the rest of a line
                said = run.stdout + run.stderr
                for quoted in re.findall(r"^    ((?:warning|formwork): [^\n]*)", page.read_text(), re.M):
                    if quoted.rstrip("…").strip() not in said:
                        failures.append(f"{page.name}: the program does not print \"{quoted}\" but:\n{said[-900:]}")


for page in pages:
    for link in re.findall(r"\]\(([^)#]+)\)", page.read_text()):
        if "://" not in link and not (page.parent / link).exists():
            failures.append(f"{page.name}: {link} does not exist")
    with tempfile.TemporaryDirectory() as folder:
        run_page(page, Path(folder))

for name in re.findall(r"`(scripts/[\w./]+)", "".join(p.read_text() for p in pages)):
    if not (project / name).exists():
        failures.append(f"{name} is named but does not exist")
printed = subprocess.run([build / "formwork", "schema", "--markdown"], capture_output=True, text=True, check=True).stdout
if printed != (project / "docs" / "scene.md").read_text():
    failures.append("docs/scene.md is not current. Run: build/formwork schema --markdown -o docs/scene.md")

for failure in failures:
    print("FAIL " + failure)
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
