# SPDX-License-Identifier: Apache-2.0
"""Coils: their fields, the currents for a field, and calibration."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _core
from .values import InputError, flag, numbers, path_text, refused, rows, text

PathLike = Union[str, "os.PathLike[str]"]

MAX_FIELD_MT = 1e6
MAX_PLACE_UM = 1e9
MAX_CURRENT_A = 1e6


class Coils:
    """A system of coils: the field is linear in the currents, with a matrix that depends on the position.

    coils = ms.Coils.load("coils.yaml")
    currents_a = coils.currents(fields_mt)          # (n, 3) in, (n, coils) out
    coils.field(currents_a)                         # the fields of these currents

    Every method also takes a single row of shape (3,) or (coils,) and then returns a row. `at_um` is one position
    (x, y, z) or one for each row; default: the centre of the coils. A position outside a measured grid is an InputError.
    Coils do not change. Calibrated ones pickle; of others each process loads the file.
    """

    def __init__(self, core: _core.Coils, fit: Optional[dict[str, Any]] = None) -> None:
        self._core = core
        self.fit = fit
        """Quality of a calibration: rms_mt, rms_abs_mt, worst_mt, worst_row, residuals_mt, field_mt_per_a, field_error_mt_per_a
        (standard errors; NaN without freedom), offset_mt, centre_um, and the gradients in T/m/A if they were fitted."""

    def __copy__(self) -> "Coils":
        return self  # it does not change

    def __deepcopy__(self, memo: Any) -> "Coils":
        return self

    @classmethod
    def load(cls, path: PathLike) -> "Coils":
        """Reads a coil system, or the coils of a rig, whose driver limits the currents too."""
        return cls(_core.Coils.load(path_text(path)))

    @classmethod
    def from_measurements(
        cls,
        currents_a: Any,
        fields_mt: Any,
        positions_um: Any = None,
        *,
        names: Optional[Sequence[str]] = None,
        name: str = "",
        offset: bool = False,
        gradients: bool = False,
        centre_um: Optional[Sequence[float]] = None,
    ) -> "Coils":
        """Fits the coils' fields to measured ones by least squares, like `microswarm rig calibrate`.

        currents_a     current of each coil, shape (n, coils)
        fields_mt      measured fields, shape (n, 3)
        positions_um   positions of the probe, shape (n, 3); default (0, 0, 0)
        names          names of the coils; default coil1, coil2, …
        offset         fit the field without current too
        gradients      fit the gradients too, for which the positions must differ
        centre_um      position of the matrix if gradients are fitted; default: the middle of the positions

        The quality of the fit is in `fit`. InputError if the measurements do not determine it.
        """
        currents = checked_rows("currents_a", currents_a, None, MAX_CURRENT_A)
        fields = checked_rows("fields_mt", fields_mt, 3, MAX_FIELD_MT)
        places = np.zeros((len(currents), 3)) if positions_um is None else checked_rows("positions_um", positions_um, 3, MAX_PLACE_UM)
        if names is None:
            names = [f"coil{k + 1}" for k in range(currents.shape[1])]
        words = list(names) if isinstance(names, Iterable) and not isinstance(names, str) else []
        if len(words) != currents.shape[1]:
            raise refused("names", names, f"{currents.shape[1]} words, one for each column of currents_a")
        words = [text("one of names", one) for one in words]
        parts = flag("offset", offset), flag("gradients", gradients)
        if not 1 <= len(words) <= 64:
            raise InputError(f"currents_a has {len(words)} columns, must be 1 to 64")
        return cls(*_core.Coils.of_arrays(currents, fields, places, words, text("name", name), *parts, centre(centre_um)))

    @classmethod
    def from_csv(
        cls, path: PathLike, *, offset: bool = False, gradients: bool = False, centre_um: Optional[Sequence[float]] = None
    ) -> "Coils":
        """The same from the file that `microswarm rig calibrate` reads or measures: i_NAME_a of each coil, bx_mt, by_mt,
        bz_mt, and optionally x_um, y_um, z_um."""
        return cls(*_core.Coils.of_file(path_text(path), flag("offset", offset), flag("gradients", gradients), centre(centre_um)))

    def save(self, path: PathLike) -> None:
        """Writes calibrated coils as a coil system (YAML). The coils' limits are missing: add `drives`."""
        self._core.save(path_text(path))

    @property
    def name(self) -> str:
        """Name of the system."""
        return self._core.name()

    @property
    def names(self) -> list[str]:
        """Names of the coils."""
        return self._core.names()

    @property
    def centre_um(self) -> tuple[float, float, float]:
        """Centre of the system or of its workspace."""
        x, y, z = self._core.centre()
        return x, y, z

    def __len__(self) -> int:
        return len(self.names)

    def matrix(self, at_um: Optional[Sequence[float]] = None) -> np.ndarray:
        """Field of each coil per ampere at a position [mT/A], shape (3, coils)."""
        return self._core.matrix(self._place(at_um))

    def in_workspace(self, at_um: Sequence[float]) -> bool:
        """Whether the calibration is valid at a position; always true for windings and a matrix."""
        return self._core.in_workspace(self._place(at_um))

    def currents(self, fields_mt: Any, at_um: Any = None) -> np.ndarray:
        """Minimum-norm currents for each field [A]; for the nearest field if the coils cannot make it.

        They are not limited: multiply by allowed_share(currents) for currents that the coils can hold.
        """
        return self._each(self._core.currents, "fields_mt", fields_mt, 3, MAX_FIELD_MT, at_um)

    def field(self, currents_a: Any, at_um: Any = None) -> np.ndarray:
        """Field of the currents [mT]."""
        return self._each(self._core.fields, "currents_a", currents_a, len(self), MAX_CURRENT_A, at_um)

    def gradient(self, currents_a: Any, at_um: Any = None) -> np.ndarray:
        """Gradient of the field of the currents [T/m], shape (n, 3, 3): ∂B_i/∂x_j."""
        made = self._each(self._core.gradients, "currents_a", currents_a, len(self), MAX_CURRENT_A, at_um)
        return made.reshape(*made.shape[:-1], 3, 3)

    def allowed_share(self, currents_a: Any) -> Any:
        """Share of the currents that amplifiers and coils can hold indefinitely, at most 1; shape (n,), a number for one row."""
        given = checked_rows("currents_a", currents_a, len(self), MAX_CURRENT_A)
        made = self._core.allowed_shares(given)
        return float(made[0]) if np.ndim(currents_a) == 1 else made

    def _each(self, work: Any, name: str, given: Any, columns: int, most: float, at_um: Any) -> np.ndarray:
        places = checked_rows("at_um", self.centre_um if at_um is None else at_um, 3, MAX_PLACE_UM)
        made = work(checked_rows(name, given, columns, most), places)
        return made[0] if np.ndim(given) == 1 else made

    def _place(self, at_um: Optional[Sequence[float]]) -> list[float]:
        place = self.centre_um if at_um is None else numbers("at_um", at_um, (3,), "(x_um, y_um, z_um)")
        return checked_rows("at_um", place, 3, MAX_PLACE_UM)[0].tolist()

    def __repr__(self) -> str:
        return f"<Coils: {self.name or 'no name'}, {', '.join(self.names)}>"


def checked_rows(name: str, values: Any, columns: Optional[int], most: float) -> np.ndarray:
    """Checks rows of finite numbers; a single row becomes an array of one row."""
    shape = f"(n, {columns or 'coils'})"
    array = rows(name, values, shape)
    array = array[np.newaxis] if array.ndim == 1 else array
    if array.ndim != 2 or (columns is not None and array.shape[1] != columns):
        raise InputError(f"{name} must have the shape {shape}, not {np.shape(values)}")
    array = array.astype(float, copy=False)
    bad = ~(np.abs(array) <= most)
    if bad.any():
        raise InputError(f"{name} has {array[bad][0]:g}, must be finite and at most {most:g}")
    return array


def centre(centre_um: Optional[Sequence[float]]) -> Optional[list[float]]:
    """Checks a position, or None."""
    if centre_um is None:
        return None
    return checked_rows("centre_um", numbers("centre_um", centre_um, (3,), "(x_um, y_um, z_um)"), 3, 1e8)[0].tolist()
