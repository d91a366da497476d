# SPDX-License-Identifier: Apache-2.0
"""The page on diagnostics: its commands and its code have the results that it tells."""

import re
import shlex
import subprocess

import pytest

from conftest import ROOT


@pytest.fixture
def names(monkeypatch, tmp_path):
    """What the page has before, in a folder that may be written to."""
    for name in ("tests", "scenarios"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    return {}


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
