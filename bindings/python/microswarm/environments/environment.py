# SPDX-License-Identifier: Apache-2.0
"""Common base of all environments."""

from __future__ import annotations

import copy as copies
import json
import secrets
import sys
from typing import Any, Optional, Sequence, Union

import numpy as np

from ..values import InputError, refused, seed_of, told, whole
from .bases import AutoresetMode, Env, VectorEnv, generator

Steps = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]
Seeds = Union[int, Sequence[Optional[int]], None]


def count_of(num_envs: Any) -> int:
    """Checks a number of environments."""
    return whole("num_envs", num_envs, 10**6, least=1)


def mode_of(autoreset_mode: Any) -> Any:
    """Checks an AutoresetMode, or its name."""
    try:
        return AutoresetMode(getattr(autoreset_mode, "value", autoreset_mode))
    except ValueError:
        raise refused("autoreset_mode", autoreset_mode, f"an AutoresetMode: {', '.join(repr(one.value) for one in AutoresetMode)}") from None


def render_mode_of(render_mode: Any) -> Optional[str]:
    """Checks a render_mode."""
    if render_mode not in (None, "rgb_array"):
        raise refused("render_mode", render_mode, "'rgb_array' or None")
    return render_mode


def fresh_seed() -> int:
    """A seed from the operating system's entropy."""
    return secrets.randbits(63)


class Environments:
    """One or many environments of the native module; they can be copied and pickled.

    A copy continues identically. It shares the maze or the scenario, which do not change; a pickle holds the inputs of the
    episode, which are played again.
    """

    _core: Any
    _opened_by: Any  # class of the native module
    _arguments: tuple[Any, ...]  # which it is opened with
    _is_seeded = False
    _native: tuple[str, ...] = ("_core",)  # attributes that _attach() makes
    _shared: tuple[str, ...] = ("_arguments", "spec", "metadata")  # attributes that never change

    def _open(self) -> Any:
        """A new native object."""
        return self._opened_by(*(getattr(one, "_core", one) for one in self._arguments))

    def _attach(self, core: Any) -> None:
        """Takes a native object."""
        self._core = core

    @property
    def rules(self) -> dict[str, Any]:
        """All rules and their values."""
        return json.loads(self._core.rules())

    @property
    def unwrapped(self) -> Any:
        """The environment itself, since there is no wrapper."""
        return self

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()  # type: ignore[attr-defined]

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        made = type(self).__new__(type(self))
        memo[id(self)] = made
        for key, value in self.__dict__.items():
            if key not in self._native:
                made.__dict__[key] = value if key in self._shared else copies.deepcopy(value, memo)
        made._attach(self._core.copy())
        return made

    def __copy__(self) -> Any:
        return copies.deepcopy(self)

    def __getstate__(self) -> dict[str, Any]:
        kept = {key: value for key, value in self.__dict__.items() if key not in self._native}
        return {**kept, "states": self._core.states()}

    def __setstate__(self, kept: dict[str, Any]) -> None:
        kept = dict(kept)
        states = kept.pop("states")
        self.__dict__.update(kept)
        core = self._open()
        core.restore(states)
        self._attach(core)


class View:
    """Attributes of one environment."""

    _core: Any
    _index = 0
    rules: Any

    def render(self) -> np.ndarray:
        """Colour picture of uint8, shape (rows, columns, 3)."""
        raise NotImplementedError


