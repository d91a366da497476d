#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails on an include that climbs from a floor to one above it, on a cycle between files or folders,
and on an algorithm in a header of parameters."""

import os
import re
import sys
from pathlib import Path

# Above the floors that CMakeLists.txt lists, lowest first. A file includes its own floor and those
# before it, nothing else.
ABOVE = ["bindings/c", "bindings/python", "apps/support", "apps/lab", "apps/microswarm", "apps/bench", "tests"]
FLOOR = re.compile(r"^\s*add_subdirectory\((src/microswarm/\w+)\)", re.M)
# These never see each other: only src/microswarm/rig and what is above it joins them.
APART = {f"src/microswarm/{name}" for name in ("navigation", "actuation", "vision")}

# Headers of parameters, up to a scenario's, and what they may include: no algorithm, so that a change
# in a navigator does not compile whoever reads a scenario.
PARAMETERS = re.compile(
    r"src/microswarm/((planning|navigation|swarm)/(\w+/)*((\w+_)?params|\w+_tuning)|formats/map_spec"
    r"|experiment/scenario/scenario)\.hpp")
PLAIN = re.compile(
    r"src/microswarm/(core/.*|geometry/(vec2|shapes)\.hpp|config/type\.hpp|world/obstacles/(motion|obstacle)\.hpp"
    r"|swarm/(robots/contact_rule|body/swarm_limits)\.hpp|navigation/steering/guide_kind\.hpp)")

INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def floors_of(root):
    """The floors, lowest first."""
    return FLOOR.findall((root / "CMakeLists.txt").read_text(encoding="utf-8")) + ABOVE


def floor_of(path, floors):
    """Name of the floor that holds `path` (relative to the root), or None outside the floors."""
    return next((floor for floor in floors if path.startswith(floor + "/")), None)


def resolve(root, file, name):
    """The project's file that `name` means in `file`, as a path from the root; None if foreign."""
    program = "/".join(file.split("/")[:2])
    for candidate in (f"src/{name}", name, f"apps/{name}", f"{program}/{name}",
                      f"{Path(file).parent}/{name}"):
        if (root / candidate).is_file():
            return os.path.normpath(candidate)
    return f"src/{name}" if name.startswith("microswarm/") else None


def read_includes(root, floors):
    """{file: [(line, included file)]} for every C++ file on a floor, paths from the root."""
    includes = {}
    for floor in floors:
        for path in sorted((root / floor).rglob("*.[ch]pp")):
            file = path.relative_to(root).as_posix()
            includes[file] = []
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                target = match and resolve(root, file, match[1])
                if target:
                    includes[file].append((number, target))
    return includes


def climbing(includes, floors):
    """One line for each include of a higher floor, or across floors that stay apart."""
    for file, targets in includes.items():
        here = floor_of(file, floors)
        for line, target in targets:
            there = floor_of(target, floors)
            if there is None:
                yield f"{file}:{line}: {target} is on no floor"
            elif floors.index(there) > floors.index(here):
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


def by_folder(includes):
    """The same for the folders of the library: {folder: [(line, folder)]}, one include each."""
    folders = {}
    for file, targets in includes.items():
        here = str(Path(file).parent)
        for line, target in targets if file.startswith("src/") else []:
            there = str(Path(target).parent)
            if there != here:
                folders.setdefault(here, {}).setdefault(there, f"{Path(file).name}:{line}")
    return {here: [(line, there) for there, line in into.items()] for here, into in folders.items()}


def algorithms(includes):
    """One line for each include of more than parameters in a header of parameters."""
    for file, targets in includes.items():
        for line, target in targets if PARAMETERS.fullmatch(file) else []:
            if not PARAMETERS.fullmatch(target) and not PLAIN.fullmatch(target):
                yield f"{file}:{line}: {target} is more than parameters"


def check(root):
    """All complaints about the tree at `root`."""
    floors = floors_of(Path(root))
    includes = read_includes(Path(root), floors)
    return [*climbing(includes, floors), *cycles(includes), *cycles(by_folder(includes)),
            *algorithms(includes)]


if __name__ == "__main__":
    complaints = check(Path(__file__).resolve().parent.parent)
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)
