#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on an include that climbs from a floor to one above it, on a cycle between files, and on an
algorithm in a header of parameters."""

import os
import re
import sys
from pathlib import Path

# Lowest first. A file includes its own floor and those before it in this list, nothing else.
FLOORS = [
    "src/microswarm/core",
    "src/microswarm/geometry",
    "src/microswarm/config",
    "src/microswarm/world",
    "src/microswarm/formats",
    "src/microswarm/swarm",
    "src/microswarm/planning",
    "src/microswarm/navigation",
    "src/microswarm/actuation",
    "src/microswarm/vision",
    "src/microswarm/experiment",
    "src/microswarm/learning",
    "src/microswarm/rig",
    "src/microswarm/sweep",
    "src/microswarm/report",
    "tests/scenes",
    "bench",
    "apps",
    "tests",
]
# These never see each other: only src/microswarm/rig and what is above it joins them.
APART = {f"src/microswarm/{name}" for name in ("navigation", "actuation", "vision")}

# Headers of parameters, up to a scenario's, and what they may include: no algorithm, so that a change
# in a navigator does not compile whoever reads a scenario.
PARAMETERS = re.compile(
    r"src/microswarm/((planning|navigation|swarm)/(\w+_)?params|formats/map_spec|experiment/scenario)\.hpp")
PLAIN = re.compile(
    r"src/microswarm/(core/.*|geometry/(vec2|shapes)\.hpp|config/type\.hpp|world/(motion|obstacle)\.hpp"
    r"|swarm/(contact_rule|swarm_limits)\.hpp|navigation/guide_kind\.hpp)")

INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def floor_of(path):
    """Name of the floor that holds `path` (relative to the root), or None outside the floors."""
    return next((floor for floor in FLOORS if path.startswith(floor + "/")), None)


def resolve(root, file, name):
    """The project's file that `name` means in `file`, as a path from the root; None if foreign."""
    for candidate in (f"src/{name}", name, f"{Path(file).parent}/{name}"):
        if (root / candidate).is_file():
            return os.path.normpath(candidate)
    return f"src/{name}" if name.startswith("microswarm/") else None


def read_includes(root):
    """{file: [(line, included file)]} for every C++ file on a floor, paths from the root."""
    includes = {}
    for floor in FLOORS:
        for path in sorted((root / floor).rglob("*.[ch]pp")):
            file = path.relative_to(root).as_posix()
            includes[file] = []
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                target = match and resolve(root, file, match[1])
                if target:
                    includes[file].append((number, target))
    return includes


def climbing(includes):
    """One line for each include of a higher floor, or across floors that stay apart."""
    for file, targets in includes.items():
        here = floor_of(file)
        for line, target in targets:
            there = floor_of(target)
            if there is None:
                yield f"{file}:{line}: {target} is on no floor"
            elif FLOORS.index(there) > FLOORS.index(here):
                yield f"{file}:{line}: {here} climbs to {there}"
            elif here != there and {here, there} <= APART:
                yield f"{file}:{line}: {here} and {there} stay apart"


def cycles(includes):
    """One line for each include that closes a cycle of files."""
    done, trail = set(), []

    def visit(file):
        trail.append(file)
        for line, target in includes.get(file, []):
            if target in trail:
                ring = trail[trail.index(target):] + [target]
                yield f"{file}:{line}: cycle " + " -> ".join(ring)
            elif target not in done:
                yield from visit(target)
        done.add(trail.pop())

    for file in includes:
        if file not in done:
            yield from visit(file)


def algorithms(includes):
    """One line for each include of more than parameters in a header of parameters."""
    for file, targets in includes.items():
        for line, target in targets if PARAMETERS.fullmatch(file) else []:
            if not PARAMETERS.fullmatch(target) and not PLAIN.fullmatch(target):
                yield f"{file}:{line}: {target} is more than parameters"


def check(root):
    """All complaints about the tree at `root`."""
    includes = read_includes(Path(root))
    return [*climbing(includes), *cycles(includes), *algorithms(includes)]


if __name__ == "__main__":
    complaints = check(Path(__file__).resolve().parent.parent)
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)
