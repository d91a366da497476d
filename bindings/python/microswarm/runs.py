# SPDX-License-Identifier: Apache-2.0
"""Experiments: run to their end, or step by step."""

from __future__ import annotations

import json
import os
from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

from . import _core
from .pictures import Drawable
from .progress import Bar
from .record import Record, finite
from .scenario import Scenario
from .values import InputError, key_of, path_text, seed_of, text_of, whole

Source = Union[Scenario, str, "os.PathLike[str]"]
Progress = Union[bool, Callable[[float], Any], None]


def scenario_of(source: Source) -> Scenario:
    """A scenario, given as such or as a file."""
    return source if isinstance(source, Scenario) else Scenario.load(path_text(source, "scenario", "a Scenario or the name of a file"))


@contextmanager
def shown(progress: Progress) -> Iterator[Optional[Callable[[float], Any]]]:
    """Receiver of the completed share: the caller's function, or a bar."""
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise InputError("progress must be a function, True, False or None")
    bar = Bar() if progress is None or progress is True else None
    try:
        yield bar or (progress if callable(progress) else None)
    finally:
        if bar:
            bar.end()


class Session(Drawable):
    """An open experiment, which advances when it is stepped and can be changed between steps.

    Use a session from one thread at a time; several sessions may run in separate threads. Only stop() may be called
    from any thread.
    """

    def __init__(self, scenario: Source, *, seed: Optional[int] = None, trial: int = 0, navigator: Any = None) -> None:
        """Opens a scenario, or a file. `navigator` is your own one, see run()."""
        core = scenario_of(scenario)._core
        self._core = _core.Session(core, seed_of(seed), whole("trial", trial, 2**32 - 1), navigator)

    @classmethod
    def _of(cls, core: _core.Session) -> "Session":
        """Wraps an open session."""
        session = cls.__new__(cls)
        session._core = core
        return session

    def step(self) -> bool:
        """Runs the next tick; False if the run had ended."""
        return self._core.step()

    def set(self, key: str, value: Any) -> None:
        """Sets a value from the next tick on, for example set("goal_um", [1500, 300])."""
        self._core.set(key_of(key), text_of(key, value))

    def view(self) -> dict[str, Any]:
        """The current state: the numbers of the frame, obstacles_um (x, y, radius), robots_um, path_um."""
        return self._core.view()

    @property
    def diagnostics(self) -> Optional[dict[str, Any]]:
        """Data behind the last command: `type` (radar, aggregation, predictive (of `safe_interval`), hierarchical_drrt_star), numbers, and a dictionary
        of columns for each list, such as `beams`. An index without a value is -1. None if the navigator has none."""
        return self._core.diagnostics()

    @property
    def status(self) -> str:
        """ "running", or the final status."""
        return self._core.summary()["status"]

    @property
    def metrics(self) -> dict[str, Any]:
        """The metrics so far."""
        return finite(json.loads(self._core.summary()["metrics"]))

    def finish(self, progress: Progress = None) -> Record:
        """Steps to the end. `progress` is called with the completed share; default: a line on stderr or in the notebook."""
        with shown(progress) as report:
            self._core.finish(report)
        return self.record()

    def record(self) -> Record:
        """The record so far."""
        return Record(self._core.record())

    def _picture(self, file: Optional[str]) -> Optional[bytes]:
        return self._core.draw(file)

    def __repr__(self) -> str:
        try:
            return f"<Session: {self.status} at {self.view()['t_s']:.4g} s>"
        except InputError:
            return "<Session: closed, or in use>"

    def stop(self) -> None:
        """Ends the run; callable from any thread. finish() or step() in another thread returns soon, the next tick is the last
        one, and the record holds all ticks, with the status "stopped", or "solved" if the swarm was held at the goal."""
        self._core.stop()

    def close(self) -> None:
        """Ends the session; what is called later raises InputError. Closing twice is no mistake."""
        self._core.close()

    def __reduce__(self) -> Any:
        raise TypeError("a Session is in the middle of a run, and cannot be copied or pickled: copy its scenario, or its record()")

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def run(
    scenario: Source,
    *,
    seed: Optional[int] = None,
    trial: int = 0,
    navigator: Any = None,
    progress: Progress = None,
) -> Record:
    """Runs a scenario, or a file, to its end; the record is bit-identical to that of `microswarm run`.

    seed          replaces the scenario's
    trial         selects the random streams: trial k is that of `microswarm run --trials`
    navigator     your own object with a method step(observation) that returns (heading_rad,
                  speed_um_per_s), or None to hold. The observation has now_s, seen_s, swarm = (x_um,
                  y_um, heading_rad, radius_um) or None, obstacles_um = rows of x, y, radius, and
                  robots_um. prepare() is called before the first step if there is one. Both are called in
                  the caller's thread; an exception ends the run and is raised.
    progress      called with the completed share; False: nothing is shown
    """
    with Session(scenario, seed=seed, trial=trial, navigator=navigator) as session:
        return session.finish(progress)
