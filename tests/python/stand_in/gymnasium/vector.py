# SPDX-License-Identifier: Apache-2.0
"""Environments that are stepped together."""

import enum

import numpy as np

from .core import Env, np_random
from .spaces import batched


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class VectorEnv:
    metadata = {}
    render_mode = None
    spec = None
    closed = False
    _np_random = None
    _np_random_seed = None
    np_random = Env.np_random
    np_random_seed = Env.np_random_seed

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random, self._np_random_seed = np_random(seed)

    def close(self, **kwargs):
        if not self.closed:
            self.close_extras(**kwargs)
            self.closed = True

    def close_extras(self):
        pass

    def __del__(self):
        if not getattr(self, "closed", True):
            self.close()

    @property
    def unwrapped(self):
        return self

    def add_info(self, infos, info, index):
        """Adds what one environment tells to what all tell: an array for each key, and a mask of those that have it."""
        for key, value in info.items():
            if key == "final_obs" or not isinstance(value, (dict, bool, int, float)):
                array = infos.get(key, np.full(self.num_envs, None, object))
            elif isinstance(value, dict):
                array = self.add_info(infos.get(key, {}), value, index)
            else:
                array = infos.get(key, np.zeros(self.num_envs, type(value)))
            if not isinstance(value, dict):
                array[index] = value
            mask = infos.get(f"_{key}", np.zeros(self.num_envs, bool))
            mask[index] = True
            infos[key], infos[f"_{key}"] = array, mask
        return infos


class SyncVectorEnv(VectorEnv):
    """The rules of the three modes, one environment after the other."""

    def __init__(self, makers, autoreset_mode=AutoresetMode.NEXT_STEP):
        self.envs = [maker() for maker in makers]
        self.num_envs = len(self.envs)
        self.mode = autoreset_mode
        self.metadata = {**self.envs[0].metadata, "autoreset_mode": autoreset_mode}
        self.single_action_space, self.single_observation_space = self.envs[0].action_space, self.envs[0].observation_space
        self.action_space, self.observation_space = (batched(one, self.num_envs) for one in (self.single_action_space, self.single_observation_space))
        self.seen = [None] * self.num_envs
        self.ended = np.zeros(self.num_envs, bool)

    def reset(self, *, seed=None, options=None):
        seeds = [None if seed is None else seed + i for i in range(self.num_envs)] if seed is None or isinstance(seed, int) else seed
        assert len(seeds) == self.num_envs
        infos = {}
        for i in np.flatnonzero((options or {}).get("reset_mask", np.ones(self.num_envs, bool))):
            self.seen[i], info = self.envs[i].reset(seed=seeds[i])
            self.ended[i] = False
            infos = self.add_info(infos, info, i)
        return np.stack(self.seen), infos

    def step(self, actions):
        infos, rewards = {}, np.zeros(self.num_envs)
        terminated, truncated = np.zeros((2, self.num_envs), bool)
        for i, env in enumerate(self.envs):
            if self.ended[i] and self.mode is AutoresetMode.NEXT_STEP:
                self.seen[i], info = env.reset()
            else:
                assert not self.ended[i]
                self.seen[i], rewards[i], terminated[i], truncated[i], info = env.step(actions[i])
                if self.mode is AutoresetMode.SAME_STEP and (terminated[i] or truncated[i]):
                    infos = self.add_info(infos, {"final_obs": self.seen[i], "final_info": info}, i)
                    self.seen[i], info = env.reset()
            infos = self.add_info(infos, info, i)
        self.ended = (terminated | truncated) if self.mode is not AutoresetMode.SAME_STEP else np.zeros(self.num_envs, bool)
        return np.stack(self.seen), rewards, terminated, truncated, infos
