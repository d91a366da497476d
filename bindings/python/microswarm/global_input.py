# SPDX-License-Identifier: Apache-2.0
"""Global inputs that bring each of several robots to its own goal."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from . import _core
from .maps import Map, core_of
from .values import InputError, flag, number, rows, setting, whole


class GlobalPlan:
    """Inputs for several robots.

    solved, status, why_none   whether every robot reaches its goal, and why not
    inputs_um                  moves, shape (inputs, 2)
    paths_um                   positions of the robots before the first input and after each: (inputs + 1, robots, 2)
    worst_um                   largest final distance of a robot from its goal
    inputs_found               number of inputs before superfluous ones were removed
    nodes, time_s              nodes and computing time of the planner

    A plan that is not solved leads to the best configuration found.
    """

    def __init__(self, made: dict[str, Any]) -> None:
        self.status: str = made["status"]
        self.why_none: str = made["why_none"]
        self.inputs_um: np.ndarray = made["inputs_um"]
        self.paths_um: np.ndarray = made["paths_um"]
        self.worst_um: float = made["worst_um"]
        self.inputs_found: int = made["inputs_found"]
        self.nodes: int = made["nodes"]
        self.time_s: float = made["time_s"]

    @property
    def solved(self) -> bool:
        """Whether every robot reaches its goal."""
        return self.status == "solved"

    def __repr__(self) -> str:
        return f"<GlobalPlan: {self.status}, {len(self.inputs_um)} inputs, {self.worst_um:.4g} µm off, {1e3 * self.time_s:.3g} ms>"


def global_plan(
    map: Map,
    robots_um: Any,
    goals_um: Any,
    planner: str = "global_search",
    *,
    seed: int = 1,
    shorten: bool = True,
    time_limit_s: Optional[float] = None,
    **values: Any,
) -> GlobalPlan:
    """Plans global inputs that bring each robot to its own goal, like `microswarm global`.

    robots_um, goals_um   positions, shape (n, 2), of 1 to 64 robots, in the same order
    planner               "global_search" or "global_rrt"
    shorten               remove superfluous inputs
    time_limit_s          after which the best plan so far is returned, with the status "time_limit"
    values                values of the planner: robostep_um=5, goal_tolerance_um=10, separation_um=20, max_nodes=100000, …

    InputError if a robot or goal is in a wall, or a goal is cut off.
    """
    settings = [setting("planner.type", planner)]
    settings += [setting(f"planner.{key}", value) for key, value in values.items()]
    starts, goals = rows("robots_um", robots_um), rows("goals_um", goals_um)
    if len(goals) == 0:
        raise InputError("goals_um has no places")
    if time_limit_s is not None and not 0 <= number("time_limit_s", time_limit_s) <= 1e6:
        raise InputError(f"time_limit_s is {time_limit_s}, must be 0 to 1e6")
    seed = whole("seed", seed, 2**64 - 1)
    return GlobalPlan(_core.global_plan(core_of(map), starts, goals, settings, seed, flag("shorten", shorten), time_limit_s))
