# SPDX-License-Identifier: Apache-2.0
"""Where the package, the program and the scenarios are."""

import os
import pathlib

import pytest

import microswarm as ms

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "scenarios"


@pytest.fixture
def program():
    """The command-line program."""
    return os.environ["MICROSWARM"]


@pytest.fixture
def flight():
    """A scenario of a few seconds."""
    return ms.Scenario.load(SCENARIOS / "first_flight.yaml").set("time_limit_s", 5)
