#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Environments for learning beside their rules with NumPy: steps a second, of one and of 1,024 at once (`copy=False`).

    PYTHONPATH=build/release/python /usr/bin/python3 bench/environments.py [--quick] [--csv FILE]

The peer is tests/python/gathering_reference.py, whole arrays at a time, as the benchmark's own package works; that needs a
library which Debian does not have. Ours and the peer take turns; a figure is the median of the turns. With MICROSWARM_DATA
the maze is the benchmark's Corridor, else one that is drawn here.
"""

import argparse
import csv
import dataclasses
import datetime
import os
import pathlib
import statistics
import sys
import time
from typing import Optional

import numpy as np

import microswarm as ms
from microswarm import environments

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "python"))
from gathering_reference import Reference  # noqa: E402

BATCH = 1024
PARTICLES = 256
TIMES_AS_FAST = 100
ROBOT_STEPS = 1e6


@dataclasses.dataclass
class Row:
    """A row in the form of `microswarm bench`: rates, the more the better."""

    name: str
    quantity: str
    unit: str
    ours: float
    peer: Optional[float] = None
    peer_name: str = ""
    aim: Optional[float] = None

    def columns(self):
        shown = lambda value: "" if value is None else f"{value:.6g}"  # noqa: E731
        ratio = self.ours / self.peer if self.peer else None
        verdict = "" if self.aim is None and self.peer is None else str(self.ok()).lower()
        return [self.name, self.quantity, self.unit, shown(self.ours), shown(self.peer), self.peer_name, shown(ratio), shown(self.aim), verdict]

    def ok(self):
        return all(self.ours >= least for least in (self.aim, self.peer) if least is not None)


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    cpu = next((line.split(": ")[1] for line in lines if line.startswith("model name")), "unknown CPU")
    commit = os.environ.get("MICROSWARM_COMMIT")
    of = f" of commit {commit}" if commit else ""
    python = ".".join(str(part) for part in sys.version_info[:3])
    return f"{cpu}, Python {python}, NumPy {np.__version__}, microswarm {ms.__version__}{of}, {datetime.date.today()}"


def maze():
    """A maze, its goal and its name."""
    if os.environ.get("MICROSWARM_DATA"):
        return environments.free_cells("Corridor"), (82, 80), "Corridor"
    free = np.zeros((100, 100), bool)
    free[5:15, 5:95] = free[5:95, 5:15] = free[45:55, 5:95] = free[85:95, 5:95] = free[45:95, 85:95] = True
    return free, (90, 10), "three channels"


def speed(step, actions):
    """Steps a second."""
    began = time.perf_counter()
    for action in actions:
        step(action)
    return len(actions) / (time.perf_counter() - began)


def rows(turns, steps):
    free, goal, name = maze()
    random = np.random.default_rng(1)
    for physics in ("algorithmic", "fuzzy", "physical"):
        single = environments.GatheringEnv(free, goal, physics=physics, n_particles=PARTICLES)
        batch = environments.GatheringVectorEnv(BATCH, free, goal, physics=physics, n_particles=PARTICLES, copy=False)
        peer = Reference(free, goal, physics, seed=1)
        ours_one, ours_all, theirs = [], [], []
        for turn in range(turns):
            single.reset(seed=turn)
            peer.begin(single.particle_locations, single.particle_weights if physics == "physical" else None)
            batch.reset(seed=turn)
            one = random.integers(0, 8, steps).tolist()
            ours_one.append(speed(single.step, one))
            theirs.append(speed(peer.step, one))
            ours_all.append(BATCH * speed(batch.step, random.integers(0, 8, (steps, BATCH), dtype=np.uint8)))
        one, all_of_them, their = (statistics.median(values) for values in (ours_one, ours_all, theirs))
        peer_name = "the rules with NumPy, one"
        aim = TIMES_AS_FAST * their
        yield Row(f"gathering, {name}, {physics}, one", "steps per second", "1/s", one, their, peer_name, aim)
        yield Row(f"gathering, {name}, {physics}, {BATCH} at once, renewed in place", "steps of each per second", "1/s", all_of_them, their, peer_name, aim)
        yield Row(f"gathering, {name}, {physics}, {BATCH} at once, renewed in place", "robot-steps per second", "1/s", PARTICLES * all_of_them, aim=ROBOT_STEPS)
    scenario = ROOT / "scenarios" / "first_flight.yaml"
    many = environments.NavigationVectorEnv(BATCH, scenario, random_start=True, random_goal=True, scaled=False)
    many.reset(seed=1)
    given = np.column_stack((random.uniform(-3, 3, BATCH), np.ones(BATCH)))
    made = statistics.median(BATCH * speed(many.step, [given] * max(2, steps // 50)) for _ in range(turns))
    yield Row(f"navigation, first_flight, {BATCH} at once", "steps of each per second", "1/s", made)


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--quick", action="store_true", help="fewer turns")
    options.add_argument("--csv", type=pathlib.Path, help="write the rows into this file")
    given = options.parse_args()
    made = []
    for row in rows(3 if given.quick else 9, 200 if given.quick else 1000):
        made.append(row)
        print("  ".join(text for text in row.columns() if text), flush=True)
    if given.csv:
        part = given.csv.with_suffix(".part")
        with part.open("w", newline="") as file:
            file.write(f"# {machine()}\n")
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["name", "quantity", "unit", "ours", "peer", "peer_name", "ratio", "aim", "ok"])
            writer.writerows(row.columns() for row in made)
        part.replace(given.csv)
    return 0 if all(row.ok() for row in made) else 3


if __name__ == "__main__":
    sys.exit(main())
