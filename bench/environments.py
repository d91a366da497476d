#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Environments for learning beside their rules with NumPy: steps a second, of one and of 1,024 at once.

    PYTHONPATH=build/release/python bench/environments.py [--quick] [--csv FILE]

The peer is tests/python/gathering_reference.py, whole arrays at a time, as the benchmark's own package works; that needs a
library which Debian does not have. Ours and the peer take turns; a figure is the median of the turns. With MICROSWARM_DATA
the maze is the benchmark's Corridor, else one that is drawn here.
"""

import argparse
import os
import pathlib
import statistics
import sys
import time

import numpy as np

import microswarm as ms
from microswarm import environments

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "tests" / "python")]
from gathering_reference import Reference  # noqa: E402
from rows import Row, finish  # noqa: E402

BATCH = 1024
PARTICLES = 256
TIMES_AS_FAST = 100
ROBOT_STEPS = 1e6


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
        batch = environments.GatheringVectorEnv(BATCH, free, goal, physics=physics, n_particles=PARTICLES)
        peer = Reference(free, goal, physics, seed=1)
        ours_one, ours_all, theirs = [], [], []
        for turn in range(turns):
            single.reset(seed=turn)
            peer.begin(single.particle_locations, single.particle_weights if physics == "physical" else None)
            batch.reset(seed=turn)
            one = random.integers(0, 8, steps).tolist()
            ours_one.append(speed(single.step, one * 5))
            theirs.append(speed(peer.step, one))
            ours_all.append(BATCH * speed(batch.step, random.integers(0, 8, (max(20, steps // 20), BATCH))))
        one, all_of_them, their = (statistics.median(values) for values in (ours_one, ours_all, theirs))
        peer_name = "the rules with NumPy, one"
        aim = TIMES_AS_FAST * their
        yield Row(f"gathering, {name}, {physics}, one", "steps per second", "1/s", one, their, peer_name, aim)
        yield Row(f"gathering, {name}, {physics}, {BATCH} at once", "steps of each per second", "1/s", all_of_them, their, peer_name, aim)
        yield Row(f"gathering, {name}, {physics}, {BATCH} at once", "robot-steps per second", "1/s", PARTICLES * all_of_them, aim=ROBOT_STEPS)
    scenario = ROOT / "scenarios" / "first_flight.yaml"
    many = environments.NavigationVectorEnv(BATCH, scenario, random_start=True, random_goal=True)
    many.reset(seed=1)
    given = np.column_stack((random.uniform(-3, 3, BATCH), np.ones(BATCH)))
    made = statistics.median(BATCH * speed(many.step, [given] * max(2, steps // 50)) for _ in range(turns))
    yield Row(f"navigation, first_flight, {BATCH} at once", "steps of each per second", "1/s", made)


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--quick", action="store_true", help="fewer turns")
    options.add_argument("--csv", type=pathlib.Path)
    given = options.parse_args()
    return finish(rows(3 if given.quick else 9, 200 if given.quick else 1000), given.csv, f"microswarm {ms.__version__}, NumPy {np.__version__}")


if __name__ == "__main__":
    sys.exit(main())
