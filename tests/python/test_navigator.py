# SPDX-License-Identifier: Apache-2.0
"""The library's navigators in a loop of one's own."""

import math
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT, SCENARIOS


def test_the_commands_are_those_of_the_run(flight):
    flight.set("sensing.observation_delay_s", 0).set("obstacles", [])
    frames = ms.run(flight, progress=False).frames
    nav = ms.Navigator(flight)
    for k in range(frames.rows - 1):
        swarm = [frames[key][k] for key in ("x_um", "y_um", "heading_rad", "radius_um")]
        command = nav.step(frames["t_s"][k], swarm=swarm)
        assert command.heading_rad == frames["command_heading_rad"][k]
        assert command.speed_um_per_s == frames["command_speed_um_per_s"][k]
        assert command.state == frames["state"][k]
    assert nav.path().shape[1] == 2


def test_obstacles_in_every_form(flight):
    nav = ms.Navigator(flight)
    swarm = (200, 500, 0, 40)
    square = np.array([[400, 400], [450, 400], [450, 450]])
    rows = np.array([[600, 500, 50], [700, 300, 20]], dtype=np.float32)
    for k, obstacles in enumerate([None, [], np.empty((0, 3)), rows, rows[::-1], rows.tolist(), [rows[0], square]]):
        command = nav.step(0.1 * k, swarm=swarm, obstacles=obstacles)
        assert math.isfinite(command.heading_rad)
    nav.step(1, swarm=swarm, obstacles=rows, numbers=[4, 9])
    assert nav.step(1.1).state == "blind" and nav.step(1.2).speed_um_per_s == 0


@pytest.mark.parametrize(
    "values, words",
    [
        ({"t": math.nan}, "now_s is nan"),
        ({"t": -1}, "before"),
        ({"seen": 100}, "seen_s is 100"),
        ({"swarm": (1, math.nan, 0, 40)}, "place of the swarm is nan"),
        ({"swarm": (1e9, 0, 0, 40)}, "place of the swarm"),
        ({"swarm": (1, 2, 3, -4)}, "radius of the swarm is -4"),
        ({"obstacles": np.zeros((2, 2))}, r"shape \(n, 3\)"),
        ({"obstacles": np.zeros((2, 3))}, "radius of an obstacle is 0"),
        ({"obstacles": [(1, 2)]}, "an obstacle must be"),
        ({"obstacles": [[[0, 0], [1, 0]]]}, "fewer than 3"),
        ({"obstacles": [(1, 2, math.inf)]}, "radius of an obstacle is inf"),
        ({"obstacles": [(1, 2, 3)], "numbers": [1, 2]}, "as many numbers"),
        ({"obstacles": [(1, 2, 3)], "numbers": [-1]}, "must be 0 to 2147483647"),
        ({"obstacles": [(1, 2, 3)], "numbers": [2**31]}, "must be 0 to 2147483647"),
        ({"unseen": 3}, "has no robots"),
        ({"unseen": None}, "unseen is None, must be a whole number"),
        ({"unseen": "a"}, "unseen is 'a', must be a whole number"),
        ({"unseen": 1.5}, "unseen is 1.5, must be a whole number"),
        ({"unseen": 2**40}, "unseen is 1099511627776, must be 0 to 2147483647"),
        ({"numbers": 5}, "numbers is 5, must be"),
        ({"robots": np.zeros((3, 2))}, "has no robots"),
        ({"robots": np.zeros(3)}, r"shape \(n, 2\)"),
    ],
)
def test_bad_input_is_refused_and_changes_nothing(flight, values, words):
    nav, other = ms.Navigator(flight), ms.Navigator(flight)
    good = {"t": 0.0, "swarm": (200, 500, 0, 40)}
    assert nav.step(**good) == other.step(**good)
    with pytest.raises(ms.InputError, match=words):
        nav.step(**{**good, "t": 0.1, **values})
    good["t"] = 0.2
    assert nav.step(**good) == other.step(**good)


def test_bad_types_are_refused(flight):
    nav = ms.Navigator(flight)
    for values in ({"swarm": (1, 2)}, {"swarm": "here"}, {"obstacles": "none"}, {"t": None}, {"robots": "two"}):
        with pytest.raises(ms.InputError):
            nav.step(**{"t": 0.0, "swarm": (200, 500, 0, 40), **values})
    nav.close()
    nav.close()
    with pytest.raises(ms.InputError, match="closed"):
        nav.step(0, swarm=(200, 500, 0, 40))


def test_thousands_of_overlapping_discs_are_no_trouble(flight):
    flight.set("navigator.guide", "straight")
    nav = ms.Navigator(flight)
    rng = np.random.default_rng(1)
    discs = np.column_stack((rng.uniform(500, 1500, 3000), rng.uniform(0, 800, 3000), np.full(3000, 100.0)))
    for k in range(3):
        command = nav.step(0.1 * k, swarm=(200, 500, 0, 40), obstacles=discs)
        assert math.isfinite(command.heading_rad)
        discs[:, :2] += rng.normal(0, 1, (3000, 2))


def test_ctrl_c_ends_a_step():
    code = f"""
import microswarm as ms, numpy as np
nav = ms.Navigator(ms.Scenario.load({str(SCENARIOS / "first_flight.yaml")!r}).set("navigator.guide", "straight"))
rng = np.random.default_rng(1)
angles = np.linspace(0, 2 * np.pi, 90, endpoint=False)
ring = np.column_stack((np.cos(angles), np.sin(angles)))
outlines = [rng.uniform((600, 100), (1400, 700)) + 100 * rng.uniform(0.5, 1, (90, 1)) * ring for _ in range(1000)]
nav.step(0, swarm=(200, 500, 0, 40))
print("steps", flush=True)
try:
    for k in range(1, 1000):
        nav.step(0.1 * k, swarm=(200, 500, 0, 40), obstacles=outlines)
except KeyboardInterrupt:
    print("interrupted")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert process.stdout.readline() == "steps\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=30)[0] == "interrupted\n"


def test_robots_gather_in_a_loop_of_ones_own():
    scenario = ms.Scenario.load(SCENARIOS / "papers/gather/t_junction.yaml")
    nav = ms.Navigator(scenario)
    rng = np.random.default_rng(1)
    robots = rng.uniform([40, 2], [60, 8], (scenario.robots.count, 2))
    assert nav.step(0, robots=robots).state == "gather"
    with pytest.raises(ms.InputError, match="give their places, no swarm"):
        nav.step(0.1, swarm=(1, 2, 0, 3))
    with pytest.raises(ms.InputError, match="robots, the scenario has"):
        nav.step(0.1, robots=robots[1:])
    with pytest.raises(ms.InputError, match="are unseen"):
        nav.step(0.1, robots=robots, unseen=len(robots) + 1)
    assert nav.step(0.1, robots=robots, unseen=1).state == "gather"
