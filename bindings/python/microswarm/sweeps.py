# SPDX-License-Identifier: Apache-2.0
"""Many runs of a scenario."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Iterable, Optional

from . import _core
from .record import Table
from .runs import Progress, Source, scenario_of, shown
from .values import InputError, seed_of, setting, text_of, whole


def sweep(
    scenario: Source,
    grid: Optional[Mapping[str, Iterable[Any]]] = None,
    *,
    methods: Optional[Mapping[str, Mapping[str, Any]]] = None,
    trials: int = 1,
    seed: Optional[int] = None,
    jobs: int = 0,
    navigator: Any = None,
    progress: Progress = None,
) -> Table:
    """Runs all combinations of values; a row each with the metrics, as of `microswarm sweep`.

    grid      values of each key: {"navigator.speed_um_per_s": [40, 60], "seed": range(100)}. The last one
              varies fastest
    methods   groups of settings that are compared in every combination: {"name": {key: value}}
    trials    of each combination, with random streams of their own
    seed      replaces the scenario's
    jobs      number of threads, one a core without. Apart from times no value depends on it
    progress  called with the share that is done; False: nothing is shown

    The columns are those of the database of a sweep: cell, trial, method, what the grid varies (with _
    for .), status, arrived, metrics, wall-clock times, record_hash. A run with a navigator of your own
    is one of run().
    """
    if navigator is not None:
        raise InputError("a sweep runs in threads of the library, without navigators of your own: call run() in a loop")
    grid = _mapping("grid", grid)
    methods = _mapping("methods", methods)
    with shown(progress) as report:
        made = _core.sweep(
            scenario_of(scenario)._core,
            [(_key(key), [text_of(one) for one in _values(key, values)]) for key, values in grid.items()],
            [(str(name), [setting(*one) for one in _mapping(name, settings).items()]) for name, settings in methods.items()],
            whole("trials", trials, 1_000_000, least=1),
            seed_of(seed),
            whole("jobs", jobs, 1024),
            report,
        )
    return Table(*made)


def _mapping(name: str, value: Any) -> Mapping[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise InputError(f"{name} is {value!r}, must be a dictionary")
    return value


def _key(key: Any) -> str:
    return setting(key, "")[:-1]


def _values(key: str, values: Any) -> list[Any]:
    """The values of a key; a number or a text is none."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise InputError(f"values of {key} are {values!r}, must be a list")
    return list(values)
