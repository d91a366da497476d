# SPDX-License-Identifier: Apache-2.0
"""Scenarios as objects."""

import copy
import os
import pickle
import random

import numpy as np
import pytest

import microswarm as ms
from conftest import SCENARIOS
from microswarm.environments import NavigationEnv


def test_keys_are_attributes_with_their_units(flight):
    assert flight.tick_s == 0.1
    assert flight.goal_um == (1800, 500)
    assert flight.obstacles[0].shape.radius_um == 60
    assert len(flight.obstacles) == 2
    flight.navigator.speed_um_per_s = 60
    flight.obstacles[1].shape.radius_um = 33.5
    flight.goal_um = np.array([1700, 400])
    assert flight.get("navigator.speed_um_per_s") == 60
    assert flight.get("obstacles.1.shape.radius_um") == 33.5
    assert flight.goal_um == (1700, 400)
    assert "speed_um_per_s" in dir(flight.navigator)


def test_a_copy_is_its_own(flight):
    other = flight.copy()
    other.seed = 7
    assert (flight.seed, other.seed) == (1, 7)


def test_the_yaml_of_a_scenario_is_that_scenario(flight):
    again = ms.Scenario.from_text(flight.to_yaml(), SCENARIOS)
    assert again == flight
    assert ms.run(again, progress=False).hash == ms.run(flight, progress=False).hash


def nested(depth):
    """Lists in lists; with None, a list in itself."""
    made = []
    if depth is None:
        made.append(made)
    for _ in range(depth or 0):
        made = [made]
    return made


@pytest.mark.parametrize(
    "key, value, words",
    [
        ("navigator.speed_um_per_s", -3, "allowed 0.001..1e5"),
        ("navigator.sped_um_per_s", 3, "did you mean 'speed_um_per_s'"),
        ("goal_um", [1, 2, 3], "goal_um"),
        ("tick_s", None, "tick_s"),
        ("goal_um", float("nan"), "finite"),
        ("goal_um", np.array([1, np.inf]), "finite"),
        ("tick_s", "soon", "tick_s"),
        ("tick_s", {1, 2}, "type set"),
        ("tick_s", object(), "type object"),
        ("navigator.type", "magic", "allowed"),
        ("navigator.speed_um_per_s", float("nan"), "navigator.speed_um_per_s is nan, must be finite"),
        ("goal_um", nested(100_000), "goal_um is .*nested too deeply"),
        ("goal_um", nested(None), "goal_um is .*contains itself"),
        ("goal_um", {(1, 2): 3}, "goal_um is .*keys must be"),
        ("tick_s", [10**5000], "tick_s is .*must be finite"),
        ("name", "\udcff", "name is .*UTF-8"),
        ("obstacles", ["\udcff"], "obstacles is .*UTF-8"),
        ("na\udcff", 1, "UTF-8"),
    ],
)
def test_bad_values_change_nothing(flight, key, value, words):
    before = flight.to_yaml()
    with pytest.raises(ms.InputError, match=words):
        flight.set(key, value)
    assert flight.to_yaml() == before


def test_unknown_attributes_are_refused(flight):
    with pytest.raises(AttributeError, match="did you mean 'goal_um'"):
        flight.gaol_um = [1, 2]
    with pytest.raises(AttributeError, match="did you mean 'speed_um_per_s'"):
        flight.navigator.sped_um_per_s
    with pytest.raises(IndexError):
        flight.obstacles[2]
    with pytest.raises(KeyError):
        flight.get("navigator.none")


def test_files_that_are_none(tmp_path):
    with pytest.raises(ms.InputError, match="nowhere.yaml"):
        ms.Scenario.load(tmp_path / "nowhere.yaml")
    bad = tmp_path / "bad.yaml"
    bad.write_text("gaol_um: [1, 2]\n")
    with pytest.raises(ms.InputError, match=r"bad.yaml:1:1: unknown key 'gaol_um', did you mean 'goal_um'"):
        ms.Scenario.load(bad)
    assert issubclass(ms.InputError, ValueError)


@pytest.mark.parametrize("name", [None, 5, "", b"a.yaml", "a\0b", os.fsdecode(b"b\xff/f.yaml")])
def test_what_is_no_name_of_a_file_is_told(flight, name):
    record = ms.run(flight.copy().set("time_limit_s", 1), progress=False)
    for call in (
        *(ms.Scenario.load, ms.run, ms.sweep, ms.Navigator, ms.Session, NavigationEnv, ms.read_record),
        *(record.save, record.draw, ms.Coils.load, ms.Coils.from_csv, ms.Map.load),
    ):
        with pytest.raises(ms.InputError, match=r"^(path|scenario) is .*, must be [^\n]*$"):
            call(name)


