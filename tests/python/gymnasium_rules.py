# SPDX-License-Identifier: Apache-2.0
"""Gymnasium's rules of environments, asked of ours: with Gymnasium, or with the stand-in of stand_in/.

    PYTHONPATH=build/release/python:tests/python/stand_in /usr/bin/python3 tests/python/gymnasium_rules.py
"""

import copy
import pathlib
import pickle
import warnings

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from microswarm import environments
from microswarm.environments import GatheringEnv, GatheringVectorEnv, NavigationEnv, NavigationVectorEnv

FLIGHT = str(pathlib.Path(__file__).resolve().parents[2] / "scenarios" / "first_flight.yaml")
NAVIGATION = "microswarm/Navigation-v0"
MAZE = np.zeros((20, 30), bool)
MAZE[3:8, 2:28] = MAZE[3:18, 8:12] = MAZE[12:16, 8:25] = True


def same(one, other, at=""):
    """Both have the same types, shapes and values."""
    assert type(one) is type(other), (at, type(one), type(other))
    if isinstance(one, dict):
        assert one.keys() == other.keys(), (at, one.keys(), other.keys())
        [same(one[key], other[key], f"{at}/{key}") for key in one]
    elif isinstance(one, tuple) or isinstance(one, np.ndarray) and one.dtype == object:
        assert len(one) == len(other), at
        [same(a, b, at) for a, b in zip(one, other)]
    else:
        assert np.array_equal(one, other) and getattr(one, "dtype", None) == getattr(other, "dtype", None), (at, one, other)


def gathering(name, **values):
    goal = {"goal": (24, 5)} if "FixedGoal" in name else {}
    count = {"n_particles": 40} if "FixedPC" in name else {}
    return {"maze": MAZE, **goal, **count, **values}


def the_checker_passes():
    for name in environments.ids():
        check_env(gymnasium.make(name, **gathering(name, render_mode="rgb_array")).unwrapped)
    for values in ({}, {"random_start": True, "random_goal": True}, {"rays": 0, "obstacles": 0}, {"rays": 3, "obstacles": 7}):
        check_env(gymnasium.make(NAVIGATION, scenario=FLIGHT, render_mode="rgb_array", **values).unwrapped)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the spaces of µm are not bounded
        check_env(gymnasium.make(NAVIGATION, scenario=FLIGHT, render_mode="rgb_array", scaled=False).unwrapped)


def make_vec_gives_the_fast_ones():
    name = "VesselPhysicalFixedPCFixedGoal-v0"
    assert type(gymnasium.make_vec(name, 3, **gathering(name)).unwrapped) is GatheringVectorEnv
    assert type(gymnasium.make_vec(NAVIGATION, 3, scenario=FLIGHT).unwrapped) is NavigationVectorEnv
    for envs in (
        gymnasium.make_vec(name, 3, vectorization_mode="sync", **gathering(name)),
        gymnasium.make_vec(NAVIGATION, 3, vectorization_mode="sync", scenario=FLIGHT, random_start=True),
    ):
        seen, _ = envs.reset()  # without a seed each has one of its own
        assert type(envs) is SyncVectorEnv and seen in envs.observation_space
        assert len(np.unique(seen, axis=0)) == 3 and len({env.unwrapped.np_random_seed for env in envs.envs}) == 3


KINDS = [
    (GatheringVectorEnv, GatheringEnv, {"maze": MAZE, "goal": None, "physics": "fuzzy", "n_particles": "random", "goal_range": 16, "max_episode_steps": 23}),
    (GatheringVectorEnv, GatheringEnv, {"maze": MAZE, "goal": (24, 5), "physics": "physical", "n_particles": 30, "max_episode_steps": 17}),
    (NavigationVectorEnv, NavigationEnv, {"scenario": FLIGHT, "random_start": True, "random_goal": True, "max_episode_steps": 60}),
]


