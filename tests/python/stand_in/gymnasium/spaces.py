# SPDX-License-Identifier: Apache-2.0
"""Spaces."""

import numpy as np


class Space:
    def __init__(self, shape, dtype, seed=None):
        self.shape, self.dtype = shape, np.dtype(dtype)
        self.seed(seed)

    def seed(self, seed=None):
        self.random = np.random.default_rng(seed)

    def __contains__(self, value):
        return self.contains(value)


class Box(Space):
    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        shape = np.shape(low) if shape is None else tuple(int(side) for side in shape)
        super().__init__(shape, dtype, seed)
        assert all(np.shape(bound) in ((), shape) for bound in (low, high)), "a bound must be a number or have the shape"
        self.low, self.high = (np.full(shape, bound, self.dtype) for bound in (low, high))
        assert (self.low <= self.high).all()

    def sample(self):
        if self.dtype.kind in "iu":
            return self.random.integers(self.low, self.high, endpoint=True, dtype=self.dtype)
        low, high = np.maximum(self.low, -1e3), np.minimum(self.high, 1e3)
        return self.random.uniform(low, high).astype(self.dtype)

    def contains(self, value):
        return isinstance(value, np.ndarray) and np.can_cast(value.dtype, self.dtype) and value.shape == self.shape and bool(np.all((value >= self.low) & (value <= self.high)))

    def __eq__(self, other):
        return isinstance(other, Box) and self.dtype == other.dtype and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high)


class Discrete(Space):
    def __init__(self, n, seed=None):
        self.n = np.int64(n)
        super().__init__((), np.int64, seed)

    def sample(self):
        return self.random.integers(self.n)

    def contains(self, value):
        return np.ndim(value) == 0 and np.asarray(value).dtype.kind in "iu" and 0 <= value < self.n

    def __eq__(self, other):
        return isinstance(other, Discrete) and self.n == other.n


class MultiDiscrete(Space):
    def __init__(self, nvec, seed=None):
        self.nvec = np.asarray(nvec, np.int64)
        super().__init__(self.nvec.shape, np.int64, seed)

    def sample(self):
        return self.random.integers(self.nvec)

    def contains(self, value):
        return np.shape(value) == self.shape and bool(np.all((np.asarray(value) >= 0) & (np.asarray(value) < self.nvec)))

    def __eq__(self, other):
        return isinstance(other, MultiDiscrete) and np.array_equal(self.nvec, other.nvec)


def batched(space, count):
    """The space of `count` values of a space."""
    if isinstance(space, Discrete):
        return MultiDiscrete([space.n] * count)
    low, high = (np.repeat(bound[None], count, axis=0) for bound in (space.low, space.high))
    return Box(low, high, low.shape, space.dtype)