@pytest.mark.parametrize(
    "values, words",
    [((None,), "text is None"), (("\udcff",), "UTF-8"), (("a: 1", None), "folder is None"), (("a: 1", "", 5), "name is 5, must be a text")],
)
def test_texts_that_are_none(values, words):
    with pytest.raises(ms.InputError, match=words):
        ms.Scenario.from_text(*values)


def test_places_and_lists_are_replaced_as_a_whole(flight):
    with pytest.raises(TypeError):
        flight.goal_um[0] = 1000
    flight.get("navigator")["speed_um_per_s"] = 1
    assert flight.navigator.speed_um_per_s != 1
    flight.obstacles = flight.obstacles[:1]
    assert len(flight.obstacles) == 1
    flight.set("obstacles.0", flight.obstacles[0])
    with pytest.raises(AttributeError, match="replaced as a whole"):
        flight.obstacles.append(3)
    for key in ("seed=5 #", "seed\n", "", 5, None):
        with pytest.raises(ms.InputError, match="no key"):
            flight.set(key, 5)


def test_scenarios_are_copied_and_pickled(flight):
    flight.seed = 4
    for other in (copy.copy(flight), copy.deepcopy(flight), pickle.loads(pickle.dumps(flight))):
        assert other == flight and ms.run(other, progress=False).hash == ms.run(flight, progress=False).hash
        other.seed = 5
        assert flight.seed == 4


def test_files_are_found_from_another_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(SCENARIOS.parent)
    scenario = ms.Scenario.load("scenarios/demo.yaml").set("time_limit_s", 1)
    monkeypatch.chdir(tmp_path)
    assert ms.run(scenario, progress=False).status == "time_limit"
    with pytest.raises(ms.InputError, match="must be the name of a file"):
        ms.Scenario.load(str(SCENARIOS / "demo.yaml") + "\0more")


def test_the_list_of_settings_does_not_grow_with_sets_of_the_same_key(flight):
    for k in range(200):
        flight.navigator.speed_um_per_s = 20 + k % 7
        flight.obstacles = [flight.obstacles[0].to_dict()] * (1 + k % 2)
        flight.obstacles[0].shape.radius_um = 30 + k % 3
        flight.start = {"x_um": 200, "y_um": 500 + k % 5, "heading_deg": 0}
    assert len(flight._core.settings) <= 6
    assert pickle.loads(pickle.dumps(flight)) == flight


def test_a_type_may_be_chosen_again(flight):
    for kind in ("radar", "safe_interval", "hierarchical_drrt_star", "hierarchical_drrt_star", "radar"):
        flight.navigator.speed_um_per_s = 33
        flight.set("navigator.type", kind)
    flight.navigator.speed_um_per_s = 44
    flight.navigator.type = "radar"
    assert flight.navigator.speed_um_per_s == 44
    assert pickle.loads(pickle.dumps(flight)) == flight
    assert ms.run(flight.set("time_limit_s", 1), progress=False).status == "time_limit"


@pytest.mark.parametrize("seed", range(8))
def test_settings_give_the_values_in_any_order(flight, seed):
    rng = random.Random(seed)
    sets = [
        lambda: ("navigator.type", rng.choice(["radar", "safe_interval", "hierarchical_drrt_star"])),
        lambda: ("navigator.speed_um_per_s", rng.randint(10, 12)),
        lambda: ("navigator.clearance_um", rng.randint(41, 43)),
        lambda: ("navigator", {"type": "radar", "speed_um_per_s": rng.randint(10, 12)}),
        lambda: ("navigator", {"speed_um_per_s": rng.randint(10, 12)}),
        lambda: ("obstacles", [{"shape": {"type": "disc", "radius_um": 20}, "motion": {"type": "still", "position_um": [900, 500]}}] * rng.randint(1, 3)),
        lambda: ("obstacles.0.shape.radius_um", rng.randint(10, 12)),
        lambda: ("obstacles.1.motion.type", rng.choice(["still", "track"])),
        lambda: ("obstacles.1.shape.type", rng.choice(["disc", "polygon"])),
        lambda: ("swarm.type", rng.choice(["ribbon", "vortex"])),
        lambda: ("swarm.radius_um", rng.randint(10, 12)),
        lambda: ("seed", rng.randint(1, 3)),
    ]
    for k in range(60):
        key, value = rng.choice(sets)()
        try:
            flight.set(key, value)
        except ms.InputError:
            continue
        assert pickle.loads(pickle.dumps(flight)) == flight, (key, value)
        if k % 6 != 0:
            continue
        try:
            ms.Session(flight).close()
        except ms.InputError as error:  # what the values mean together, never their order
            assert "comes after" not in str(error)
    assert len(flight._core.settings) <= 25
