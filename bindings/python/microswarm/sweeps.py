# SPDX-License-Identifier: Apache-2.0
"""Many runs of a scenario."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from decimal import Decimal, InvalidOperation
from typing import Any, Iterable, Iterator, Mapping, Optional

from . import _core
from .record import Table
from .runs import Progress, Source, scenario_of, shown
from .values import InputError, key_of, mapping, seed_of, setting, text, text_of, told, whole


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
    """Runs all combinations of values, like `microswarm sweep`; returns a row with the metrics of each run.

    grid      values of each key: {"navigator.speed_um_per_s": [40, 60], "seed": range(100)}. The last one
              varies fastest
    methods   groups of settings that are compared in every combination: {"name": {key: value}}
    trials    number of trials of each combination, each with its own random streams
    seed      replaces the scenario's
    jobs      number of threads; default: one a core. Apart from times no value depends on it
    progress  called with the completed share; False: nothing is shown

    The columns are those of the database of a sweep: cell, trial, method, the grid's keys (with _ for .),
    status, arrived, metrics, wall-clock times, record_hash. Your own navigators need run().

    A warning says if all trials are the same run, since nothing in the scenario is random. Ctrl-C raises KeyboardInterrupt,
    whose `table` has the rows of the trials that are finished; at a prompt it is sys.last_value.table.
    """
    if navigator is not None:
        raise InputError("a sweep runs in threads of the library, without navigators of your own: call run() in a loop")
    grid = mapping("grid", grid)
    groups = {name: mapping(f"method {told(name)}", settings) for name, settings in mapping("methods", methods).items()}
    for where, keys in (("grid", grid), *(("methods", settings) for settings in groups.values())):
        if seed is not None and "seed" in keys:
            raise InputError(f"seed is {told(seed)}, and {where} sets the seed too: leave one of them out")
    with shown(progress) as report, _kept_rows():
        made, note = _core.sweep(
            scenario_of(scenario)._core,
            [(key_of(key), _values(key, values)) for key, values in grid.items()],
            [(text("the name of a method", str(name)), [setting(*one) for one in settings.items()]) for name, settings in groups.items()],
            whole("trials", trials, 1_000_000, least=1),
            seed_of(seed),
            whole("jobs", jobs, 1024),
            report,
        )
    if note:
        warnings.warn(note, stacklevel=2)
    return Table(*made)


@contextmanager
def _kept_rows() -> Iterator[None]:
    """Gives an interruption the table of the trials that are finished."""
    try:
        yield
    except KeyboardInterrupt as stop:
        made = stop.__dict__.pop("columns", None)
        if made:
            table = Table(*made)
            stop.table = table  # type: ignore[attr-defined]
            stop.args = (f"{table.rows} trials are finished: `table` of this exception has their rows",)
        raise


def _values(key: str, values: Any) -> list[str]:
    """The values of a key as texts; a single number or text is refused."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise InputError(f"values of {key} are {told(values)}, must be a list")
    made = [text_of(key, one) for one in values]
    if key == "seed":
        for one in made:
            _check_seed(one)
    return made


def _check_seed(value: str) -> None:
    """Refuses a seed that the table's column, which holds floats, cannot represent."""
    try:
        exact = Decimal(value) <= 2**53
    except InvalidOperation:  # no number, which the sweep itself reports
        return
    if not exact:
        raise InputError(f"seed in grid is {told(value)}, must be at most {2**53} (2^53) for the table")
