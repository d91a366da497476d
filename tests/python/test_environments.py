# SPDX-License-Identifier: Apache-2.0
"""Environments for learning."""

import gc
import os
import pathlib
import threading

import numpy as np
import pytest
from gathering_reference import Reference, costs_to, length_estimate

import microswarm as ms
from microswarm import environments
from microswarm.environments import GatheringEnv, GatheringVectorEnv, NavigationEnv, NavigationVectorEnv
from microswarm.environments.spaces import Box, Discrete, MultiDiscrete

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "scenarios"
GOAL = (34, 5)


@pytest.fixture
def maze():
    """Channels 3 to 5 cells wide with dead ends, 40 × 30 cells."""
    free = np.zeros((30, 40), bool)
    free[3:8, 2:38] = free[3:27, 8:12] = free[22:26, 8:35] = free[12:26, 30:34] = free[14:17, 15:33] = True
    return free


def actions(seed, steps):
    """Random directions, each for a while."""
    return np.repeat(np.random.default_rng(seed).integers(0, 8, steps // 4), 4).tolist()


@pytest.mark.parametrize("physics", ["algorithmic", "physical"])
def test_a_gathering_is_that_of_the_rules_said_again(maze, physics):
    env = GatheringEnv(maze, GOAL, n_particles=150, physics=physics)
    for seed in (1, 2):
        observation, info = env.reset(seed=seed)
        reference = Reference(maze, GOAL, physics)
        reference.begin(env.particle_locations, env.particle_weights if physics == "physical" else None)
        assert np.array_equal(observation, reference.picture())
        ended = False
        for action in actions(seed, 1200):
            observation, reward, terminated, truncated, info = env.step(action)
            expected, value, done = reference.step(action)
            assert np.array_equal(observation, expected)
            assert reward == pytest.approx(value, abs=1e-12)
            assert terminated == done and not truncated
            assert info == ({"success": True, "is_success": True, "reason": "gathered"} if done else {})
            ended = ended or done
    assert len(env.particle_locations) == 150


def test_costs_and_length_are_those_of_the_rules_said_again(maze):
    env = GatheringEnv(maze, GOAL, n_particles=5, total_cost_reward=False, max_cost_reward=False)
    costs = costs_to(maze, (GOAL[1], GOAL[0]))
    assert np.array_equal(env.costs, np.where(maze, costs, -1))
    env.reset(seed=1)
    assert env.step(0)[1] == pytest.approx(-1 / length_estimate(maze, costs[costs > 0].mean()))


@pytest.mark.skipif("MICROSWARM_DATA" not in os.environ, reason="needs the mazes of the benchmark")
@pytest.mark.parametrize("name, physics", [("Corridor", "physical"), ("Capillary", "algorithmic"), ("Vessel", "physical")])
def test_the_mazes_of_the_benchmark(name, physics):
    env = environments.make(f"{name}{physics.capitalize()}FixedPCFixedGoal-v0")
    env.reset(seed=5)
    reference = Reference(environments.free_cells(name), env.goal, physics)
    reference.begin(env.particle_locations, env.particle_weights if physics == "physical" else None)
    for action in actions(3, 400):
        observation, reward, terminated, _, _ = env.step(action)
        expected, value, done = reference.step(action)
        assert np.array_equal(observation, expected) and reward == pytest.approx(value, abs=1e-12) and terminated == done


def test_all_are_gathered_by_leading_the_farthest(maze):
    env = GatheringEnv(maze, GOAL, n_particles=100)
    env.reset(seed=1)
    moves = [(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)]
    costs, total = env.costs, 0.0
    for _ in range(2000):
        places = env.particle_locations
        row, column = places[np.argmax(costs[places[:, 0], places[:, 1]])]
        ways = [costs[row + dy, column + dx] for dy, dx in moves]
        best = min(range(8), key=lambda k: ways[k] if ways[k] >= 0 else 10**6)
        _, reward, terminated, truncated, _ = env.step(best)
        total += reward
        assert not truncated
        if terminated:
            break
    assert terminated and costs[tuple(env.particle_locations.T)].max() <= 10
    assert total > 0


def test_fuzzy_particles_err_as_often_as_is_said_and_alike_in_a_cell():
    field = np.ones((200, 200), bool)
    env = GatheringEnv(field, (100, 100), n_particles=8000, physics="fuzzy", fuzzy_action_probability=0.25, random_move_chance=0)
    env.reset(seed=1)
    before = env.particle_locations
    env.step(0)
    moved = (env.particle_locations != before).any(axis=1) | (before[:, 1] == 199)
    assert moved.mean() == pytest.approx(0.75, abs=0.02)
    env = GatheringEnv(field, (100, 100), n_particles=8000, physics="fuzzy", fuzzy_action_probability=0, random_move_chance=1, random_move_distance=2)
    env.reset(seed=1)
    before = env.particle_locations
    env.step(2)
    inner = ((before > 5) & (before < 194)).all(axis=1)
    offsets = (env.particle_locations - before)[inner] - (1, 0)
    assert np.abs(offsets).max() == 2
    counts = np.histogram2d(*offsets.T, bins=5)[0]
    assert counts.min() > 0.7 * counts.mean() and counts.max() < 1.3 * counts.mean()
    pocket = np.zeros((9, 9), bool)
    pocket[4, 2:7] = True
    env = GatheringEnv(pocket, (2, 4), n_particles=5, physics="fuzzy", goal_range=0)
    env.reset(seed=1)
    for _ in range(200):
        env.step(0)
        env.step(4)
    assert len(np.unique(env.particle_locations, axis=0)) <= 3


def test_a_seed_gives_the_same_episodes_on_any_number_of_threads(maze):
    for physics in ("algorithmic", "fuzzy", "physical"):
        values = dict(n_particles="random", physics=physics, max_episode_steps=40, goal_range=4)
        batches = [GatheringVectorEnv(50, maze, None, threads=threads, observation_type="multichannel", **values) for threads in (1, 2, 3)]
        single = GatheringEnv(maze, None, observation_type="multichannel", **values)
        first = [batch.reset(seed=7)[0] for batch in batches]
        alone, _ = single.reset(seed=7 + 31)
        assert np.array_equal(first[0][31], alone)
        given = np.random.default_rng(1).integers(0, 8, (100, 50))
        fresh = False
        for all_actions in given:
            steps = [batch.step(all_actions) for batch in batches]
            for other in steps[1:]:
                assert all(np.array_equal(a, b) for a, b in zip(steps[0][:4], other[:4]))
            if fresh:
                alone, _ = single.reset()
                assert steps[0][1][31] == 0 and not steps[0][2][31] and not steps[0][3][31]
                fresh = False
            else:
                alone, reward, terminated, truncated, _ = single.step(all_actions[31])
                assert (reward, terminated, truncated) == (steps[0][1][31], steps[0][2][31], steps[0][3][31])
                fresh = terminated or truncated
            assert np.array_equal(steps[0][0][31], alone)


def test_names_say_what_an_environment_is(maze):
    assert len(environments.ids()) == 5 * 3 * 3 * 2
    env = environments.make("BrainFuzzyRandomPCRandomGoal-v0", maze=maze)
    assert env.observation_space.shape == (30, 40, 3) and env.rules["physics"] == "fuzzy"
    assert env.rules["particle_count"] == "random" and env.rules["goal_range"] == 10 and env.rules["max_episode_steps"] == 2000
    goals, counts = set(), set()
    for seed in range(30):
        observation, _ = env.reset(seed=seed)
        goals.add(env.goal)
        counts.add(len(env.particle_locations))
        assert maze[env.goal[1], env.goal[0]]
        assert np.array_equal(observation[:, :, 0] == 255, ~maze)
        shown = np.zeros_like(maze)
        shown[tuple(env.particle_locations.T)] = True
        assert np.array_equal(observation[:, :, 1] == 255, shown)
        assert observation[env.goal[1], env.goal[0], 2] == 255
    assert len(goals) > 20 and len(counts) > 20 and max(counts) < maze.sum()
    env = environments.make("CorridorAlgorithmicFilledPCFixedGoal-v0", maze=maze, goal=GOAL)
    env.reset(seed=1)
    assert len(env.particle_locations) == maze.sum() and env.observation_space.shape == (30, 40, 1)
    for bad in ("Corridor-v0", "CorridorAlgorithmicFixedPCFixedGoal", "", "MazeAlgorithmicFixedPCFixedGoal-v0"):
        with pytest.raises(ms.InputError, match="is no environment"):
            environments.make(bad, maze=maze)


def test_a_random_goal_is_drawn_beneath_the_particles_of_one_channel(maze):
    env = GatheringEnv(maze, None, n_particles=60, goal_range=3)
    observation, _ = env.reset(seed=2)
    column, row = env.goal
    assert observation[row, column, 0] == 255
    for action in actions(1, 80):
        env.step(action)
    final = env.step(0)[0][:, :, 0]
    bare = GatheringEnv(maze, env.goal, n_particles=1)  # no goal is drawn
    bare.reset()
    shown = np.zeros_like(final, bool)
    shown[tuple(env.particle_locations.T)] = True
    circle = (final == 255) & ~shown
    distance = np.hypot(*(np.argwhere(circle) - (row, column)).T)
    assert ((np.abs(distance - 3) < 1) | (distance < 2)).all() and circle.sum() > 10


def test_the_arguments_of_a_gathering_are_checked(maze, tmp_path):
    for words, call in {
        "is no free cell": lambda: GatheringEnv(maze, (0, 0)),
        "must be \\(column, row\\)": lambda: GatheringEnv(maze, 5),
        "goal column is -1": lambda: GatheringEnv(maze, (-1, 3)),
        "cells are free": lambda: GatheringEnv(maze, GOAL, n_particles=10**5),
        "n_particles is 0|n_particles=0|0, must be|\\(min 1\\)|must be 1": lambda: GatheringEnv(maze, GOAL, n_particles=0),
        "n_particles is 'many'": lambda: GatheringEnv(maze, GOAL, n_particles="many"),
        "2 dimensions": lambda: GatheringEnv(np.ones(5), GOAL),
        "no free cell": lambda: GatheringEnv(np.zeros((5, 5)), None),
        "a side must be 1 to 8192": lambda: GatheringEnv(np.zeros((0, 5)), None),
        "physics": lambda: GatheringEnv(maze, GOAL, physics="quantum"),
        "drag": lambda: GatheringEnv(maze, GOAL, drag=0.5),
        "colour": lambda: GatheringEnv(maze, GOAL, colour=1),
        "render_mode": lambda: GatheringEnv(maze, GOAL, render_mode="human"),
        "nope.pgm": lambda: GatheringEnv("nope.pgm"),
        "maze is None, must be": lambda: GatheringEnv(None),
        "goal is missing": lambda: GatheringEnv(maze),
        "maze has nan, must be finite": lambda: environments.free_cells(np.full((2, 2), np.nan)),
        r"maze has the shape \(100000, 100000\)": lambda: GatheringEnv(np.broadcast_to(np.True_, (100_000, 100_000)), GOAL),
        "cell_um is missing": lambda: GatheringEnv(ms.Map.from_image(maze, 10), GOAL),
        "num_envs is 0, must be 1 to": lambda: GatheringVectorEnv(0, maze, GOAL),
        "num_envs is -1, must be 1 to": lambda: GatheringVectorEnv(-1, maze, GOAL),
        "8 GB": lambda: GatheringVectorEnv(10**6, np.ones((4000, 4000)), (5, 5)),
        "is not here|n_particles": lambda: environments.make("PulmonaryAlgorithmicFixedPCFixedGoal-v0"),
        "maze.csv": lambda: GatheringEnv(tmp_path / "maze.csv", GOAL),
    }.items():
        with pytest.raises(ms.InputError, match=words):
            call()
    env = GatheringEnv(maze, GOAL, n_particles=5)
    for bad in (8, -1, 1.5, None, "1", [1], np.nan, 10**30):
        with pytest.raises(ms.InputError, match="action"):
            env.step(bad)
    env.step(np.int64(3)), env.step(np.uint8(3)), env.step(True)
    batch = GatheringVectorEnv(3, maze, GOAL, n_particles=5)
    for bad in ([1, 2], [[0, 1], [2]], [1, 2, 8], [1, 2, -1], None, [1.0, 2.0, 3.0], 5, np.zeros((3, 1), int)):
        with pytest.raises(ms.InputError, match="action"):
            batch.step(bad)
    batch.step(np.arange(6)[::2])
    env.close(), env.close()
    with pytest.raises(ms.InputError, match="closed"):
        env.step(1)


def test_mazes_of_files_and_maps(maze, tmp_path):
    np.savetxt(tmp_path / "maze.csv", maze, delimiter=",", fmt="%d")
    (tmp_path / "maze.pgm").write_bytes(b"P5 40 30 255\n" + np.where(maze, 255, 0).astype(np.uint8).tobytes())
    for one in (tmp_path / "maze.csv", str(tmp_path / "maze.pgm"), maze.astype(float), np.asfortranarray(maze)):
        assert np.array_equal(environments.free_cells(one), maze)
    assert np.array_equal(environments.free_cells(ms.Map.from_image(maze, 10), 10), maze)
    for size in (0, -1, np.nan, 1e9, 1e-6):
        with pytest.raises(ms.InputError, match="cell_um"):
            environments.free_cells(ms.Map.from_image(maze, 10), size)


def test_observations_that_are_not_copied_stay_the_environments(maze):
    batch = GatheringVectorEnv(4, maze, GOAL, n_particles=50, copy=False)
    kept, _ = batch.reset(seed=1)
    before = kept.copy()
    assert batch.step([0, 1, 2, 3])[0] is kept and (kept != before).any()
    with pytest.raises(ValueError):
        kept[0] = 1
    copied = GatheringVectorEnv(4, maze, GOAL, n_particles=50)
    first, _ = copied.reset(seed=1)
    copied.step([0, 1, 2, 3])
    assert np.array_equal(first, before)
    del batch
    gc.collect()
    assert kept.sum() > 0  # keeps the environments alive


def test_copied_observations_are_not_written_again_while_they_are_held(maze):
    batch = GatheringVectorEnv(3, maze, GOAL, n_particles=50)
    other = GatheringVectorEnv(3, maze, GOAL, n_particles=50, copy=False)
    batch.reset(seed=1), other.reset(seed=1)
    held, expected, views = [], [], []
    for step in range(12):
        given = [step % 8, 3, 5]
        observations = batch.step(given)[0]
        expected.append(other.step(given)[0].copy())
        assert np.array_equal(observations, expected[-1])
        if step % 3 == 0:
            held.append((step, observations))
        if step % 4 == 0:
            views.append((step, observations[1]))
    assert all(np.array_equal(one, expected[step]) for step, one in held)
    assert all(np.array_equal(one, expected[step][1]) for step, one in views)


def test_environments_have_what_gymnasiums_have(maze):
    with GatheringVectorEnv(2, maze, GOAL, n_particles=5) as batch:
        assert batch.unwrapped is batch and batch.spec is None and batch.render_mode is None and not batch.closed
    assert batch.closed
    with pytest.raises(ms.InputError, match="closed"):
        batch.reset()


def test_two_threads_on_one_environment_are_told(maze):
    batch = GatheringVectorEnv(2000, maze, GOAL, physics="physical", n_particles=150, threads=1)
    told, given = [], np.zeros(2000, int)

    def steps():
        for _ in range(30):
            try:
                batch.step(given)
            except ms.InputError as error:
                told.append(str(error))

    both = [threading.Thread(target=steps) for _ in range(2)]
    [one.start() for one in both], [one.join() for one in both]
    assert told and all("in use" in text for text in told)


def test_a_picture_is_drawn(maze):
    env = GatheringEnv(maze, GOAL, n_particles=50, render_mode="rgb_array")
    env.reset(seed=1)
    image = env.render()
    assert image.shape == (30, 40, 3) and image.dtype == np.uint8
    assert tuple(image[0, 0]) == (15, 30, 65) and tuple(image[GOAL[1], GOAL[0]]) == (220, 60, 50)


def test_navigation_goes_to_the_goal():
    env = NavigationEnv(ms.Scenario.load(SCENARIOS / "first_flight.yaml").set("obstacles", "[]"), scaled=False)
    observation, info = env.reset(seed=1)
    assert observation in env.observation_space and info == {}
    assert observation[:2].tolist() == pytest.approx([1600, 0]) and observation[5] == 40
    assert observation[6:14].tolist() == pytest.approx([500, 500, 500, 282.8, 200, 282.8, 500, 500], abs=0.2)
    total = 0.0
    for steps in range(1, 1000):
        heading = np.arctan2(observation[1], observation[0])
        observation, reward, terminated, truncated, info = env.step((heading, 1))
        total += reward
        if terminated or truncated:
            break
    state = env.state
    assert terminated and not truncated and state["status"] == "solved"
    assert info == {"success": True, "is_success": True, "reason": "solved"}
    assert np.hypot(state["x_um"] - state["goal_x_um"], state["y_um"] - state["goal_y_um"]) <= 50.001
    limit = ms.Scenario.load(SCENARIOS / "first_flight.yaml").time_limit_s
    tick = ms.Scenario.load(SCENARIOS / "first_flight.yaml").tick_s
    assert total == pytest.approx((1600 - 50) / 1600 + 1 - 0.5 * steps * tick / limit, abs=0.01)
    again = env.step((0, 1))
    assert again[1] == 0 and again[2]  # nothing moves after the end


def test_a_contact_and_the_time_limit_end_a_navigation():
    env = NavigationEnv(SCENARIOS / "first_flight.yaml")
    env.reset(seed=1)
    for _ in range(1000):
        _, reward, terminated, truncated, info = env.step((-1, 0))
        if terminated or truncated:
            break
    assert terminated and env.state["status"] == "collided" and reward < -0.9
    assert info == {"success": False, "is_success": False, "reason": "collided"}
    env = NavigationEnv(ms.Scenario.load(SCENARIOS / "first_flight.yaml").set("time_limit_s", 2), time_penalty=0)
    env.reset(seed=1)
    tick = ms.Scenario.load(SCENARIOS / "first_flight.yaml").tick_s
    ends = [env.step((0, 0))[2:4] for _ in range(round(2 / tick))]
    assert not any(terminated for terminated, _ in ends) and [cut for _, cut in ends] == [False] * (len(ends) - 1) + [True]


def test_navigation_moves_as_a_run_does():
    """The same commands in a run with a navigator of one's own give the same places."""
    scenario = ms.Scenario.load(SCENARIOS / "first_flight.yaml").set("time_limit_s", 6)

    class Turning:
        def __init__(self):
            self.tick = 0

        def step(self, seen):
            self.tick += 1
            return 0.05 * self.tick, 0.5 * 80

    record = ms.run(scenario, navigator=Turning(), seed=3)
    env = NavigationEnv(scenario, scaled=False)
    env.reset(seed=3)
    assert env.max_speed_um_per_s == 80
    places = [(env.state["x_um"], env.state["y_um"])]
    for tick in range(1, record.frames.rows):
        env.step((0.05 * tick, 0.5))
        places.append((env.state["x_um"], env.state["y_um"]))
    assert np.array_equal(places, np.column_stack((record.frames["x_um"], record.frames["y_um"])))


def test_many_navigations_at_once_are_single_ones():
    scenario = SCENARIOS / "first_flight.yaml"
    values = dict(random_start=True, random_goal=True, rays=5, obstacles=2)
    batches = [NavigationVectorEnv(12, scenario, threads=threads, **values) for threads in (1, 2)]
    single = NavigationEnv(scenario, **values)
    first = [batch.reset(seed=4)[0] for batch in batches]
    alone, _ = single.reset(seed=4 + 5)
    assert np.array_equal(*first) and np.array_equal(first[0][5], alone) and alone.shape == (6 + 5 + 10,)
    assert len(np.unique(first[0], axis=0)) == 12
    for tick in range(60):
        given = np.column_stack((np.linspace(-1, 1, 12), np.full(12, 0.3)))
        steps = [batch.step(given) for batch in batches]
        assert all(np.array_equal(a, b) for a, b in zip(steps[0][:4], steps[1][:4]))
        if tick == 0 or not ended:
            alone, _, terminated, truncated, _ = single.step(given[5])
            ended = terminated or truncated
            assert np.array_equal(steps[0][0][5], alone)


def test_obstacles_are_seen_with_their_velocity():
    scenario = ms.Scenario.load(SCENARIOS / "oncoming.yaml")
    env = NavigationEnv(scenario, obstacles=1, rays=0, scaled=False)
    env.reset(seed=1)
    for _ in range(3):
        observation = env.step((0, 0))[0]
    assert observation.shape == (11,)
    x, y, radius, vx, vy = observation[6:].tolist()
    state = env.state
    later = env.step((0, 0))[0][6:].tolist()
    tick = scenario.tick_s
    assert (later[0] - x) / tick == pytest.approx(vx, abs=1) and (later[1] - y) / tick == pytest.approx(vy, abs=1)
    assert radius > 0 and np.hypot(vx, vy) > 0 and state["status"] == "running"


def test_the_arguments_of_a_navigation_are_checked():
    robots = next(path for path in (SCENARIOS / "papers").rglob("*.yaml") if "\nrobots:" in path.read_text())
    for words, call in {
        "one swarm": lambda: NavigationEnv(robots),
        "rays": lambda: NavigationEnv(SCENARIOS / "first_flight.yaml", rays=1000),
        "ray_range": lambda: NavigationEnv(SCENARIOS / "first_flight.yaml", ray_range_um=0),
        "colour": lambda: NavigationEnv(SCENARIOS / "first_flight.yaml", colour=1),
        "none.yaml": lambda: NavigationEnv("none.yaml"),
        "render_mode": lambda: NavigationEnv(SCENARIOS / "first_flight.yaml", render_mode="human"),
    }.items():
        with pytest.raises(ms.InputError, match=words):
            call()
    env = NavigationEnv(SCENARIOS / "first_flight.yaml")
    for bad in ((1,), (1, 1, 1), (10**400, 1), None, (np.nan, 1), (0, -1.1), (2, 0), (0, np.inf), "ab", 5):
        with pytest.raises(ms.InputError, match="action"):
            env.step(bad)
    env = NavigationEnv(SCENARIOS / "first_flight.yaml", scaled=False)
    for bad in ((np.nan, 1), (0, -0.1), (0, 1.1), (0, np.nan)):
        with pytest.raises(ms.InputError, match="action"):
            env.step(bad)
    batch = NavigationVectorEnv(2, SCENARIOS / "first_flight.yaml")
    for bad in ([[0, 1]], [[0, 1], [2]], [[0, 1], [0, 2]], [[0, 1], [np.inf, 1]], None, [0, 1], [["a", "b"], ["c", "d"]]):
        with pytest.raises(ms.InputError, match="action"):
            batch.step(bad)


def test_spaces():
    for space in (Discrete(8), MultiDiscrete([8, 8, 3]), Box(0, 255, (3, 2), np.uint8), Box(-1, 1, (4,), np.float32), Box(-np.inf, np.inf, (2,), np.float32)):
        space.seed(1)
        drawn = [space.sample() for _ in range(50)]
        assert all(one in space for one in drawn)
        space.seed(1)
        assert np.array_equal(drawn, [space.sample() for _ in range(50)])
        assert "(" in repr(space)
    assert 8 not in Discrete(8) and -1 not in Discrete(8) and 1.5 not in Discrete(8) and "a" not in Discrete(8)
    assert np.full((3, 2), 300) not in Box(0, 255, (3, 2), np.uint8) and np.zeros((2, 3), np.uint8) not in Box(0, 255, (3, 2), np.uint8)
