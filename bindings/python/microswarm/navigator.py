# SPDX-License-Identifier: Apache-2.0
"""A navigator of the library in your own loop."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np

from . import _core
from .runs import Source, scenario_of
from .values import InputError, refused, whole

_made = tuple.__new__  # without the checks of Command()


class Command(NamedTuple):
    """Command until the next step; speed 0 is a hold."""

    heading_rad: float
    speed_um_per_s: float
    state: str
    """ "follow", "hold", "arrived", "blind", …"""
    target_um: Optional[tuple[float, float]]
    """What the navigator heads for now."""
    planned: bool
    """Whether it called a planner."""


class Navigator:
    """The navigator of a scenario: it maps the detections of your camera to the command for your coils.

    nav = ms.Navigator(scenario)
    while True:
        command = nav.step(t, swarm=(x, y, heading, radius), obstacles=[(x1, y1, r1)])
    """

    def __init__(self, scenario: Source, *, trial: int = 0) -> None:
        """Uses map, swarm or robots, goal, navigator, tick and seed of a scenario or a file."""
        self._core = _core.Navigator(scenario_of(scenario)._core, whole("trial", trial, 2**32 - 1))

    def __reduce__(self) -> Any:
        raise TypeError("a Navigator remembers what it saw, and cannot be copied or pickled: make one of the scenario in each process")

    def step(
        self,
        t: float,
        swarm: Optional[Sequence[float]] = None,
        obstacles: Any = None,
        robots: Any = None,
        *,
        seen: Optional[float] = None,
        numbers: Optional[Sequence[int]] = None,
        unseen: int = 0,
    ) -> Command:
        """Returns the command from the time `t` [s] on.

        swarm      (x_um, y_um, heading_rad, radius_um); None if it was not detected, and for robots
        obstacles  array of shape (n, 3) with x_um, y_um, radius_um, or a list of such rows and of outlines of
                   shape (n, 2)
        robots     array of shape (n, 2); index i is the same robot in every step
        seen       time at which the picture was taken [s]; default `t`
        numbers    numbers of the obstacles, constant over all steps, 0 to 2147483647; default: matched by distance
        unseen     number of robots that were not detected, at expected positions
        """
        try:
            if numbers is not None:
                numbers = [whole("the number of an obstacle", one, 2**31 - 1) for one in numbers]
            return _made(Command, self._core.step(t, swarm, obstacles, robots, seen, numbers, unseen))
        except InputError:
            raise
        except RuntimeError:
            whole("unseen", unseen, 2**31 - 1)
            raise
        except (TypeError, ValueError):
            if not (numbers is None or isinstance(numbers, Iterable)):
                raise refused("numbers", numbers, "a whole number for each obstacle") from None
            raise InputError("t, seen and unseen must be numbers, obstacles and robots arrays of numbers") from None

    def path(self) -> np.ndarray:
        """The path that it follows, shape (n, 2) [µm]."""
        return self._core.path()

    def close(self) -> None:
        """Ends it; what is called later raises InputError. Closing twice is no mistake."""
        self._core.close()

    def __enter__(self) -> "Navigator":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
