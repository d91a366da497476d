# SPDX-License-Identifier: Apache-2.0
"""Copies, pickles, seeds, ends and pictures of environments, and the scale of their observations."""

import copy
import pickle

import numpy as np
import pytest

import microswarm as ms
from conftest import SCENARIOS
from microswarm.environments import AutoresetMode, GatheringEnv, GatheringVectorEnv, NavigationEnv, NavigationVectorEnv, make, make_vec

FLIGHT = SCENARIOS / "first_flight.yaml"
MAZE = np.zeros((20, 30), bool)
MAZE[3:8, 2:28] = MAZE[3:18, 8:12] = MAZE[12:16, 8:25] = True
GATHERINGS = [
    {"maze": MAZE, "goal": goal, "physics": physics, "n_particles": count, "max_episode_steps": 25}
    for goal in (None, (24, 5))
    for physics in ("algorithmic", "fuzzy", "physical")
    for count in (20, "random", "filled")
]
NAVIGATIONS = [
    {"scenario": FLIGHT, "random_start": True, "random_goal": True, "max_episode_steps": 40},
    {"scenario": SCENARIOS / "oncoming.yaml"},
    {"scenario": SCENARIOS / "papers/drrt/deforming_channel.yaml", "scaled": False},
]
KINDS = [(GatheringEnv, GatheringVectorEnv, values) for values in GATHERINGS] + [(NavigationEnv, NavigationVectorEnv, values) for values in NAVIGATIONS]


def names(kind):
    return "-".join(str(value) for key, value in kind[2].items() if key not in ("maze", "scenario"))


def acted(env, steps):
    """Steps with actions of the environment's own space; single environments are reset at an end."""
    made = []
    for _ in range(steps):
        made.append(env.step(env.action_space.sample()))
        if isinstance(made[-1][2], bool) and (made[-1][2] or made[-1][3]):
            made.append(env.reset())
    return made


def same(one, other):
    if isinstance(one, (list, tuple)) or isinstance(one, np.ndarray) and one.dtype == object:
        return len(one) == len(other) and all(same(a, b) for a, b in zip(one, other))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    return np.array_equal(one, other)


@pytest.mark.parametrize("kind", KINDS, ids=names)
@pytest.mark.parametrize("before", [0, 11, 60])
def test_a_copy_and_a_pickle_go_on_identically(kind, before):
    single, many, values = kind
    for env in (single(**values), many(num_envs=3, **values), many(num_envs=3, autoreset_mode="SameStep", **values)):
        env.reset(seed=4)
        env.action_space.seed(before)
        acted(env, before)
        others = [copy.deepcopy(env), pickle.loads(pickle.dumps(env)), copy.copy(env)]
        others.append(copy.deepcopy(others[0]))
        expected = acted(env, 70)
        for other in others:
            assert same(acted(other, 70), expected)
        assert same(others[0].reset(seed=9), env.reset(seed=9)) and others[0].rules == env.rules


def test_a_copy_is_independent():
    env = GatheringEnv(MAZE, (24, 5), n_particles=20)
    env.reset(seed=1)
    before = env.particle_locations
    other = copy.deepcopy(env)
    acted(other, 10)
    other.close()
    assert np.array_equal(env.particle_locations, before) and env.step(0)
    with pytest.raises(ms.InputError, match="closed"):
        copy.deepcopy(other)
    with pytest.raises(ms.InputError, match="closed"):
        pickle.dumps(other)


def test_states_that_cannot_be_are_refused():
    gathering, navigation = GatheringEnv(MAZE, (24, 5), n_particles=20)._core, NavigationEnv(FLIGHT)._core
    for core, state, words in (
        (gathering, (1, 0, np.array([8], np.uint8)), "input 8"),
        (gathering, (1, 2**60, np.array([0], np.uint8)), "draws"),
        (navigation, (1, 0, np.array([[np.nan, 1.0]])), "no heading and speed"),
        (navigation, (1, 0, np.array([[0.0, 1e6]])), "no heading and speed"),
        (navigation, (1, 0), "3 parts"),
    ):
        with pytest.raises(ms.InputError, match=words):
            core.restore([state])
    with pytest.raises(ms.InputError, match="a state for each"):
        gathering.restore([])


