# SPDX-License-Identifier: Apache-2.0
"""Maps, and paths in them."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Optional, Sequence

import numpy as np

from . import _core
from .pictures import Drawable
from .values import InputError, free_pixels, grid_of, number, numbers, path_text, refused, rows, setting, whole

MAX_SIDE_PX = 65_535
planners = _core.planners  # names that plan() takes


class Map(Drawable):
    """Walls of a workspace, with exact distances to them. It does not change, and pickles with all its walls."""

    def __init__(self, core: _core.Map) -> None:
        self._core = core

    def __copy__(self) -> "Map":
        return self  # it does not change

    def __deepcopy__(self, memo: Any) -> "Map":
        return self

    @classmethod
    def load(cls, path: str | os.PathLike[str], um_per_px: Optional[float] = None, *, um_per_unit: Optional[float] = None, **keys: Any) -> "Map":
        """A picture, ROS .yaml, MovingAI .map, GeoJSON, SVG, CSV of rectangles or matrix of 0 and 1.

        um_per_px    side of a pixel or cell
        um_per_unit  µm for a unit of a file in plane coordinates
        keys         of `map` in a scenario: free="dark", threshold=8, wall="one"; what was assumed is a warning
        """
        px = None if um_per_px is None else number("um_per_px", um_per_px)
        unit = None if um_per_unit is None else number("um_per_unit", um_per_unit)
        return cls(_core.Map.load(path_text(path), px, unit, [setting(f"map.{key}", value) for key, value in keys.items()]))

    @classmethod
    def from_walls(cls, bounds_um: Sequence[float], walls_um: Sequence[Any] = (), discs_um: Any = ()) -> "Map":
        """A map from the outlines of its walls, and from discs.

        bounds_um  (x_lo, y_lo, x_hi, y_hi)
        walls_um   an array of shape (n, 2) for each wall; overlapping walls are united
        discs_um   array of shape (n, 3): x, y, radius
        """
        box = numbers("bounds_um", bounds_um, (4,), "(x_lo, y_lo, x_hi, y_hi)")
        try:
            outlines = list(walls_um)
        except TypeError:
            raise refused("walls_um", walls_um, "a list of outlines, each of the shape (n, 2)") from None
        return cls(_core.Map.from_walls(box, [rows("an outline of walls_um", one) for one in outlines], rows("discs_um", discs_um, "(n, 3)")))

    @classmethod
    def from_image(
        cls, image: Any, um_per_px: float, *, threshold: Optional[float] = None, free: str = "bright", simplify_um: float = 0
    ) -> "Map":
        """A map from an array of shape (height, width), the upper row first.

        A pixel is free if it is at least `threshold`, or with free="dark" if it is below. In an array of booleans True is
        free, in one of only 0 and 1 the 1. The default threshold of uint8 is 128; other numbers have no default. An array that
        is all wall is refused, one without walls is a warning.
        """
        array = grid_of("image", image, MAX_SIDE_PX)
        if free not in ("bright", "dark"):
            raise refused("free", free, "'bright' or 'dark'")
        if threshold is None or array.dtype == bool:
            bright = free_pixels("threshold is missing: image", array, "give threshold")
        else:
            bright = array >= number("threshold", threshold)
        open_pixels = bright if free == "bright" else ~bright
        if not open_pixels.any():
            raise InputError(f"all of image is wall: its values are {array.min():g} to {array.max():g}, see threshold and free")
        return cls(_core.Map.from_pixels(np.ascontiguousarray(open_pixels, dtype=np.uint8), number("um_per_px", um_per_px), number("simplify_um", simplify_um)))

    @property
    def bounds_um(self) -> tuple[float, float, float, float]:
        """x_lo, y_lo, x_hi, y_hi."""
        x_lo, y_lo, x_hi, y_hi = self._core.bounds()
        return x_lo, y_lo, x_hi, y_hi

    @property
    def walls_um(self) -> list[list[np.ndarray]]:
        """Outlines of the walls: for each its outer ring and its holes, as arrays of shape (n, 2)."""
        return self._core.outlines()

    @property
    def discs_um(self) -> np.ndarray:
        """Round walls: x, y, radius."""
        return self._core.discs()

    def clearance(self, places_um: Any) -> np.ndarray:
        """Distance of each position, shape (n, 2), from walls and border [µm], shape (n,); 0 in a wall."""
        return self._core.clearance(rows("places_um", places_um))

    def is_free(self, places_um: Any, clearance_um: float = 0) -> np.ndarray:
        """Whether each position keeps a clearance from walls and border."""
        return self._core.are_free(rows("places_um", places_um), number("clearance_um", clearance_um))

    def _picture(self, file: Optional[str]) -> Optional[bytes]:
        return self._core.draw(file)

    def __repr__(self) -> str:
        x_lo, y_lo, x_hi, y_hi = self.bounds_um
        return f"<Map: {x_hi - x_lo:.6g} × {y_hi - y_lo:.6g} µm, {len(self.walls_um) + len(self.discs_um)} walls>"


def core_of(map: Map) -> Any:
    """The native map of an argument."""
    if not isinstance(map, Map):
        raise refused("map", map, "a Map: Map.load(file) or Map.from_image(array, um_per_px)")
    return map._core


class Path(Drawable):
    """A planned path, or its beginning.

    solved, status, why_none   whether it leads to the goal, and why not
    points_um                  its points, shape (n, 2)
    length_um, turning_rad     of true arcs
    time_s                     computing time of the planner
    planner                    values of the planner that were used
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
        self._draw: Optional[Callable[[Optional[str]], Optional[bytes]]] = made["draw"]

    @property
    def solved(self) -> bool:
        return self.status == "solved"

    def _picture(self, file: Optional[str]) -> Optional[bytes]:
        if self._draw is None:
            raise InputError("a path that was pickled cannot be drawn: its map is not with it")
        return self._draw(file)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_draw": None}

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
    """Plans a path in a map; values that are not given are fitted to the map.

    start     (x_um, y_um) or (x_um, y_um, heading_rad)
    planner   "exact", the shortest path, or another of microswarm.planners
    values    of the planner, with their units in their names: step_um=60, max_nodes=5000
    """
    settings = [setting("planner.type", planner)]
    if clearance_um is not None:
        settings.append(setting("planner.clearance_um", clearance_um))
    settings += [setting(f"planner.{key}", value) for key, value in values.items()]
    begin = numbers("start", start, (2, 3), "(x_um, y_um) or (x_um, y_um, heading_rad)")
    end = numbers("goal", goal, (2,), "(x_um, y_um)")
    return Path(core_of(map).plan(begin, end, settings, whole("seed", seed, 2**64 - 1)))
