# SPDX-License-Identifier: Apache-2.0
"""Gathering, and plans for several robots, under one input."""

import json
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import microswarm as ms


@pytest.fixture
def tee():
    """A T of channels 40 µm wide, as an image whose pixels are 10 µm."""
    image = np.zeros((20, 100), bool)
    image[8:12, 5:95] = True
    image[2:12, 48:52] = True
    return image


@pytest.fixture
def tee_file(tee, tmp_path):
    path = tmp_path / "tee.pgm"
    path.write_bytes(b"P5\n100 20\n255\n" + (tee * np.uint8(255)).tobytes())
    return path


@pytest.fixture
def rooms(tmp_path):
    path = tmp_path / "l.csv"
    path.write_text("0,0,400,50\n0,350,400,50\n0,0,50,400\n350,0,50,400\n175,150,100,25\n150,150,25,100\n")
    return path


ROBOTS, GOALS = [(60, 300), (60, 250)], [(330, 300), (330, 200)]


def told_by(program, *words):
    told = subprocess.run([str(word) for word in (program, *words, "--json")], capture_output=True, text=True)
    return json.loads(told.stdout)


@pytest.mark.parametrize("method", ["rollout", "heuristic", "divide_and_conquer", "dynamic_shortest_path"])
def test_gathering_is_that_of_the_program(program, tee, tee_file, method):
    words = ["gather", tee_file, "--map-um-per-px", 10, "--goal", "500,150", "--robots", 20, "--seed", 3]
    told = told_by(program, *words, "--set", f"navigator.method={method}")
    made = ms.gather(ms.Map.load(tee_file, 10), (500, 150), n=20, method=method, seed=3, progress=False)
    assert made.record.hash == told["record_hash"]
    assert made.status == told["status"] == "solved" and made.solved
    assert made.mean_distance_um == told["metrics"]["goal_distance_um"]
    image = ms.gather(ms.Map.from_image(tee, 10), (500, 150), n=20, method=method, seed=3, progress=False)
    assert image.record.hash == told["record_hash"]
    assert made.steps == len(made.inputs_um) and made.robots_um.shape == (20, 2)


def test_what_is_told_of_a_gathering_holds(tee, tmp_path):
    chip = ms.Map.from_image(tee, 10)
    shares = []
    made = ms.gather(chip, (500, 150), n=30, channel_width_um=40, gathered="all", progress=shares.append)
    assert made.solved and all(0 <= share <= 1 for share in shares)
    assert chip.is_free(made.robots_um).all()
    far = np.linalg.norm(made.robots_um - (500, 150), axis=1)
    assert far.mean() <= made.mean_distance_um + 2  # paths are at least as straight lines, but for a cell of their field
    assert made.mean_distance_um <= 40 + 1e-9
    moved = np.linalg.norm(made.inputs_um, axis=1)
    assert moved.max() == pytest.approx(4) and moved.min() >= 0  # a tenth of the channels' width
    made.record.save(tmp_path / "run.h5")
    assert ms.read_record(tmp_path / "run.h5").replay() == (True, "")


def test_robots_begin_where_they_are_put(program, tee_file):
    starts = np.array([[60.0, 100], [900, 100], [500, 140], [720.5, 95.25]])
    chip = ms.Map.load(tee_file, 10)
    made = ms.gather(chip, (500, 150), starts, method="heuristic", progress=False)
    assert np.array_equal(made.record.robots_um[0], starts)
    for same in (starts.tolist(), np.asfortranarray(starts), np.repeat(starts, 2, axis=0)[::2]):
        assert ms.gather(chip, (500, 150), same, method="heuristic", progress=False).record.hash == made.record.hash
    given = "[" + ",".join(f"[{x},{y}]" for x, y in starts.tolist()) + "]"
    words = ["gather", tee_file, "--map-um-per-px", 10, "--goal", "500,150", "--set", "navigator.method=heuristic"]
    told = told_by(program, *words, "--set", "robots.count=0", "--set", f"robots.starts_um={given}")
    assert made.record.hash == told["record_hash"]


