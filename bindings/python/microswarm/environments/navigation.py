# SPDX-License-Identifier: Apache-2.0
"""Steering of a swarm past walls and moving obstacles to a goal: a scenario as an environment."""

from __future__ import annotations

import math
from typing import Any, Optional

import numpy as np

from .. import _core
from ..runs import Source, scenario_of
from ..values import array_of, refused, setting, whole
from .bases import AutoresetMode
from .environment import SingleEnvironment, Steps, VectorEnvironment, View, count_of, mode_of, render_mode_of
from .spaces import Box


def _arguments(scenario: Source, num_envs: int, threads: int, mode: Any, rules: dict[str, Any]) -> tuple[Any, ...]:
    """Arguments of the native module."""
    settings = [setting(key, value) for key, value in rules.items()]
    return scenario_of(scenario).copy(), settings, num_envs, threads, mode.value


def _spaces(rules: dict[str, Any], size: int, count: Optional[int] = None) -> tuple[Box, Box]:
    """Spaces of observations and actions."""
    first = () if count is None else (count,)

    def box(low: Any, high: Any) -> Box:
        low, high = (np.broadcast_to(np.asarray(one, np.float32), (*first, len(one))) for one in (low, high))
        return Box(low, high, low.shape, np.float32)

    if not rules["scaled"]:
        return Box(-np.inf, np.inf, (*first, size), np.float32), box([-math.pi, 0], [math.pi, 1])
    lowest = [-1, -1, -1, -1, 0, 0] + rules["rays"] * [0] + rules["obstacles"] * [-1, -1, 0, -1, -1]
    return box(lowest, [1] * size), box([-1, -1], [1, 1])


class NavigationView(View):
    """Attributes of one navigation."""

    @property
    def max_speed_um_per_s(self) -> float:
        """Maximum speed of the swarm."""
        return self._core.max_speed()

    @property
    def state(self) -> dict[str, Any]:
        """t_s, x_um, y_um, heading_rad, goal_x_um, goal_y_um and status."""
        return dict(zip(("t_s", "x_um", "y_um", "heading_rad", "goal_x_um", "goal_y_um", "status"), self._core.state(self._index)))

    def render(self) -> np.ndarray:
        """Colour picture of uint8, shape (rows, columns, 3), the longer side 480 pixels."""
        return self._core.picture(self._index)


class NavigationEnv(NavigationView, SingleEnvironment):
    """A scenario of one swarm that the agent steers, tick by tick; any heading is allowed.

    action_space         Box of float32, from −1 to 1: the velocity in x and y as shares of the swarm's maximum; what is
                         longer than 1 is cut to it
    observation_space    Box of float32, from −1 to 1: the state without camera delay and noise. In order: x and y of the
                         goal from the swarm, cosine and sine of the heading, speed, radius; the free distance in `rays`
                         directions, the first along x, counter-clockwise; and, for each of the nearest `obstacles` moving
                         obstacles, x and y from the swarm, radius and velocity, zeros where there are fewer. Free
                         distances are shares of ray_range, the speed is one of the maximum; a length d, that of an
                         offset too, is given as d / (d + ray_range), the speed v of an obstacle as v / (v + maximum)
    reward               decrease of the distance to the goal as a share of the first distance, plus arrival_reward
                         at the goal, minus contact_penalty and time_penalty times the share of the time limit
    terminated           the goal is reached, or there was a contact
    truncated            the scenario's time limit has passed, or max_episode_steps
    info                 at the end of an episode "success" and "is_success", and "reason": "solved", "collided",
                         "time_limit" or another status of a run

    scenario    a Scenario or a file. Its navigator is not used; episode k of a seed has the random streams of
                trial k
    rules       rays, ray_range_um, obstacles, random_start, random_goal, arrival_reward, contact_penalty,
                time_penalty, max_episode_steps, and scaled: False for observations in µm and µm/s and for actions of a
                heading [rad] and a share of the speed
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 25}
    _opened_by = _core.NavigationBatch

    def __init__(self, scenario: Source, *, render_mode: Optional[str] = None, **rules: Any) -> None:
        self.render_mode = render_mode_of(render_mode)
        self._arguments = _arguments(scenario, 1, 1, AutoresetMode.NEXT_STEP, rules)
        self._attach(self._open())
        self.observation_space, self.action_space = _spaces(self.rules, self._shape()[0])

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Advances one tick; returns (observation, reward, terminated, truncated, info)."""
        try:
            first, second = (float(one) for one in action)
        except (TypeError, ValueError, OverflowError):
            raise refused("action", action, "2 numbers: a velocity as shares of the maximum, or with scaled=False heading_rad and a share of the speed") from None
        return self._core.step_one(first, second)


class NavigationVectorEnv(VectorEnvironment):
    """`num_envs` episodes of a scenario, stepped together on all cores; see NavigationEnv and GatheringVectorEnv.

    threads           number of threads; 0: one a core. Results do not depend on it
    copy              False: each step updates and returns the same array of observations
    autoreset_mode    "NextStep", "SameStep" or "Disabled"
    """

    _opened_by = _core.NavigationBatch
    _view = NavigationView

    def __init__(
        self,
        num_envs: int,
        scenario: Source,
        *,
        threads: int = 0,
        copy: bool = True,
        autoreset_mode: Any = AutoresetMode.NEXT_STEP,
        render_mode: Optional[str] = None,
        **rules: Any,
    ) -> None:
        mode = mode_of(autoreset_mode)
        self._arguments = _arguments(scenario, count_of(num_envs), whole("threads", threads, 1024), mode, rules)
        super().__init__(num_envs, copy, mode, render_mode_of(render_mode))
        size = self._all.shape[1]
        self.single_observation_space, self.single_action_space = _spaces(self.rules, size)
        self.observation_space, self.action_space = _spaces(self.rules, size, num_envs)

    def step(self, actions: Any) -> Steps:
        """Applies actions of shape (num_envs, 2); returns arrays of observations, rewards, terminated, truncated, and infos."""
        what = f"numbers of the shape ({self.num_envs}, 2)"
        return self._stepped(array_of("actions", actions, what, shape=(self.num_envs, 2)))
