# SPDX-License-Identifier: Apache-2.0
"""Spaces of environments: Gymnasium's if it is installed, else own classes of the same names."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

try:
    from gymnasium.spaces import Box, Discrete, MultiDiscrete
except ModuleNotFoundError:

    class _Space:
        shape: tuple[int, ...]
        dtype: Any

        def __init__(self, seed: Optional[int] = None) -> None:
            self.seed(seed)

        def seed(self, seed: Optional[int] = None) -> None:
            """Seeds sample()."""
            self._random = np.random.default_rng(seed)

        def __contains__(self, value: Any) -> bool:
            return self.contains(value)

        def contains(self, value: Any) -> bool:
            """Whether a value belongs to this space."""
            raise NotImplementedError

        def __eq__(self, other: Any) -> bool:
            return type(self) is type(other) and repr(self) == repr(other) and self._bounds_equal(other)

        def _bounds_equal(self, other: Any) -> bool:
            return True

    class Discrete(_Space):  # type: ignore[no-redef]
        """The whole numbers from 0 to n − 1."""

        def __init__(self, n: int, seed: Optional[int] = None) -> None:
            self.n = np.int64(n)
            self.start = np.int64(0)
            self.shape, self.dtype = (), np.dtype(np.int64)
            super().__init__(seed)

        def sample(self) -> np.int64:
            """A value at random."""
            return np.int64(self._random.integers(self.n))

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return bool(array.shape == () and array.dtype.kind in "iu" and 0 <= int(array) < self.n)

        def __repr__(self) -> str:
            return f"Discrete({self.n})"

    class MultiDiscrete(_Space):  # type: ignore[no-redef]
        """A whole number from 0 to nvec − 1 for each entry."""

        def __init__(self, nvec: Any, seed: Optional[int] = None) -> None:
            self.nvec = np.asarray(nvec, dtype=np.int64)
            self.shape, self.dtype = self.nvec.shape, np.dtype(np.int64)
            super().__init__(seed)

        def sample(self) -> np.ndarray:
            """A value at random."""
            return self._random.integers(self.nvec)

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return array.shape == self.shape and array.dtype.kind in "iu" and bool(((array >= 0) & (array < self.nvec)).all())

        def _bounds_equal(self, other: Any) -> bool:
            return np.array_equal(self.nvec, other.nvec)

        def __repr__(self) -> str:
            return f"MultiDiscrete({self.nvec})"

    class Box(_Space):  # type: ignore[no-redef]
        """Arrays of a given shape with bounded entries."""

        def __init__(self, low: Any, high: Any, shape: Optional[tuple[int, ...]] = None, dtype: Any = np.float32, seed: Optional[int] = None) -> None:
            self.dtype = np.dtype(dtype)
            self.shape = tuple(shape) if shape is not None else np.shape(low)
            self.low = np.broadcast_to(np.asarray(low, dtype=self.dtype), self.shape)
            self.high = np.broadcast_to(np.asarray(high, dtype=self.dtype), self.shape)
            super().__init__(seed)

        def sample(self) -> np.ndarray:
            """A random value; unbounded entries are normally distributed."""
            if self.dtype.kind in "iu":
                return self._random.integers(self.low, self.high, endpoint=True, dtype=self.dtype)
            low, high = (np.where(np.isfinite(bound), bound, 0) for bound in (self.low, self.high))
            bounded = np.isfinite(self.low) & np.isfinite(self.high)
            drawn = np.where(bounded, self._random.uniform(low, np.maximum(low, high)), self._random.standard_normal(self.shape))
            return np.clip(drawn, self.low, self.high).astype(self.dtype)

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return np.can_cast(array.dtype, self.dtype) and array.shape == self.shape and bool(((array >= self.low) & (array <= self.high)).all())

        def _bounds_equal(self, other: Any) -> bool:
            return np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high)

        def __repr__(self) -> str:
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


__all__ = ["Box", "Discrete", "MultiDiscrete"]