def test_a_gathering_may_end_early(tee):
    made = ms.gather(ms.Map.from_image(tee, 10), (500, 150), n=30, max_steps=5, progress=False)
    assert not made.solved and made.status == "time_limit" and made.steps == 5 == len(made.inputs_um)


def test_what_does_not_suit_the_method_is_noted(tee):
    tee[15:18, 5:20] = True  # a room that is cut off
    made = ms.gather(ms.Map.from_image(tee, 10), (500, 100), n=5, max_steps=3, progress=False)
    assert made.notes


@pytest.mark.parametrize(
    "values, words",
    [
        ({"map": None}, "map is None"),
        ({"goal_um": (500, 30)}, "goal"),
        ({"goal_um": (5000, 30)}, "outside"),
        ({"goal_um": (np.nan, 30)}, "goal"),
        ({"goal_um": "there"}, "goal_um is 'there', must be"),
        ({"n": 0}, "n is 0, must be 1 to 1000000"),
        ({"n": -1}, "n is -1, must be 1 to 1000000"),
        ({"settings": 5}, "settings is 5, must be a dictionary"),
        ({"n": 2.5}, "n is 2.5"),
        ({"n": 10**9}, "n is"),
        ({"robots_um": []}, "no robots"),
        ({"robots_um": [[1, 2, 3]]}, "shape"),
        ({"robots_um": [[1, 2], [3]]}, "shape"),
        ({"robots_um": [[1, 2]]}, "robot 1: start"),
        ({"robots_um": [[np.nan, 2]]}, "robot 1: start"),
        ({"robots_um": [[60, 100]], "n": 3}, "both given"),
        ({"method": "magic"}, "magic"),
        ({"method": None}, "method"),
        ({"seed": -1}, "seed is -1"),
        ({"seed": None}, "seed"),
        ({"max_steps": 0}, "max_steps is 0"),
        ({"channel_width_um": 0}, "channel_width_um is 0"),
        ({"channel_width_um": np.inf}, "channel_width_um"),
        ({"gatherd": "all"}, "did you mean 'gathered'"),
        ({"rollout": {"horizn": 3}}, "did you mean 'horizon'"),
        ({"settings": {"robots.speed_sprad": 0}}, "did you mean 'speed_spread'"),
        ({"settings": {"goal tolerance": 0}}, "no key"),
        ({"progress": 7}, "progress"),
    ],
)
def test_bad_gatherings(tee, values, words):
    with pytest.raises(ms.InputError, match=words):
        ms.gather(**{"map": ms.Map.from_image(tee, 10), "goal_um": (500, 150), "max_steps": 5, **values})


@pytest.mark.parametrize("planner", ["global_search", "global_rrt"])
def test_plans_are_those_of_the_program(program, rooms, planner):
    words = ["global", rooms, "--robots", "60,300;60,250", "--goals", "330,300;330,200", "--seed", 2]
    told = told_by(program, *words, "--set", f"planner.type={planner}", "--set", "planner.goal_tolerance_um=25")
    plan = ms.global_plan(ms.Map.load(rooms), ROBOTS, GOALS, planner, seed=2, goal_tolerance_um=25)
    assert plan.status == told["status"] == "solved" and plan.solved and plan.why_none == ""
    assert plan.worst_um == told["worst_um"] and plan.nodes == told["nodes"]
    assert len(plan.inputs_um) == told["input_count"] and plan.inputs_found == told["input_count_found"]
    assert np.array_equal(plan.paths_um.transpose(1, 0, 2), told["ways_um"])
    inputs = [[run["x_um"], run["y_um"]] for run in told["inputs"] for _ in range(run["times"])]
    assert np.array_equal(plan.inputs_um, inputs)


