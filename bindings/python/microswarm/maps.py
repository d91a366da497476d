# SPDX-License-Identifier: Apache-2.0
"""Maps, and paths in them."""

from __future__ import annotations

import json
import os
from typing import Any, Optional, Sequence

import numpy as np

from . import _core
from .scenario import text_of


class Map:
    """Walls of a place, with exact distances to them."""

    def __init__(self, core: _core.Map) -> None:
        self._core = core

    @classmethod
    def load(cls, path: str | os.PathLike[str], um_per_px: Optional[float] = None) -> "Map":
        """A picture, ROS .yaml, MovingAI .map, GeoJSON or CSV of rectangles."""
        return cls(_core.Map.load(os.fspath(path), um_per_px))

    @classmethod
    def from_image(
        cls, image: Any, um_per_px: float, *, threshold: float = 128, free: str = "bright", simplify_um: float = 0
    ) -> "Map":
        """A map from an array of the shape (height, width), the upper row first.

        The swarm may go where the image is at least `threshold`, or with free="dark" where it is below; of an
        array of booleans where it is True.
        """
        array = np.asarray(image)
        if array.ndim != 2 or array.dtype.kind not in "buif":
            raise _core.InputError(f"an image must have 2 dimensions and numbers, this one has {array.ndim} of type {array.dtype}")
        if free not in ("bright", "dark"):
            raise _core.InputError(f"free is {free!r}, must be 'bright' or 'dark'")
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise _core.InputError("an image must have finite values")
        bright = array if array.dtype.kind == "b" else array >= threshold
        open_pixels = bright if free == "bright" else ~bright
        return cls(_core.Map.from_pixels(np.ascontiguousarray(open_pixels, dtype=np.uint8), um_per_px, simplify_um))

    @property
    def bounds_um(self) -> tuple[float, float, float, float]:
        """x_lo, y_lo, x_hi, y_hi."""
        return tuple(self._core.bounds())

    @property
    def walls_um(self) -> list[list[np.ndarray]]:
        """Outlines of the walls: of each its ring and those of its holes, as arrays of the shape (n, 2)."""
        return self._core.outlines()

    @property
    def discs_um(self) -> np.ndarray:
        """Round walls: x, y, radius."""
        return self._core.discs()

    def clearance(self, places_um: Any) -> np.ndarray:
        """Distance from each place to walls and border [µm], 0 in a wall. The shape is (n, 2), the answer's (n,)."""
        return self._core.clearance(places_um)

    def is_free(self, places_um: Any, clearance_um: float = 0) -> np.ndarray:
        """Whether each place keeps a clearance from walls and border."""
        return self._core.are_free(places_um, clearance_um)

    def __repr__(self) -> str:
        x_lo, y_lo, x_hi, y_hi = self.bounds_um
        return f"<Map: {x_hi - x_lo:.6g} × {y_hi - y_lo:.6g} µm, {len(self.walls_um) + len(self.discs_um)} walls>"


class Path:
    """A path that was planned, or its beginning.

    solved, status, why_none   whether it leads to the goal, and why not
    points_um                  its points, of the shape (n, 2)
    length_um, turning_rad     with arcs as arcs
    time_s                     that the planner took
    planner                    the values that were used
    tree_um, parents           nodes of the search tree and the index of each node's parent
    """

    def __init__(self, made: dict[str, Any]) -> None:
        self.status: str = made["status"]
        self.why_none: str = made["why_none"]
        self.points_um: np.ndarray = made["path_um"]
        self.length_um: float = made["length_um"]
        self.turning_rad: float = made["turning_rad"]
        self.time_s: float = made["time_s"]
        self.planner: dict[str, Any] = json.loads(made["planner"])
        self.tree_um: np.ndarray = made["tree_um"]
        self.parents: np.ndarray = made["parents"]

    @property
    def solved(self) -> bool:
        return self.status == "solved"

    def __repr__(self) -> str:
        return f"<Path: {self.status}, {self.length_um:.6g} µm in {len(self.points_um)} points, {1e3 * self.time_s:.3g} ms>"


def plan(
    map: Map,
    start: Sequence[float],
    goal: Sequence[float],
    planner: str = "exact",
    clearance_um: Optional[float] = None,
    *,
    seed: int = 1,
    **values: Any,
) -> Path:
    """Plans a path in a map; what is not given follows from the map.

    start     (x_um, y_um) or (x_um, y_um, heading_rad)
    planner   "exact", the shortest path, or "drrt_star", "rrt_star", "rrt", "rrt_connect", "a_star",
              "theta_star", "fmt_star", …
    values    of the planner, with their units in their names: step_um=60, max_nodes=5000
    """
    settings = [f"planner.type={planner}"]
    if clearance_um is not None:
        settings.append(f"planner.clearance_um={text_of(clearance_um)}")
    settings += [f"planner.{key}={text_of(value)}" for key, value in values.items()]
    return Path(map._core.plan(list(start), list(goal), settings, seed))
