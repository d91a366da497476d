# SPDX-License-Identifier: Apache-2.0
"""Steering of a swarm past walls and moving obstacles to a goal: a scenario as an environment."""

from __future__ import annotations

import math
from typing import Any, Optional

import numpy as np

from .. import _core
from ..runs import Source, scenario_of
from ..values import array_of, refused, setting, whole
from .environment import SingleEnvironment, Steps, VectorEnvironment, count_of
from .spaces import Box


def _batch(scenario: Source, num_envs: int, threads: int, rules: dict[str, Any]) -> _core.NavigationBatch:
    settings = [setting(key, value) for key, value in rules.items()]
    return _core.NavigationBatch(scenario_of(scenario)._core, settings, num_envs, threads)


def _spaces(size: int, count: Optional[int] = None) -> tuple[Box, Box]:
    """Spaces of observations and actions."""
    first = () if count is None else (count,)
    low = np.broadcast_to(np.array([-math.pi, 0], np.float32), (*first, 2))
    high = np.broadcast_to(np.array([math.pi, 1], np.float32), (*first, 2))
    return Box(-np.inf, np.inf, (*first, size), np.float32), Box(low, high, (*first, 2), np.float32)


class NavigationEnv(SingleEnvironment):
    """A scenario of one swarm that the agent steers, tick by tick; any heading is allowed [rad].

    action_space         Box: heading_rad, and the speed as a share of the swarm's maximum
    observation_space    Box of float32: the state without camera delay and noise. In order: x and y of the goal
                         from the swarm [µm], cosine and sine of the heading, speed [µm/s], radius [µm]; the free
                         distance in `rays` directions, the first along x, counter-clockwise [µm]; and, for each of
                         the nearest `obstacles` moving obstacles, x and y from the swarm, radius [µm] and velocity [µm/s]
    reward               decrease of the distance to the goal as a share of the first distance, plus arrival_reward
                         at the goal, minus contact_penalty and time_penalty times the share of the time limit
    terminated           the goal is reached, or there was a contact
    truncated            the scenario's time limit has passed

    scenario    a Scenario or a file. Its navigator is not used; episode k of a seed has the random streams of
                trial k
    rules       rays, ray_range_um, obstacles, random_start, random_goal, arrival_reward, contact_penalty,
                time_penalty
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, scenario: Source, *, render_mode: Optional[str] = None, **rules: Any) -> None:
        if render_mode is not None:
            raise refused("render_mode", render_mode, "None")
        self._core = _batch(scenario, 1, 1, rules)
        self.observation_space, self.action_space = _spaces(self._shape()[0])

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Advances one tick; returns (observation, reward, terminated, truncated, info)."""
        try:
            heading, share = (float(one) for one in action)
        except (TypeError, ValueError, OverflowError):
            raise refused("action", action, "heading_rad and a share of the speed") from None
        return self._core.step_one(heading, share)

    @property
    def max_speed_um_per_s(self) -> float:
        """Maximum speed of the swarm."""
        return self._core.max_speed()

    @property
    def state(self) -> dict[str, Any]:
        """t_s, x_um, y_um, heading_rad, goal_x_um, goal_y_um and status."""
        return dict(zip(("t_s", "x_um", "y_um", "heading_rad", "goal_x_um", "goal_y_um", "status"), self._core.state(0)))


class NavigationVectorEnv(VectorEnvironment):
    """`num_envs` episodes of a scenario, stepped together on all cores; see NavigationEnv.

    threads    number of threads; 0: one a core. Results do not depend on it
    copy       False: each step updates and returns the same array of observations
    """

    def __init__(self, num_envs: int, scenario: Source, *, threads: int = 0, copy: bool = True, **rules: Any) -> None:
        core = _batch(scenario, count_of(num_envs), whole("threads", threads, 1024), rules)
        super().__init__(core, num_envs, copy)
        size = self._all.shape[1]
        self.single_observation_space, self.single_action_space = _spaces(size)
        self.observation_space, self.action_space = _spaces(size, num_envs)

    def step(self, actions: Any) -> Steps:
        """Applies actions of shape (num_envs, 2); returns arrays of observations, rewards, terminated, truncated, and info."""
        what = f"numbers of the shape ({self.num_envs}, 2)"
        return self._stepped(array_of("actions", actions, what, shape=(self.num_envs, 2)))
