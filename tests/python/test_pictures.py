# SPDX-License-Identifier: Apache-2.0
"""Pictures of what can be drawn, in files and for notebooks."""

import pickle
import subprocess

import numpy as np
import pytest

import microswarm as ms
from conftest import SCENARIOS

WALL = [(900, 0), (1000, 0), (1000, 600), (900, 600)]


def size(png):
    """Width and height of a PNG."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


@pytest.fixture
def chip():
    return ms.Map.from_walls((0, 0, 2000, 1000), [WALL])


def test_a_record_is_drawn_as_the_report_does(program, tmp_path):
    name = SCENARIOS / "first_flight.yaml"
    record = ms.run(name, progress=False)
    record.save(tmp_path / "run.h5")
    told = subprocess.run([program, "report", tmp_path / "run.h5", "--out", tmp_path / "report"], capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stderr
    assert size(record._repr_png_()) == size((tmp_path / "report/overview.png").read_bytes())


def test_robots_are_drawn_where_they_are_at_the_end(program, tmp_path):
    scenario = ms.Scenario.load(SCENARIOS / "papers/gather/t_junction.yaml").set("time_limit_s", 3)
    record = ms.run(scenario, progress=False)
    record.save(tmp_path / "run.h5")
    told = subprocess.run([program, "report", tmp_path / "run.h5", "--out", tmp_path], capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stderr
    assert record._repr_png_() == (tmp_path / "after.png").read_bytes()


def test_a_path_is_drawn_as_plan_does(program, chip, tmp_path):
    path = ms.plan(chip, (200, 300), (1800, 300), "drrt_star", clearance_um=60, seed=42)
    assert path.solved and len(path.tree_um) > 1
    for kind, head in ((".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")):
        path.draw(tmp_path / f"path{kind}")
        assert (tmp_path / f"path{kind}").read_bytes().startswith(head)
    assert (tmp_path / "path.png").read_bytes() == path._repr_png_()
    back = pickle.loads(pickle.dumps(path))
    assert np.array_equal(back.points_um, path.points_um) and back._repr_png_() is None
    with pytest.raises(ms.InputError, match="its map is not with it"):
        back.draw(tmp_path / "back.png")


def test_maps_and_sessions_are_drawn(chip, flight):
    assert size(chip._repr_png_())[0] == 1248
    with ms.Session(flight) as session:
        before = session._repr_png_()
        for _ in range(20):
            session.step()
        assert session._repr_png_() != before and size(before)[0] == 1248
        assert repr(session) == "<Session: running at 1.9 s>"
    assert session._repr_png_() is None and repr(session) == "<Session: closed, or in use>"


def test_a_picture_that_cannot_be_written_is_an_input_error(chip, tmp_path):
    for name in ("picture.gif", "picture", "no/folder.png", "a\0b.png", None):
        with pytest.raises(ms.InputError):
            chip.draw(tmp_path / name if name and "\0" not in name else name)
    assert not list(tmp_path.iterdir())
