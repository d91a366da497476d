# SPDX-License-Identifier: Apache-2.0
"""Base classes of environments: Gymnasium's if it is installed, else own classes of the same names."""

from __future__ import annotations

import enum
import secrets
from typing import Any, Optional, Sequence, Union

import numpy as np


def generator(seed: Union[int, Sequence[int]]) -> np.random.Generator:
    """The generator that Gymnasium makes of a seed."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed)))


class Seeded:
    """Random numbers as Gymnasium's environments have them. The native module has its own."""

    _np_random: Optional[np.random.Generator] = None
    _np_random_seed: Optional[int] = None

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> Any:
        """Seeds np_random, if there is a seed."""
        if seed is not None:
            self._np_random, self._np_random_seed = generator(seed), seed

    @property
    def np_random(self) -> np.random.Generator:
        """A generator of the seed of the last reset; the environment does not draw from it."""
        if self._np_random is None:
            self._np_random_seed = secrets.randbits(63)
            self._np_random = generator(self._np_random_seed)
        return self._np_random

    @np_random.setter
    def np_random(self, value: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = value, -1

    @property
    def np_random_seed(self) -> Optional[int]:
        """Its seed; −1 if it was set without one."""
        assert self.np_random is not None  # it draws a seed if there is none
        return self._np_random_seed


class _Env(Seeded):
    """Base class of environments."""

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode: Optional[str] = None
    spec: Any = None


class _VectorEnv(Seeded):
    """Base class of environments that are stepped together."""

    metadata: dict[str, Any] = {}
    render_mode: Optional[str] = None
    spec: Any = None
    closed = False

    def close(self, **kwargs: Any) -> None:
        """Ends them; closing twice is no mistake."""
        if not self.closed:
            self.close_extras(**kwargs)
            self.closed = True

    def close_extras(self, **kwargs: Any) -> None:
        """Releases what an environment holds."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}(num_envs={getattr(self, 'num_envs', 0)})"


class _AutoresetMode(enum.Enum):
    """When an environment of a vector whose episode has ended begins the next one."""

    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


try:
    from gymnasium import Env
    from gymnasium.vector import VectorEnv
except ModuleNotFoundError:
    Env, VectorEnv = _Env, _VectorEnv  # type: ignore[misc, assignment]
try:
    from gymnasium.vector import AutoresetMode
except ImportError:  # none, or one before 1.1
    AutoresetMode = _AutoresetMode  # type: ignore[misc, assignment]

__all__ = ["AutoresetMode", "Env", "VectorEnv", "generator"]
