# SPDX-License-Identifier: Apache-2.0
"""Common base of all environments."""

from __future__ import annotations

import json
import sys
from typing import Any, Optional

import numpy as np

from ..values import seed_of, whole
from .spaces import Env

Steps = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]


def count_of(num_envs: Any) -> int:
    """Checks a number of environments."""
    return whole("num_envs", num_envs, 10**6, least=1)


class Environments:
    """One or many environments of the native module."""

    _core: Any

    @property
    def rules(self) -> dict[str, Any]:
        """All rules and their values."""
        return json.loads(self._core.rules())

    @property
    def unwrapped(self) -> Any:
        """The environment itself, since there is no wrapper."""
        return self

    def close(self) -> None:
        """Ends it; what is called later raises InputError. Closing twice is no mistake."""
        self._core.close()

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class SingleEnvironment(Environments, Env):
    """One environment."""

    def _shape(self) -> tuple[int, ...]:
        return self._core.observations().shape[1:]

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode: the first of a seed, or the next."""
        self._core.reset(seed_of(seed))
        return self._core.observation(0), {}


class VectorEnvironment(Environments):
    """Environments that are stepped together on all cores.

    Environment i is seeded with seed + i and equals a single environment with that seed. After the end of an episode,
    the following step begins the next one, with reward 0 (Gymnasium's "next step").
    """

    metadata: dict[str, Any] = {"autoreset_mode": "NextStep"}
    spec: Any = None
    render_mode: Optional[str] = None
    closed = False

    def __init__(self, core: Any, num_envs: int, copy: bool) -> None:
        self.num_envs = num_envs
        self._core = core
        self._copy = copy
        self._all = core.observations()
        self._all.flags.writeable = False
        self._made: list[np.ndarray] = []

    def _array(self) -> Optional[np.ndarray]:
        """Array for a copy of the observations: a kept one that is no longer referenced, or a new one."""
        if not self._copy:
            return None
        for one in self._made:
            if sys.getrefcount(one) == 3:  # references: the list, `one` and the call
                return one
        self._made = [np.empty_like(self._all), *self._made[:2]]
        return self._made[0]

    def _stepped(self, actions: np.ndarray) -> Steps:
        array = self._array()
        rewards, terminated, truncated = self._core.step(actions, array)
        return self._all if array is None else array, rewards, terminated, truncated, {}

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode in each environment: the first of a seed, or the next."""
        self._core.reset(seed_of(seed))
        return self._all.copy() if self._copy else self._all, {}

    def close(self) -> None:
        super().close()
        self.closed = True