class SingleEnvironment(Environments, Env):
    """One environment."""

    def _shape(self) -> tuple[int, ...]:
        return self._core.observations().shape[1:]

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode: the first of a seed, or the next. The first reset without a seed draws one, np_random_seed."""
        given = seed_of(seed)
        if given is None and not self._is_seeded:
            given = fresh_seed()
        if given is not None:
            super().reset(seed=given)
            self._is_seeded = True
        self._core.reset(given)
        return self._core.observation(0), {}

    def close(self) -> None:
        """Ends it; what is called later raises InputError. Closing twice is no mistake."""
        self._core.close()


class VectorEnvironment(Environments, VectorEnv):
    """Environments that are stepped together on all cores.

    Environment i is seeded with seed + i and equals a single environment with that seed.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 25, "autoreset_mode": AutoresetMode.NEXT_STEP}
    single_action_space: Any
    single_observation_space: Any
    _view: type[View]
    _native = ("_core", "_all", "_made")

    def __init__(self, num_envs: int, copy: bool, autoreset_mode: Any, render_mode: Optional[str]) -> None:
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "autoreset_mode": autoreset_mode}
        self._copy = copy
        self._attach(self._open())

    def _attach(self, core: Any) -> None:
        super()._attach(core)
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
        rewards, terminated, truncated, ends = self._core.step(actions, array)
        infos = {} if ends is None else self._infos(ends)
        return self._all if array is None else array, rewards, terminated, truncated, infos

    def _infos(self, ends: list[tuple[int, bool, str]]) -> dict[str, Any]:
        """Success and reason of the episodes that have ended: arrays, and masks of those that have an entry."""
        ended = np.zeros(self.num_envs, bool)
        success = np.zeros(self.num_envs, bool)
        reason = np.full(self.num_envs, None, object)
        for index, is_success, word in ends:
            ended[index], success[index], reason[index] = True, is_success, word
        values = {"success": success, "is_success": success.copy(), "reason": reason}
        infos = dict(values)
        infos.update((f"_{key}", ended.copy()) for key in values)
        if self.metadata["autoreset_mode"] is not AutoresetMode.SAME_STEP:
            return infos
        last = np.full(self.num_envs, None, object)
        for index, _, _ in ends:
            last[index] = self._core.final_observation(index)
        return {"final_obs": last, "_final_obs": ended, "final_info": infos, "_final_info": ended.copy()}

    def reset(self, *, seed: Seeds = None, options: Optional[dict[str, Any]] = None) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode in each environment: the first of a seed, or the next.

        seed       environment i gets seed + i; or a list of a seed, or None, for each. The first reset without a seed draws
                   one, np_random_seed
        options    {"reset_mask": array of booleans}: only these environments are reset
        """
        if seed is None and not self._is_seeded:
            seed = fresh_seed()
        seeds = self._seeds(seed)
        mask = self._mask(options)
        if not isinstance(seeds, list) and mask is None:
            self._core.reset(seeds)
        else:
            each = seeds if isinstance(seeds, list) else [None if seeds is None else (seeds + i) % 2**64 for i in range(self.num_envs)]
            self._core.reset_some(each, [True] * self.num_envs if mask is None else mask.tolist())
        if isinstance(seeds, list):
            self._np_random, self._np_random_seed = generator([one for one in seeds if one is not None]), -1
        elif seeds is not None:
            self._np_random, self._np_random_seed = generator(seeds), seeds
        self._is_seeded = self._is_seeded or seed is not None
        return self._all.copy() if self._copy else self._all, {}

    def _seeds(self, seed: Any) -> Union[int, list[Optional[int]], None]:
        """Checks seeds."""
        if not isinstance(seed, (list, tuple, np.ndarray)):
            return seed_of(seed)
        if len(seed) != self.num_envs:
            raise InputError(f"seed has the length {len(seed)}, must be a seed for each of the {self.num_envs} environments")
        return [seed_of(one) for one in seed]

    def _mask(self, options: Any) -> Optional[np.ndarray]:
        """Checks the mask of the environments to reset."""
        mask = options.get("reset_mask") if isinstance(options, dict) else None
        if mask is None:
            return None
        if not isinstance(mask, np.ndarray) or mask.dtype != bool or mask.shape != (self.num_envs,):
            raise InputError(f"reset_mask is {told(mask)}, must be a NumPy array of {self.num_envs} booleans")
        if not mask.any():
            raise InputError("reset_mask has no True: there is nothing to reset")
        return mask

    def _views(self) -> list[View]:
        shared = {"action_space": self.single_action_space, "observation_space": self.single_observation_space, "rules": self.rules}
        shared |= {"_core": self._core, "render_mode": self.render_mode, "spec": self.spec}
        views = [self._view() for _ in range(self.num_envs)]
        for index, view in enumerate(views):
            view.__dict__.update(shared, _index=index)
        return views

    def call(self, name: str, *args: Any, **kwargs: Any) -> tuple[Any, ...]:
        """The attribute of each environment, or what its method returns."""
        made = [getattr(view, name) for view in self._views()]
        return tuple(one(*args, **kwargs) if callable(one) else one for one in made)

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """The attribute of each environment, such as "goal" or "state"."""
        return self.call(name)

    def set_attr(self, name: str, values: Any) -> None:
        """Refused: the rules are the same for all, and are given when they are made."""
        raise InputError(f"{told(name)} cannot be set: make the environments with other values")

    def render(self) -> tuple[np.ndarray, ...]:
        """Colour picture of each environment, shape (rows, columns, 3)."""
        return tuple(view.render() for view in self._views())

    def close_extras(self, **_: Any) -> None:
        core = getattr(self, "_core", None)  # none if it was refused
        if core is not None:
            core.close()
