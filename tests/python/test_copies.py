# SPDX-License-Identifier: Apache-2.0
"""What is copied, what goes to other processes, and what says why it does not."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT, SCENARIOS

START, GOAL = (50, 50), (350, 50)


def room():
    image = np.full((40, 40), True)
    image[10:, 18:22] = False
    image[2:6, 2:6] = False
    image[3:5, 3:5] = True  # a hole in a wall
    return ms.Map.from_image(image, 10)


MAPS = {
    "image": room,
    "walls": lambda: ms.Map.from_walls((0, -50, 400.5, 400), [[(180, 0), (220, 0), (220.25, 300), (180, 300)]], [(300, 300, 33.3)]),
    "retina": lambda: ms.Map.load(SCENARIOS / "maps" / "retina.geojson"),
    "file": lambda: ms.Map.load(ROOT / "tests" / "samples" / "maze.pgm", 10),
}


@pytest.mark.parametrize("kind", MAPS)
def test_a_map_pickles_to_the_bit(kind):
    map = MAPS[kind]()
    again = pickle.loads(pickle.dumps(map))
    assert again.bounds_um == map.bounds_um and repr(again) == repr(map)
    x_lo, y_lo, x_hi, y_hi = map.bounds_um
    places = np.random.default_rng(1).uniform((x_lo, y_lo), (x_hi, y_hi), (2000, 2))
    np.testing.assert_array_equal(again.clearance(places), map.clearance(places))
    assert pickle.dumps(again) == pickle.dumps(map)


def test_maps_and_coils_do_not_change_and_are_their_own_copies():
    for one in (room(), ms.Coils.load(SCENARIOS / "rigs" / "cube.yaml")):
        assert copy.copy(one) is one and copy.deepcopy([one])[0] is one


def planned(job):
    map, seed = job
    return ms.plan(map, START, GOAL, "rrt_star", clearance_um=15, seed=seed)


def test_a_pool_of_processes_plans_in_one_map():
    map = room()
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        paths = pool.map(planned, [(map, seed) for seed in (1, 2, 3)])
    for seed, path in zip((1, 2, 3), paths):
        assert np.array_equal(path.points_um, planned((map, seed)).points_um)


def test_a_robot_gathering_in_a_pickled_map_is_the_same():
    values = {"n": 8, "method": "heuristic", "max_steps": 3, "progress": False}
    one, other = (ms.gather(map, (50, 50), **values) for map in (room(), pickle.loads(pickle.dumps(room()))))
    assert one.record.hash == other.record.hash


def test_coils_pickle_if_they_are_calibrated():
    loaded = ms.Coils.load(SCENARIOS / "rigs" / "cube.yaml")
    currents = np.random.default_rng(1).uniform(-3, 3, (50, len(loaded)))
    mine = ms.Coils.from_measurements(currents, loaded.field(currents), names=loaded.names)
    again = pickle.loads(pickle.dumps(mine))
    assert np.array_equal(again.matrix(), mine.matrix()) and again.names == mine.names
    assert again.fit["rms_mt"] == mine.fit["rms_mt"]
    with pytest.raises(TypeError, match="load the file in each process"):
        pickle.dumps(loaded)


@pytest.mark.parametrize("action", [copy.copy, copy.deepcopy, pickle.dumps])
def test_what_is_under_way_says_why_it_is_not_copied(action):
    flight = ms.Scenario.load(SCENARIOS / "first_flight.yaml")
    with pytest.raises(TypeError, match="a Session is in the middle of a run.*scenario"):
        action(ms.Session(flight))
    with pytest.raises(TypeError, match="a Navigator remembers what it saw.*scenario"):
        action(ms.Navigator(flight))
    assert action(flight)
