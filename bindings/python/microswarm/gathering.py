# SPDX-License-Identifier: Apache-2.0
"""Gathering of many robots under one input."""

from __future__ import annotations

from typing import Any, Mapping, Optional, Sequence

import numpy as np

from . import _core
from .maps import Map, core_of
from .record import Record
from .runs import Progress, Session
from .values import InputError, mapping, number, numbers, rows, setting, whole


class Gathering:
    """Result of gathering robots.

    solved, status     whether the robots are gathered, and the final status
    steps              number of inputs applied
    inputs_um          displacement of a robot without contact by each input, shape (steps, 2)
    robots_um          final positions of the robots, shape (n, 2)
    mean_distance_um   mean length of the robots' shortest paths to the goal at the end
    notes              properties of the map that do not suit the method, a line each
    record             the Record, to save, replay or draw
    """

    def __init__(self, record: Record, tick_s: float, notes: list[str]) -> None:
        frames = record.frames
        self.record = record
        self.status: str = record.status
        self.steps: int = len(record.step_time_s)
        length = frames["command_speed_um_per_s"][: self.steps] * tick_s
        heading = frames["command_heading_rad"][: self.steps]
        self.inputs_um: np.ndarray = np.column_stack((length * np.cos(heading), length * np.sin(heading)))
        self.robots_um: np.ndarray = record.robots_um[-1] if len(record.robots_t_s) else np.empty((0, 2))
        self.mean_distance_um: float = record.metrics["goal_distance_um"]
        self.notes = notes

    @property
    def solved(self) -> bool:
        """Whether the robots are gathered."""
        return self.status == "solved"

    def __repr__(self) -> str:
        return f"<Gathering: {self.status} after {self.steps} inputs, {self.mean_distance_um:.4g} µm from the goal on average>"


def gather(
    map: Map,
    goal_um: Sequence[float],
    robots_um: Any = None,
    *,
    n: Optional[int] = None,
    method: str = "rollout",
    seed: int = 1,
    channel_width_um: Optional[float] = None,
    max_steps: int = 100_000,
    settings: Optional[Mapping[str, Any]] = None,
    progress: Progress = None,
    **values: Any,
) -> Gathering:
    """Simulates gathering robots at a goal with one input for all, like `microswarm gather`.

    goal_um           (x_um, y_um), in a dead end
    robots_um         initial positions, shape (n, 2); default: `n` robots, 256 if not given, at random
                      positions from which the goal can be reached
    method            "rollout", "divide_and_conquer", "heuristic" or "dynamic_shortest_path"
    channel_width_um  typical width of the map's channels, which scales all lengths; default: measured
    values            values of the navigator: gathered="all", rollout={"horizon": 30}, …
    settings          values of any other key of the scenario: {"robots.speed_spread": 0.1}
    progress          called with the completed share; False: nothing is shown
    """
    given = [setting("navigator.method", method)]
    for key, value in values.items():
        inner = value.items() if isinstance(value, Mapping) else ()
        given += [setting(f"navigator.{key}.{part}", one) for part, one in inner] or [setting(f"navigator.{key}", value)]
    given += [setting(key, value) for key, value in mapping("settings", settings).items()]
    if robots_um is None:
        starts = np.empty((0, 2))
        n = 256 if n is None else whole("n", n, 1_000_000, least=1)
    else:
        starts = rows("robots_um", robots_um)
        if n is not None:
            raise InputError("n and robots_um are both given")
        if len(starts) == 0:
            raise InputError("robots_um has no robots")
        n = 0
    if channel_width_um is not None and not 1e-3 <= number("channel_width_um", channel_width_um) <= 1e6:
        raise InputError(f"channel_width_um is {channel_width_um}, must be 0.001 to 1e6")
    max_steps = whole("max_steps", max_steps, 100_000_000, least=1)
    goal = numbers("goal_um", goal_um, (2,), "(x_um, y_um)")
    core, tick, notes = _core.gather(
        core_of(map), goal, n, starts, channel_width_um, max_steps, given, whole("seed", seed, 2**64 - 1)
    )
    with Session._of(core) as session:
        return Gathering(session.finish(progress), tick, notes)
