# SPDX-License-Identifier: Apache-2.0
"""Records of runs as NumPy arrays."""

from __future__ import annotations

import difflib
import json
import os
import pathlib
import tempfile
import warnings
from typing import Any, Optional

import numpy as np

from . import _core
from .pictures import Drawable
from .values import path_text


class Named(dict):
    """A dictionary whose error names the near words of a key that is not there. Metrics have their former names for one release."""

    def __missing__(self, name: Any) -> Any:
        if isinstance(name, str):
            former = self._former(name)
            if former is not None:
                return former
            near = difflib.get_close_matches(name, list(self), n=1) or [key for key in self if key.startswith(f"{name}_")]
            if near:
                raise KeyError(f"{name!r} is not there, did you mean {near[0]!r}?")
        raise KeyError(f"{name!r} is not there, but {', '.join(map(str, self))}")

    def _former(self, name: str) -> Any:
        """A metric under its name in 0.2.0."""
        if name == "turning_deg" and "turning_rad" in self:
            new, made = "turning_rad", np.degrees(self["turning_rad"])
        elif name in ("walls", "obstacles", "avoidance") and "walls_clearance_um" in self:
            new = f"{name}_…"
            made = Named({key[len(name) + 1 :]: value for key, value in self.items() if key.startswith(f"{name}_")})
        else:
            return None
        warnings.warn(f"the metric {name!r} is now {new!r}", FutureWarning, stacklevel=3)
        return made


class Table(Named):
    """Columns of one table: read-only arrays of equal length, by names with their units.

    It is a dictionary: pandas.DataFrame(table), polars.DataFrame(table) and plt.plot("x_um", "y_um", data=table) take it as it
    is. numpy.asarray(table) is a structured array.
    """

    def __init__(self, columns: dict[str, np.ndarray], docs: dict[str, str] | None = None) -> None:
        for column in columns.values():
            column.flags.writeable = False  # they are those of the record
        super().__init__(columns)
        self.docs = docs or {}

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self.values()))) if self else 0

    def to_array(self) -> np.ndarray:
        """The table as a structured array, a row for each entry."""
        types = [(name, column.dtype) for name, column in self.items()]
        array = np.empty(self.rows, dtype=types)
        for name, column in self.items():
            array[name] = column
        return array

    def to_dict(self) -> dict[str, np.ndarray]:
        """The columns as a plain dictionary, to which others can be added."""
        return dict(self)

    def to_pandas(self) -> Any:
        """The table as a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(dict(self))

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        array = self.to_array()
        return array if dtype is None else array.astype(dtype)

    def __reduce__(self) -> Any:
        return Table, (dict(self), self.docs)

    def _read_only(self, *_: Any, **__: Any) -> Any:
        raise TypeError("a Table is read-only: to_dict() or to_pandas() gives one that can be changed")

    __setitem__ = __delitem__ = __ior__ = pop = popitem = clear = update = setdefault = _read_only  # type: ignore[assignment]

    def __repr__(self) -> str:
        lines = [f"{self.rows} rows"]
        lines += [f"  {name:28} {self.docs.get(name, '')}".rstrip() for name in self]
        return "\n".join(lines)


def finite(value: dict[str, Any]) -> Named:
    """Metrics with infinity for distances that were never measured."""
    return Named({key: float("inf") if one is None else one for key, one in value.items()})


class Record(Drawable):
    """Record of a run, sufficient to repeat, measure and draw it.

    status     "solved", "collided", "time_limit", …
    metrics    dictionary of the metrics, with their units in their names
    frames     Table with a row for each tick: t_s, x_um, y_um, heading_rad, command_speed_um_per_s, …
    events     Table of events
    plans      Table of planning events; plan_trees and plan_paths have a Table for each
    robots_t_s, robots_um   times, and positions of shape (times, robots, 2)
    step_time_s   computing time of each step of the navigator
    """

    def __init__(self, core: _core.Record) -> None:
        self._core = core
        self._tables: dict[str, Any] | None = None
        summary = core.summary()
        self.status: str = summary["status"]
        self.metrics: dict[str, Any] = finite(json.loads(summary["metrics"]))
        self.step_time_s: np.ndarray = summary["step_time_s"]

    @property
    def solved(self) -> bool:
        """Whether the goal was reached."""
        return self.status == "solved"

    @property
    def hash(self) -> str:
        """Hash of all physical quantities: equal for equal runs."""
        return self._core.hash()

    @property
    def version(self) -> str:
        """Version of the library that made the record."""
        return self._core.version

    @property
    def navigator(self) -> str:
        """ "external" if the navigator was not the scenario's, else empty."""
        return self._core.navigator

    def _all_tables(self) -> dict[str, Any]:
        if self._tables is None:
            self._tables = self._core.tables()
        return self._tables

    def _table(self, name: str) -> Any:
        return self._all_tables()[name]

    @property
    def frames(self) -> Table:
        return Table(self._table("frames"), self._core.documented())

    @property
    def events(self) -> Table:
        return Table(self._table("events"))

    @property
    def plans(self) -> Table:
        return Table(self._table("plans"))

    @property
    def plan_paths(self) -> list[Table]:
        return [Table(one) for one in self._table("plans/path")]

    @property
    def plan_trees(self) -> list[Table]:
        return [Table(one) for one in self._table("plans/tree")]

    @property
    def diagnostics(self) -> dict[str, Any]:
        """Data behind the commands, kept with `record.diagnostics: true`: a Table with a row for each decision, such as "radar", and
        for each of its lists, such as "radar/beams", a list with a Table for each decision. Empty if none are kept."""
        found: dict[str, Any] = Named()
        for name, table in self._all_tables().items():
            if name.startswith("diagnostics/"):
                parts = isinstance(table, list)
                found[name.removeprefix("diagnostics/")] = [Table(one) for one in table] if parts else Table(table)
        return found

    @property
    def robots_t_s(self) -> np.ndarray:
        return self._table("robots")["t_s"]

    @property
    def robots_um(self) -> np.ndarray:
        parts = self._table("robots/places")
        moments = [np.column_stack((one["x_um"], one["y_um"])) for one in parts]
        return np.array(moments) if moments else np.empty((0, 0, 2))

    def scenario_yaml(self) -> str:
        """The scenario of the run, with every key."""
        return self._core.scenario()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the record as HDF5. A file of that name is replaced as a whole; a symbolic link itself, not its target."""
        self._core.write(path_text(path))

    def replay(self) -> tuple[bool, str]:
        """Runs it again: whether all bits are equal, otherwise the first difference."""
        return self._core.replay()

    def _picture(self, file: Optional[str]) -> Optional[bytes]:
        return self._core.draw(file)

    def __reduce__(self) -> Any:
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "record.h5")
            self.save(file)
            return _restored, (file.read_bytes(),)

    def __repr__(self) -> str:
        return f"<Record: {self.status} after {self.metrics['time_s']:.4g} s, hash {self.hash}>"


def _restored(content: bytes) -> Record:
    """A record from the content of its file."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "record.h5")
        file.write_bytes(content)
        return read_record(file)


def read_record(path: str | os.PathLike[str]) -> Record:
    """Reads a record of `microswarm run`, `gather`, `rig run` or of this package."""
    return Record(_core.Record.read(path_text(path)))
