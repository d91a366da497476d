# SPDX-License-Identifier: Apache-2.0
"""Gymnasium's rules hold: with a stand-in of it, and with itself where it is installed."""

import importlib.util
import os
import pathlib
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).resolve().parent


@pytest.mark.parametrize("which", ["stand_in", "installed"])
def test_the_rules_of_gymnasium_hold(which):
    if which == "installed" and importlib.util.find_spec("gymnasium") is None:
        pytest.skip("Gymnasium is not installed; the stand-in applies its rules")
    folders = [str(HERE / "stand_in")] if which == "stand_in" else []
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([*folders, *filter(None, sys.path)])}
    made = subprocess.run([sys.executable, HERE / "gymnasium_rules.py"], env=environment, capture_output=True, text=True, timeout=300, check=False)
    assert made.returncode == 0, made.stdout + made.stderr
    assert len(made.stdout.splitlines()) == 6 and (which != "stand_in" or "stand-in" in made.stdout)
