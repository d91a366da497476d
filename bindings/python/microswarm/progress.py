# SPDX-License-Identifier: Apache-2.0
"""Progress of long calls."""

from __future__ import annotations

import sys
import time
from typing import Any


class Bar:
    """Shows the progress of calls longer than a second, 10 times a second: on stderr if it is a terminal, or in a notebook."""

    def __init__(self) -> None:
        self._began = time.monotonic()
        self._next = 1.0
        self._shown = False
        self._cell: Any = notebook_line()

    def __call__(self, done: float) -> None:
        passed = time.monotonic() - self._began
        if passed < self._next:
            return
        self._next = passed + 0.1
        left = f", {passed * (1 - done) / done:.0f} s left" if done > 0.01 else ""
        self._show(f"{100 * done:3.0f} %{left}")

    def end(self) -> None:
        """Removes the line; in a notebook it shows the duration instead."""
        if not self._shown:
            return
        if self._cell:
            self._show(f"{time.monotonic() - self._began:.1f} s")
        else:
            print("\r" + " " * 30 + "\r", end="", file=sys.stderr, flush=True)

    def _show(self, line: str) -> None:
        if self._cell:
            show = self._cell.update if self._shown else self._cell.display
            show({"text/plain": line}, raw=True)
        elif sys.stderr and sys.stderr.isatty():
            print(f"\r{line}    ", end="", file=sys.stderr, flush=True)
        else:
            return
        self._shown = True


def notebook_line() -> Any:
    """A line of a notebook that can be updated; None elsewhere."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return sys.modules["IPython"].display.DisplayHandle() if hasattr(shell, "kernel") else None