def many_are_single_ones_in_every_mode():
    """The same arrays, infos and masks as of Gymnasium's own vector of single environments."""
    reasons = set()
    for mode in AutoresetMode:
        for many, single, values in KINDS:
            fast = many(num_envs=5, autoreset_mode=mode, **values)
            slow = SyncVectorEnv([lambda: single(**values)] * 5, autoreset_mode=mode)
            assert fast.metadata == slow.metadata and fast.observation_space == slow.observation_space and fast.action_space == slow.action_space
            same(fast.reset(seed=5), slow.reset(seed=5))
            fast.action_space.seed(1)
            for step in range(150):
                actions = fast.action_space.sample()
                if many is NavigationVectorEnv:
                    actions = np.array([[np.cos(i), np.sin(i)] for i in range(step // 60, step // 60 + 5)], np.float32)
                made = fast.step(actions)
                same(made, slow.step(actions))
                ended = made[2] | made[3]
                if ended.any():
                    told = made[4].get("final_info", made[4])
                    assert np.array_equal(told["_success"], ended) and np.array_equal(told["success"], made[2] & (told["reason"] != "collided"))
                    reasons |= set(told["reason"][ended])
                if mode is AutoresetMode.DISABLED and ended.any():
                    try:
                        fast.step(actions)
                        raise AssertionError("an ended one was stepped")
                    except ValueError as error:
                        assert "reset is needed" in str(error)
                    same(fast.reset(options={"reset_mask": ended}), slow.reset(options={"reset_mask": ended}))
            seeds = [7, None, 9, 2**63, 1]
            same(fast.reset(seed=seeds), slow.reset(seed=seeds))
            mask = np.array([True, False, True, False, False])
            same(fast.reset(seed=seeds, options={"reset_mask": mask}), slow.reset(seed=seeds, options={"reset_mask": mask.copy()}))
            same(fast.reset(seed=3, options={"reset_mask": mask}), slow.reset(seed=3, options={"reset_mask": mask.copy()}))
            same(fast.step(actions), slow.step(actions))
            fast.close()
    assert reasons >= {"gathered", "step_limit", "collided", "time_limit"}, reasons


def wrappers_of_vectors_take_them():
    for mode in AutoresetMode:
        for many, _, values in KINDS:
            envs = RecordEpisodeStatistics(many(num_envs=4, autoreset_mode=mode, **values))
            envs.reset(seed=1)
            for _ in range(70):
                _, _, terminated, truncated, infos = envs.step(envs.action_space.sample())
                if (terminated | truncated).any():
                    assert (infos["episode"]["l"][infos["_episode"]] > 0).all()
                    if mode is AutoresetMode.DISABLED:
                        envs.reset(options={"reset_mask": terminated | truncated})
            envs.close()


def copies_and_pickles_go_on_identically():
    for name in ("VesselFuzzyRandomPCRandomGoal-v0", NAVIGATION):
        values = {"scenario": FLIGHT} if name == NAVIGATION else gathering(name)
        for env in (gymnasium.make(name, **values), gymnasium.make_vec(name, 3, **values)):
            env.reset(seed=2)
            env.action_space.seed(1)
            for _ in range(20):
                env.step(env.action_space.sample())
            for other in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
                assert other.spec.id == name
                reference = copy.deepcopy(env)
                for _ in range(20):
                    action = reference.action_space.sample()
                    assert np.array_equal(other.action_space.sample(), action)
                    same(other.step(action), reference.step(action))
                assert other.unwrapped.np_random.random() == reference.unwrapped.np_random.random()


def pictures_are_drawn():
    for many, _, values in KINDS:
        envs = many(num_envs=2, render_mode="rgb_array", **values)
        envs.reset(seed=1)
        pictures = envs.render()
        assert len(pictures) == 2 and envs.render_mode == "rgb_array"
        assert all(one.dtype == np.uint8 and one.shape[2] == 3 for one in pictures) and not np.array_equal(*pictures)


def main():
    warnings.simplefilter("error")
    for rule in (
        the_checker_passes,
        make_vec_gives_the_fast_ones,
        many_are_single_ones_in_every_mode,
        wrappers_of_vectors_take_them,
        copies_and_pickles_go_on_identically,
        pictures_are_drawn,
    ):
        rule()
        print(rule.__name__.replace("_", " "), f"(Gymnasium {gymnasium.__version__})", flush=True)


if __name__ == "__main__":
    main()
