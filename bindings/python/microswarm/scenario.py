# SPDX-License-Identifier: Apache-2.0
"""Scenarios: complete descriptions of experiments."""

from __future__ import annotations

import copy
import difflib
import json
import os
from typing import Any, Iterator, Optional

from . import _core
from ._core import Scenario as CoreScenario
from .values import path_text, setting, text as checked_text


class Group:
    """A part of a scenario: its keys are attributes, with their units in their names."""

    _scenario: "Scenario"
    _path: tuple[str, ...]

    def __init__(self, scenario: "Scenario", path: tuple[str, ...]) -> None:
        object.__setattr__(self, "_scenario", scenario)
        object.__setattr__(self, "_path", path)

    def _value(self) -> Any:
        value: Any = self._scenario._values()
        for key in self._path:
            value = value[int(key)] if isinstance(value, list) else value[key]
        return value

    def _unknown(self, name: str) -> AttributeError:
        near = difflib.get_close_matches(name, list(self._value()), 1)
        where = ".".join(self._path) or "a scenario"
        return AttributeError(f"{where} has no key {name!r}" + (f", did you mean {near[0]!r}?" if near else ""))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        values = self._value()
        if not isinstance(values, dict):
            raise AttributeError(f"{'.'.join(self._path)} is a list, which is replaced as a whole")
        if name not in values:
            raise self._unknown(name)
        return self._scenario._part((*self._path, name), values[name])

    def __setattr__(self, name: str, value: Any) -> None:
        values = self._value()
        if name not in values:
            raise self._unknown(name)
        self._scenario.set(".".join((*self._path, name)), value)

    def to_dict(self) -> Any:
        """A copy as dictionary or list."""
        return copy.deepcopy(self._value())

    def __getitem__(self, index: int | slice) -> Any:
        values = self._value()
        if not isinstance(values, list):
            raise TypeError(f"{'.'.join(self._path) or 'a scenario'} is no list")
        if isinstance(index, slice):
            return [self[i] for i in range(len(values))[index]]
        position = range(len(values))[index]
        return self._scenario._part((*self._path, str(position)), values[position])

    def __len__(self) -> int:
        return len(self._value())

    def __iter__(self) -> Iterator[Any]:
        values = self._value()
        return iter([self[i] for i in range(len(values))]) if isinstance(values, list) else iter(values)

    def __eq__(self, other: object) -> bool:
        return bool(self._value() == (other._value() if isinstance(other, Group) else other))

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        values = self._value()
        return [*super().__dir__(), *(values if isinstance(values, dict) else ())]

    def __repr__(self) -> str:
        return json.dumps(self._value(), indent=2, ensure_ascii=False)


class Scenario(Group):
    """An experiment as data: map, obstacles, swarm or robots, start, goal, navigator, limits.

    Every key of a scenario file is an attribute, with its unit in its name; groups of keys have
    attributes themselves, and lists are indexed: `scenario.obstacles[0].shape.radius_um = 30`. Positions are tuples,
    and lists are replaced as a whole: `scenario.obstacles = scenario.obstacles[:2]`.
    A bad value raises InputError and changes nothing.
    """

    _core: CoreScenario
    _cache: Optional[dict[str, Any]]

    def __init__(self, core: CoreScenario) -> None:
        super().__init__(self, ())
        object.__setattr__(self, "_core", core)
        object.__setattr__(self, "_cache", None)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "Scenario":
        """Reads a scenario file."""
        return cls(_core.Scenario.load(path_text(path)))

    @classmethod
    def from_text(cls, text: str, folder: str | os.PathLike[str] = "", name: str = "scenario") -> "Scenario":
        """A scenario from YAML text. Files that it names are relative to `folder`."""
        base = "" if folder == "" else path_text(folder, "folder", "the name of a folder")
        return cls(_core.Scenario.of(checked_text("text", text), checked_text("name", name), base))

    def set(self, key: str, value: Any) -> "Scenario":
        """Sets the value of a key, for example set("navigator.speed_um_per_s", 60). A text is read as in a file."""
        self._core.set(setting(key, value))
        object.__setattr__(self, "_cache", None)
        return self

    def get(self, key: str) -> Any:
        """Value of a key; a group as dictionary, a list as list."""
        value: Any = self._values()
        for part in key.split("."):
            try:
                value = value[int(part)] if isinstance(value, list) else value[part]
            except (KeyError, IndexError, ValueError, TypeError):
                raise KeyError(key) from None
        return copy.deepcopy(value)

    def copy(self) -> "Scenario":
        """A scenario with the same values."""
        return Scenario(self._core.copy())

    def __copy__(self) -> "Scenario":
        return self.copy()

    def __deepcopy__(self, _: Any) -> "Scenario":
        return self.copy()

    def __reduce__(self) -> Any:
        return _restored, self._core.parts()

    def to_yaml(self) -> str:
        """The scenario as YAML with every key."""
        return self._core.yaml()

    def _values(self) -> dict[str, Any]:
        values = self._cache
        if values is None:
            values = json.loads(self._core.json())
            object.__setattr__(self, "_cache", values)
        return values

    def _part(self, path: tuple[str, ...], value: Any) -> Any:
        if is_numbers(value):
            return tuple(value)
        return Group(self, path) if isinstance(value, (dict, list)) else value

    def __repr__(self) -> str:
        return f"Scenario({self._core.name!r})\n" + super().__repr__()


def _restored(text: str, name: str, base: str, settings: list[tuple[str, str]]) -> Scenario:
    """A scenario from its parts."""
    core = _core.Scenario.of(text, name, base)
    for one in settings:
        core.set(one)
    return Scenario(core)


def is_numbers(value: Any) -> bool:
    """Whether a value is a list of numbers, such as a position."""
    return isinstance(value, list) and all(isinstance(one, (int, float)) for one in value) and len(value) > 0
