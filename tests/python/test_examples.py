# SPDX-License-Identifier: Apache-2.0
"""The examples: each prints what its twin in C++ prints."""

import os
import pathlib
import subprocess
import sys

import pytest

from conftest import ROOT, SCENARIOS

EXAMPLES = sorted(ROOT.glob("examples/[0-9]*.py"))
PROGRAMS = pathlib.Path(os.environ["MICROSWARM"]).parents[1] / "examples"


def told(command, folder):
    """What an example prints, if it succeeds."""
    environment = {**os.environ, "MICROSWARM_SCENARIOS": str(SCENARIOS)}
    made = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert made.returncode == 0, made.stderr
    assert "Warning" not in made.stderr, made.stderr
    return made.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda one: one.stem)
def test_an_example_prints_what_its_twin_prints(example, tmp_path):
    printed = told([sys.executable, example], tmp_path)
    assert printed
    twin = PROGRAMS / example.stem
    if not twin.exists():
        pytest.skip(f"{twin} is not built")
    assert printed == told([twin], tmp_path)


def test_every_example_has_a_twin():
    assert [one.stem for one in EXAMPLES] == sorted(one.stem for one in ROOT.glob("examples/[0-9]*.cpp"))
