# SPDX-License-Identifier: Apache-2.0
"""A wrapper that asks of an environment what Gymnasium's do."""

import numpy as np

from ..vector import AutoresetMode, VectorEnv


class RecordEpisodeStatistics(VectorEnv):
    def __init__(self, env):
        if not isinstance(env, VectorEnv):
            raise TypeError(f"{type(env)} is no VectorEnv")
        if not isinstance(env.metadata["autoreset_mode"], AutoresetMode):
            raise TypeError("metadata['autoreset_mode'] must be an AutoresetMode")
        self.env, self.num_envs, self.mode = env, env.num_envs, env.metadata["autoreset_mode"]
        self.action_space, self.observation_space = env.action_space, env.observation_space

    def reset(self, *, seed=None, options=None):
        self.total, self.length = np.zeros(self.num_envs), np.zeros(self.num_envs, int)
        self.ended = np.zeros(self.num_envs, bool)
        return self.env.reset(seed=seed, options=options)

    def step(self, actions):
        seen, rewards, terminated, truncated, infos = self.env.step(actions)
        begins = self.ended & (self.mode is not AutoresetMode.SAME_STEP)
        self.total, self.length = np.where(begins, 0, self.total + rewards), np.where(begins, 0, self.length + 1)
        self.ended = terminated | truncated
        if self.ended.any():
            assert "episode" not in infos and "_episode" not in infos
            infos["episode"], infos["_episode"] = {"r": np.where(self.ended, self.total, 0), "l": np.where(self.ended, self.length, 0)}, self.ended
            if self.mode is AutoresetMode.SAME_STEP:
                self.total, self.length = np.where(self.ended, 0, self.total), np.where(self.ended, 0, self.length)
        return seen, rewards, terminated, truncated, infos

    def close_extras(self):
        self.env.close()
