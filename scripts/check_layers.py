#!/usr/bin/env python3
"""Reads every #include of ours and fails on one that its room may not use, or on a cycle between files.

Usage: scripts/check_layers.py [PROJECT_DIR]
"""
import re
import sys
from pathlib import Path

# A room may include itself and the rooms listed. arcsim/ never includes formwork/.
ARCSIM = {
    "arcsim/base": [],
    "arcsim/mesh": ["arcsim/base"],
    "arcsim/material": ["arcsim/base", "arcsim/mesh"],
    "arcsim/force": ["arcsim/base", "arcsim/mesh", "arcsim/material"],
    "arcsim/solve": ["arcsim/base", "arcsim/mesh", "arcsim/force"],
    "arcsim/scene": ["arcsim/base", "arcsim/mesh", "arcsim/material", "arcsim/force", "arcsim/solve"],
}
NUMERIC = ["arcsim/base", "arcsim/mesh", "arcsim/material"]       # never forces or solvers
FORMWORK = {
    "formwork/strain": NUMERIC,
    "formwork/flatten": NUMERIC,
    "formwork/segment": NUMERIC + ["formwork/strain", "formwork/flatten", "formwork/mesher"],
    "formwork/lettering": NUMERIC,
    "formwork/panels": NUMERIC + ["formwork/strain", "formwork/flatten", "formwork/segment", "formwork/lettering"],
    "formwork/mesher": NUMERIC,
    "formwork/load": [*ARCSIM],
    "formwork/fabric": [*ARCSIM, "formwork/strain"],
    "formwork/equilibrium": [*ARCSIM, "formwork/load", "formwork/fabric", "formwork/mesher", "formwork/strain"],
    "formwork/sew": [*ARCSIM, "formwork/load", "formwork/fabric", "formwork/equilibrium", "formwork/strain",
                     "formwork/segment", "formwork/panels"],
}
FORMWORK["formwork/scene"] = [*ARCSIM, *FORMWORK]
FORMWORK["formwork/report"] = [*ARCSIM, *FORMWORK]
FORMWORK["formwork/study"] = [*ARCSIM, *FORMWORK]
FORMWORK["formwork/stages"] = [*ARCSIM, *FORMWORK]
FORMWORK["formwork/cli"] = [*ARCSIM, *FORMWORK]                    # arguments and commands
FORMWORK["formwork"] = [*ARCSIM, *FORMWORK]                        # main and the command line
ROOMS = {**ARCSIM, **FORMWORK, "arcsim": [*ARCSIM]}


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#include\s+"((?:arcsim|formwork)/[^"]+)"', line)
        if match:
            yield number, match.group(1)


def find_cycle(graph):
    state, stack = {}, []

    def visit(node):
        state[node] = "open"
        stack.append(node)
        for target in graph.get(node, []):
            if state.get(target) == "open":
                return stack[stack.index(target):] + [target]
            if target not in state:
                cycle = visit(target)
                if cycle:
                    return cycle
        state[node] = "done"
        stack.pop()
        return None

    for node in graph:
        if node not in state:
            cycle = visit(node)
            if cycle:
                return cycle
    return None


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    failures, graph, room_graph = [], {}, {}
    for path in sorted([*root.glob("arcsim/**/*.[ch]pp"), *root.glob("formwork/**/*.[ch]pp")]):
        name = path.relative_to(root).as_posix()
        room = name.rsplit("/", 1)[0]
        if room not in ROOMS:
            failures.append(f"{name}: the room {room}/ is not in the table of scripts/check_layers.py")
            continue
        graph[name] = []
        for number, target in includes(path):
            target_room = target.rsplit("/", 1)[0]
            graph[name].append(target)
            if target_room != room:
                room_graph.setdefault(room, set()).add(target_room)
                if target_room not in ROOMS[room]:
                    failures.append(f"{name}:{number}: {room}/ may not include {target}")
            if not (root / target).exists():
                failures.append(f"{name}:{number}: {target} does not exist")
    for kind, edges in (("files", graph), ("rooms", room_graph)):
        cycle = find_cycle(edges)
        if cycle:
            failures.append(f"cycle between {kind}: " + " -> ".join(cycle))
    for failure in failures:
        print(failure)
    print(f"{len(graph)} files read, {len(failures)} forbidden includes")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
