# SPDX-License-Identifier: Apache-2.0
"""Base class of environments."""

import numpy as np


def np_random(seed):
    if not (seed is None or type(seed) is int and seed >= 0):
        raise ValueError(f"seed is {seed!r}, must be a Python integer")
    sequence = np.random.SeedSequence(seed)
    return np.random.Generator(np.random.PCG64(sequence)), sequence.entropy


class Env:
    metadata = {"render_modes": []}
    render_mode = None
    spec = None
    _np_random = None
    _np_random_seed = None

    def step(self, action):
        raise NotImplementedError

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random, self._np_random_seed = np_random(seed)

    def render(self):
        raise NotImplementedError

    def close(self):
        pass

    @property
    def unwrapped(self):
        return self

    @property
    def np_random(self):
        if self._np_random is None:
            self._np_random, self._np_random_seed = np_random(None)
        return self._np_random

    @property
    def np_random_seed(self):
        return self.np_random and self._np_random_seed
