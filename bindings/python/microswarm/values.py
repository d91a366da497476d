# SPDX-License-Identifier: Apache-2.0
"""Arguments of callers, told by their names where they are wrong."""

from __future__ import annotations

import json
import math
import operator
import os
from typing import Any, Optional

import numpy as np

from ._core import InputError


def path_text(path: str | os.PathLike[str]) -> str:
    """A file's name as text."""
    text = os.fspath(path)
    if not isinstance(text, str) or "\0" in text:
        raise InputError(f"{text!r} is no name of a file")
    return text


def whole(name: str, value: Any, most: int, least: int = 0) -> int:
    """A whole number from `least` to `most`."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{name} is {value!r}, must be a whole number") from None
    if not least <= number <= most:
        raise InputError(f"{name} is {number}, must be {least} to {most}")
    return number


def seed_of(value: Any) -> Optional[int]:
    """A seed, or none."""
    return None if value is None else whole("seed", value, 2**64 - 1)


def numbers(name: str, values: Any, counts: tuple[int, ...], what: str) -> list[float]:
    """As many numbers as one of `counts`."""
    try:
        made = [float(one) for one in values]
    except (TypeError, ValueError):
        made = []
    if isinstance(values, str) or len(made) not in counts:
        raise InputError(f"{name} must be {what}")
    return made


def number(name: str, value: Any) -> float:
    """A finite number."""
    try:
        made = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} is {value!r}, must be a number") from None
    if not math.isfinite(made):
        raise InputError(f"{name} is {value!r}, must be finite")
    return made


def rows(name: str, values: Any, shape: str = "(n, 2)") -> np.ndarray:
    """An array of real numbers."""
    try:
        array = np.asarray(values)
    except ValueError:
        array = np.asarray("ragged")
    if array.dtype.kind not in "buif":
        raise InputError(f"{name} must be numbers of the shape {shape}")
    return array


def setting(key: Any, value: Any) -> str:
    """KEY=VALUE as in --set."""
    if not isinstance(key, str) or not key or any(c in key for c in "=\n\r\0# "):
        raise InputError(f"{key!r} is no key of a scenario")
    return f"{key}={text_of(value)}"


def text_of(value: Any) -> str:
    """A value as in a scenario file. Arrays become lists."""
    if isinstance(value, str):
        return value
    try:
        return json.dumps(value, allow_nan=False, default=plain)
    except InputError:
        raise
    except ValueError:
        raise InputError(f"{value!r}: a value of a scenario must be finite") from None


def plain(value: Any) -> Any:
    """What json does not know: arrays and groups of a scenario."""
    for way in ("tolist", "to_dict"):
        if hasattr(value, way):
            return getattr(value, way)()
    raise InputError(f"a value of a scenario cannot be of type {type(value).__name__}")