def test_a_search_in_a_tree_uses_copies():
    """Of all inputs of two steps, the best that copies tell is what the environment then gives."""
    env = GatheringEnv(MAZE, (24, 5), n_particles=20)
    env.reset(seed=1)
    found = {}
    for first in range(8):
        node = copy.deepcopy(env)
        reward = node.step(first)[1]
        for second in range(8):
            found[first, second] = reward + copy.deepcopy(node).step(second)[1]
    best = max(found, key=found.get)
    assert sum(env.step(action)[1] for action in best) == found[best] > min(found.values())


def test_seeds_are_lists_and_are_drawn_where_there_are_none():
    for _, many, values in (KINDS[1], KINDS[-3]):
        envs = many(num_envs=4, **values)
        alone = [many(num_envs=1, **values) for _ in range(4)]
        seeds = [5, 2**64 - 1, 7, 5]
        seen, _ = envs.reset(seed=seeds)
        assert all(np.array_equal(seen[i], alone[i].reset(seed=seeds[i])[0][0]) for i in range(4))
        assert np.array_equal(seen[0], seen[3]) and not np.array_equal(seen[0], seen[2])
        seen, _ = envs.reset(seed=[None, 1, None, 2])
        assert np.array_equal(seen[0], alone[0].reset()[0][0]) and np.array_equal(seen[1], alone[1].reset(seed=1)[0][0])
        first, _ = many(num_envs=2, **values).reset()
        unseeded = many(num_envs=2, **values)
        assert not np.array_equal(unseeded.reset()[0], first)
        drawn = unseeded.np_random_seed
        again = many(num_envs=2, **values)
        again.reset(seed=drawn)
        assert np.array_equal(again.reset()[0], unseeded.reset()[0])
        for bad in ([1, 2, 3], [1, 2, 3, -1], [1, 2, 3, 2**64], [1, 2, 3, 4.5], "abcd", -1, 1.5, [1, 2, 3, 4, 5], []):
            with pytest.raises(ms.InputError, match="seed"):
                envs.reset(seed=bad)


def test_a_mask_resets_these_only():
    envs = GatheringVectorEnv(4, MAZE, (24, 5), n_particles=20)
    envs.reset(seed=1)
    acted(envs, 5)
    before = envs.get_attr("particle_locations")
    mask = np.array([False, True, False, False])
    options = {"reset_mask": mask}
    envs.reset(seed=[9, 9, 9, 9], options=options)
    after = envs.get_attr("particle_locations")
    assert [np.array_equal(a, b) for a, b in zip(before, after)] == [True, False, True, True] and "reset_mask" in options
    for bad in ([True] * 4, np.ones(3, bool), np.ones(4), np.zeros(4, bool), np.ones((4, 1), bool), "all", 1):
        with pytest.raises(ms.InputError, match="reset_mask"):
            envs.reset(options={"reset_mask": bad})


def test_a_map_is_copied_with_the_arguments_of_an_environment():
    """Gymnasium copies the arguments of what it makes; a map never changes, so that its copy is itself."""
    chip = ms.Map.from_image(MAZE, 10)
    values = copy.deepcopy({"maze": chip, "goal": None, "cell_um": 10, "n_particles": 5})
    assert values["maze"] is chip and copy.copy(chip) is chip
    assert GatheringEnv(**values).observation_space.shape == (20, 30, 1)


def test_modes_are_checked():
    for given in ("SameStep", AutoresetMode.SAME_STEP):
        assert GatheringVectorEnv(1, MAZE, (24, 5), n_particles=5, autoreset_mode=given).metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
    for bad in ("same", None, 3):
        with pytest.raises(ms.InputError, match="autoreset_mode"):
            GatheringVectorEnv(1, MAZE, (24, 5), n_particles=5, autoreset_mode=bad)
    with pytest.raises(ms.InputError, match="render_mode"):
        NavigationVectorEnv(1, FLIGHT, render_mode="human")


def test_attributes_are_those_of_each():
    envs = NavigationVectorEnv(3, FLIGHT, random_start=True)
    envs.reset(seed=1)
    for index, state in enumerate(envs.get_attr("state")):
        single = NavigationEnv(FLIGHT, random_start=True)
        single.reset(seed=1 + index)
        assert state == single.state
    assert envs.call("render")[2].shape == (240, 480, 3) and envs.get_attr("rules")[0] == envs.rules
    assert envs.get_attr("action_space")[1] is envs.single_action_space
    with pytest.raises(AttributeError):
        envs.get_attr("colour")
    with pytest.raises(ms.InputError, match="cannot be set"):
        envs.set_attr("rays", 3)


