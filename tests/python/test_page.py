# SPDX-License-Identifier: Apache-2.0
"""The code of the pages on Python and on diagnostics runs as it stands there."""

import re
import shlex
import subprocess

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT

PAGE = (ROOT / "docs/how-to/use-from-python.md").read_text(encoding="utf-8")


def code_of(title):
    """The blocks of a section."""
    (section,) = (part for part in re.split(r"^## ", PAGE, flags=re.M) if part.startswith(title + "\n"))
    return re.findall(r"```python\n(.*?)```", section, flags=re.S)


@pytest.fixture
def names(monkeypatch, tmp_path):
    """What the page has before, in a folder that may be written to."""
    for name in ("tests", "scenarios"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    return {"ms": ms, "np": np}


def run(title, names):
    for block in code_of(title):
        exec(block, names)  # noqa: S102
    return names


def test_why_did_it_turn(names, program, tmp_path, capsys):
    page = (ROOT / "docs/how-to/why-did-it-turn.md").read_text(encoding="utf-8")
    commands = [shlex.split(line)[1:] for line in re.findall(r"^    (microswarm .*)$", page, flags=re.M)]
    assert [one[0] for one in commands] == ["run", "lab", "report", "export", "export"]
    for command in commands:
        if command[0] != "lab":
            subprocess.run([program, *command], check=True, capture_output=True)
    (code,) = re.findall(r"```python\n(.*?)```", page, flags=re.S)
    exec(code, names)  # noqa: S102
    assert "kept" in capsys.readouterr().out
    decisions = (tmp_path / "radar.csv").read_text(encoding="utf-8").splitlines()
    assert len(decisions) == names["radar"].rows + 1
    rows = {int(line.split(",")[0]) for line in (tmp_path / "beams.csv").read_text(encoding="utf-8").splitlines()[1:]}
    assert rows == set(range(names["radar"].rows))


def test_vessels(names):
    made = run("Vessels in a photograph", names)
    assert made["found"].mask.any()


def test_tracks(names):
    made = run("Track robots in a video", names)
    assert len(made["one"]) == 8 and len(made["tracks"]) == 48


def test_gathering(names, monkeypatch, tmp_path):
    slow = ms.gather
    monkeypatch.setattr(ms, "gather", lambda chip, goal, n, method: slow(chip, goal, n=8, method=method, max_steps=3, progress=False))
    made = run("Gather robots", names)
    assert made["made"].steps == 3 and (tmp_path / "gather.h5").exists()


def test_plans(names):
    made = run("One input, a goal for each robot", names)
    assert made["plan"].paths_um.shape[1:] == (2, 2)


def test_currents(names, tmp_path):
    made = run("Currents for a field", names)
    assert made["currents_a"].shape == (100, 6) and (tmp_path / "coils.yaml").exists()
    assert np.allclose(made["mine"].matrix(), made["coils"].matrix((1000, 0, 0)))
