# SPDX-License-Identifier: Apache-2.0
"""The page on learning runs as it stands there, and its example learns."""

import os
import re
import subprocess
import sys

import numpy as np

from conftest import ROOT, SCENARIOS

PAGE = (ROOT / "docs/how-to/learn-in-an-environment.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, flags=re.S)


def ran(command, folder, path=()):
    """Output of a program that must succeed."""
    environment = {**os.environ, "MICROSWARM_SCENARIOS": str(SCENARIOS), "PYTHONPATH": os.pathsep.join([*path, *filter(None, sys.path)])}
    made = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=600, check=False)
    assert made.returncode == 0, made.stderr
    return made.stdout


def test_the_page_runs_as_it_stands_there(monkeypatch, tmp_path, capsys):
    (tmp_path / "scenarios").symlink_to(SCENARIOS)
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in BLOCKS:
        if "import gymnasium" not in block:
            exec(block, names)  # noqa: S102
    assert names["picture"].shape == (240, 480, 3) and names["observations"].shape == (64, 34)
    printed = capsys.readouterr().out
    assert printed.splitlines()[0] == "{'success': False, 'is_success': False, 'reason': 'collided'}"
    assert 0.2 < np.mean(names["successes"]) < 0.8 and max(names["rewards"]) > min(names["rewards"])


def test_the_part_with_gymnasium_runs_with_the_stand_in(tmp_path):
    (tmp_path / "scenarios").symlink_to(SCENARIOS)
    (block,) = (one for one in BLOCKS if "import gymnasium" in one)
    printed = ran([sys.executable, "-c", block + "print(type(envs).__name__, envs.num_envs)"], tmp_path, [str(ROOT / "tests/python/stand_in")])
    assert printed == "NavigationVectorEnv 1024\n"


def test_the_example_learns(tmp_path):
    """After a short training more episodes reach the goal than at random, and the curve is drawn."""
    printed = ran([sys.executable, ROOT / "examples/learn_to_navigate.py", "--steps", "400000", "--quick", "--svg", "learn.svg"], tmp_path)
    rates = {name.strip(): int(rate) for name, rate in re.findall(r"^(.*?) reaches the goal in +(\d+)%", printed, flags=re.M)}
    assert set(rates) == {"at random", "straight", "PPO", "policy gradient"}
    assert rates["PPO"] > rates["at random"] + 20  # the plain gradient needs more steps
    drawn = (tmp_path / "learn.svg").read_text(encoding="utf-8")
    assert drawn.count("<polyline") == 2 and all(f">{name}</text>" in drawn for name in rates)