def test_names_make_them():
    assert isinstance(make("microswarm/Navigation-v0", scenario=FLIGHT), NavigationEnv)
    assert isinstance(make_vec("microswarm/Navigation-v0", 2, scenario=FLIGHT), NavigationVectorEnv)
    assert isinstance(make_vec("VesselFuzzyRandomPCRandomGoal-v0", 2, maze=MAZE), GatheringVectorEnv)
    with pytest.raises(ms.InputError, match="is no environment"):
        make("microswarm/Navigation-v1", scenario=FLIGHT)


def scaled_from(raw, reach, max_speed, rays):
    """The scaled observation from that in µm, as the docstring says."""
    made = np.array(raw, float)
    shorter = lambda vector, by: vector / (np.hypot(*vector) + by)  # noqa: E731
    made[:2] = shorter(made[:2], reach)
    made[4], made[5] = min(made[4] / max_speed, 1), made[5] / (made[5] + reach)
    made[6 : 6 + rays] /= reach
    for at in range(6 + rays, len(made), 5):
        made[at : at + 2] = shorter(made[at : at + 2], reach)
        made[at + 2] /= made[at + 2] + reach
        made[at + 3 : at + 5] = shorter(made[at + 3 : at + 5], max_speed)
    return made


@pytest.mark.parametrize("values", [{}, {"rays": 0, "obstacles": 1}, {"rays": 5, "obstacles": 0, "ray_range_um": 100}, {"obstacles": 6}])
def test_scaled_observations_are_those_in_um_made_smaller(values):
    values = {"scenario": FLIGHT, "random_start": True, "random_goal": True, **values}
    scaled, raw = NavigationEnv(**values), NavigationEnv(scaled=False, **values)
    rules = scaled.rules
    speed = scaled.max_speed_um_per_s
    for seed in range(5):
        seen = [scaled.reset(seed=seed)[0], raw.reset(seed=seed)[0]]
        for tick in range(40):
            assert seen[0] == pytest.approx(scaled_from(seen[1], rules["ray_range_um"], speed, rules["rays"]), abs=1e-4)
            assert seen[0] in scaled.observation_space
            x, y = 0.7 * np.cos(0.1 * tick + seed), 0.7 * np.sin(0.1 * tick + seed)
            steps = scaled.step((x, y)), raw.step((np.arctan2(y, x), np.hypot(x, y)))
            assert steps[0][1] == pytest.approx(steps[1][1], abs=1e-9) and steps[0][2:] == steps[1][2:]
            seen = [steps[0][0], steps[1][0]]


def test_a_velocity_longer_than_the_greatest_is_cut():
    env, other = (NavigationEnv(FLIGHT) for _ in range(2))
    env.reset(seed=1), other.reset(seed=1)
    for _ in range(10):
        one, two = env.step((1, 1)), other.step((np.sqrt(0.5), np.sqrt(0.5)))
    assert one[0] == pytest.approx(two[0], abs=1e-5) and one[0][4] == pytest.approx(1)
    for _ in range(20):
        rest = env.step((0, 0))[0]
    assert rest[4] == 0


def test_the_picture_of_a_navigation_shows_where_things_are():
    env = NavigationEnv(FLIGHT, render_mode="rgb_array", scaled=False, rays=0, obstacles=2)
    observation, _ = env.reset(seed=1)
    for _ in range(30):
        observation = env.step((0, 1))[0]
    picture, state = env.render(), env.state
    assert picture.shape == (240, 480, 3) and picture.dtype == np.uint8
    um_per_px = 2000 / 480

    def colour(x, y):
        return tuple(picture[int((1000 - y) / um_per_px), int(x / um_per_px)])

    x, y = state["x_um"], state["y_um"]
    assert colour(x, y + 25) == colour(x, y - 25) == (250, 250, 100)  # the swarm, of radius 40
    assert colour(x, y + 45) == (90, 150, 190)
    assert colour(x + 24, y) == (15, 30, 65)  # its heading
    assert colour(1000, 100) == colour(960, 440) == (15, 30, 65) and colour(1000, 460) == (90, 150, 190)  # the wall
    assert colour(state["goal_x_um"], state["goal_y_um"]) == (220, 60, 50)
    assert colour(state["goal_x_um"], state["goal_y_um"] + 40) == (150, 190, 160)
    for k in range(2):
        dx, dy, radius = observation[6 + 5 * k : 9 + 5 * k]
        assert colour(x + dx, y + dy + 0.9 * radius) == (235, 140, 60) and colour(x + dx, y + dy - 1.1 * radius) != (235, 140, 60)