def test_what_is_told_of_a_plan_holds(rooms):
    chip = ms.Map.load(rooms)
    plan = ms.global_plan(chip, np.asfortranarray(ROBOTS), GOALS)
    assert plan.paths_um.shape == (len(plan.inputs_um) + 1, 2, 2)
    assert np.array_equal(plan.paths_um[0], ROBOTS)
    assert np.linalg.norm(plan.paths_um[-1] - GOALS, axis=1).max() == pytest.approx(plan.worst_um) and plan.worst_um <= 20
    assert chip.is_free(plan.paths_um.reshape(-1, 2)).all()
    moved = np.diff(plan.paths_um, axis=0)
    free = chip.clearance(plan.paths_um[:-1].reshape(-1, 2)).reshape(-1, 2) > 6  # no wall within a step
    assert np.allclose(moved[free], np.broadcast_to(plan.inputs_um[:, None], moved.shape)[free], atol=1e-3)
    assert len(ms.global_plan(chip, ROBOTS, GOALS, shorten=False).inputs_um) == plan.inputs_found
    assert len(plan.inputs_um) <= plan.inputs_found


def test_limits_end_a_search(rooms):
    chip = ms.Map.load(rooms)
    few = ms.global_plan(chip, ROBOTS, GOALS, "global_rrt", max_nodes=50)
    assert few.status == "node_limit" and "max_nodes 50" in few.why_none and few.worst_um > 20
    late = ms.global_plan(chip, ROBOTS, GOALS, time_limit_s=0)
    assert late.status == "time_limit" and not late.solved and late.paths_um.shape[1:] == (2, 2)


@pytest.mark.parametrize(
    "values, words",
    [
        ({"map": "map.png"}, "map is 'map.png'"),
        ({"robots_um": None}, "robots_um"),
        ({"robots_um": []}, "0 robots"),
        ({"robots_um": ROBOTS * 33, "goals_um": GOALS * 33}, "66 robots"),
        ({"robots_um": [[60, np.nan], [60, 250]]}, "robot 1: start must be finite"),
        ({"goals_um": [[60, 300], [np.inf, 250]]}, "robot 2: goal must be finite"),
        ({"robots_um": [[0, 0], [60, 250]]}, "robot 1: start"),
        ({"robots_um": np.zeros((2, 3))}, "shape"),
        ({"goals_um": GOALS[:1]}, "1 given for 2"),
        ({"goals_um": []}, "no places"),
        ({"goals_um": [[160, 160], [330, 200]]}, "robot 1: goal"),
        ({"robots_um": [ROBOTS[0]] * 2}, "nothing parts them"),
        ({"planner": "magic"}, "allowed"),
        ({"planner": None}, "type"),
        ({"robostp_um": 5}, "did you mean 'robostep_um'"),
        ({"robostep_um": 0}, "robostep_um is 0"),
        ({"time_limit_s": -1}, "time_limit_s is -1"),
        ({"seed": 2**64}, "seed is"),
    ],
)
def test_bad_plans(rooms, values, words):
    with pytest.raises(ms.InputError, match=words):
        ms.global_plan(**{"map": ms.Map.load(rooms), "robots_um": ROBOTS, "goals_um": GOALS, **values})


ENDLESS = """
import microswarm as ms, numpy as np, sys
chip = ms.Map.from_image(np.ones((40, 40), bool), 10)
print("begun", flush=True)
{}
"""


@pytest.mark.parametrize(
    "call",
    [
        # Two robots in an empty room stand to each other as they stood.
        "ms.global_plan(chip, [(100, 100), (200, 100)], [(100, 100), (300, 300)], goal_tolerance_um=1)",
        "ms.gather(chip, (200, 200), n=2000, method='heuristic', max_steps=10**8, settings={'goal_tolerance_um': 0.001})",
        "ms.segment(np.kron(np.random.default_rng(1).integers(0, 2, (1000, 1000)), np.full((3, 3), 255)).astype(np.uint8), 1, keep='all')",
        "ms.track((np.zeros((400, 400), np.uint8) for _ in iter(int, 1)), 1, 10)",
    ],
)
def test_ctrl_c_ends_long_calls(call):
    child = subprocess.Popen([sys.executable, "-c", ENDLESS.format(call)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    time.sleep(1)
    assert child.poll() is None, child.communicate()
    child.send_signal(signal.SIGINT)
    _, errors = child.communicate(timeout=30)
    assert child.returncode != 0 and errors.rstrip().endswith("KeyboardInterrupt")
