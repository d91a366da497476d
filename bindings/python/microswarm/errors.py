# SPDX-License-Identifier: Apache-2.0
"""Mistakes in an input, as fields."""

from collections.abc import Sequence
from typing import NamedTuple


class Issue(NamedTuple):
    """One mistake. What is unknown is empty.

    key    of the value, from the top of the scenario: "obstacles.3.shape.radius_um"
    place  where it was given: "flight.yaml:12:3", "map.png", or the key of a value that was set
    text   what is wrong
    value  as written
    limit  what is allowed: "1..1e5 µm", or words
    """

    key: str
    place: str
    text: str
    value: str
    limit: str


class InputError(ValueError):
    """Bad input; nothing has changed. `issues` has each mistake, the text a line for each of the first 20."""

    issues: list[Issue]

    def __init__(self, text: str, issues: Sequence[Issue] = ()) -> None:
        super().__init__(text)
        self.issues = list(issues) or [Issue("", "", text, "", "")]
