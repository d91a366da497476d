# SPDX-License-Identifier: Apache-2.0
"""Checks of arguments, whose errors name the argument."""

from __future__ import annotations

import json
import math
import operator
import os
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

from .errors import InputError, Issue

GREY_THRESHOLD = 128  # of pictures in files


def told(value: Any) -> str:
    """A value in a message: one short line."""
    try:
        line = " ".join(repr(value).split())
    except (RecursionError, ValueError):  # nested deeply, or of thousands of digits
        line = f"{type(value).__name__} too large to show"
    return line if len(line) <= 80 else line[:79] + "…"


def refused(name: str, value: Any, limit: str) -> InputError:
    """The error of an argument that is not what it must be."""
    line = f"{name} is {told(value)}, must be {limit}"
    return InputError(line, [Issue(name, name, line, told(value), limit)])


def text(name: str, value: Any) -> str:
    """Checks a text that UTF-8 can encode."""
    if not isinstance(value, str):
        raise refused(name, value, "a text")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise refused(name, value, "a text of UTF-8") from None
    return value


def path_text(path: Any, name: str = "path", what: str = "the name of a file") -> str:
    """Checks a file's name; returns it as text."""
    try:
        made = os.fspath(path)
    except TypeError:
        made = None
    if not isinstance(made, str) or not made or "\0" in made:
        raise refused(name, path, what)
    return text(name, made)


def whole(name: str, value: Any, most: int, least: int = 0) -> int:
    """Checks an integer from `least` to `most`."""
    try:
        made = operator.index(value)
    except TypeError:
        raise refused(name, value, f"a whole number from {least} to {most}") from None
    if not least <= made <= most:
        raise refused(name, made, f"{least} to {most}")
    return made


def seed_of(value: Any) -> Optional[int]:
    """Checks a seed, or None."""
    return None if value is None else whole("seed", value, 2**64 - 1)


def flag(name: str, value: Any) -> bool:
    """Checks True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise refused(name, value, "True or False")
    return bool(value)


def mapping(name: str, value: Any) -> Mapping[str, Any]:
    """Checks a dictionary; None becomes an empty one."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise refused(name, value, "a dictionary")
    return value


def numbers(name: str, values: Any, counts: tuple[int, ...], what: str) -> list[float]:
    """Checks a list of finite numbers whose length is one of `counts`."""
    try:
        made = [float(one) for one in values]
    except (TypeError, ValueError, OverflowError):
        made = []
    if isinstance(values, str) or len(made) not in counts:
        raise refused(name, values, what)
    return made


def number(name: str, value: Any) -> float:
    """Checks a finite number."""
    try:
        made = float(value)
    except (TypeError, ValueError):
        raise refused(name, value, "a number") from None
    except OverflowError:
        made = math.inf
    if not math.isfinite(made):
        raise refused(name, value, "finite")
    return made


def array_of(name: str, values: Any, what: str, kinds: str = "buif", shape: Optional[tuple[int, ...]] = None) -> np.ndarray:
    """Checks an array of real numbers, or of the given NumPy `kinds`."""
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):  # rows of different lengths
        array = np.asarray("ragged")
    if array.dtype.kind not in kinds or shape not in (None, array.shape):
        raise refused(name, values, what)
    return array


def rows(name: str, values: Any, shape: str = "(n, 2)") -> np.ndarray:
    """Checks an array of real numbers of a shape."""
    return array_of(name, values, f"numbers of the shape {shape}")


def grid_of(name: str, values: Any, most: int) -> np.ndarray:
    """Checks a 2-D array of finite numbers; its sides are checked before it is read or copied."""
    array = array_of(name, values, "an array of numbers with 2 dimensions")
    if array.ndim != 2:
        raise InputError(f"{name} has the shape {array.shape}, must have 2 dimensions")
    if not all(1 <= side <= most for side in array.shape):
        raise InputError(f"{name} has the shape {array.shape}, a side must be 1 to {most}")
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise InputError(f"{name} has {array[~np.isfinite(array)][0]:g}, must be finite")
    return array


def free_pixels(name: str, array: np.ndarray, otherwise: str) -> np.ndarray:
    """Which pixels of a mask of booleans, of a mask of 0 and 1 or of a grey picture of uint8 are free; others are refused."""
    if array.dtype == bool:
        return array
    if ((array == 0) | (array == 1)).all():
        return array == 1
    if array.dtype != np.uint8:
        raise InputError(f"{name} is neither a mask of booleans or of 0 and 1, nor a picture of uint8 with grey values: {otherwise}")
    return array >= GREY_THRESHOLD


def key_of(key: Any) -> str:
    """Checks a key of a scenario."""
    if not isinstance(key, str) or not key or any(c in key for c in "=\n\r\0# "):
        raise InputError(f"{told(key)} is no key of a scenario")
    return text("a key of a scenario", key)


def setting(key: Any, value: Any) -> tuple[str, str]:
    """Key and value as in a scenario file."""
    return key_of(key), text_of(key, value)


def text_of(key: str, value: Any) -> str:
    """A value in a scenario file's form. Arrays become lists."""
    if isinstance(value, str):
        return text(key, value)
    try:
        return text(key, json.dumps(value, allow_nan=False, ensure_ascii=False, default=plain))
    except InputError:
        raise
    except RecursionError:
        why = "which is nested too deeply"
    except TypeError as error:
        why = str(error)
    except ValueError as error:
        why = "which contains itself" if "Circular" in str(error) else "must be finite"
    raise InputError(f"{key} is {told(value)}, {why}")


def plain(value: Any) -> Any:
    """Converts arrays and groups of a scenario for json."""
    for way in ("tolist", "to_dict"):
        if hasattr(value, way):
            return getattr(value, way)()
    raise TypeError(f"must not be of type {type(value).__name__}")
