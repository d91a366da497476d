# SPDX-License-Identifier: Apache-2.0
"""A metric has one name: in records, JSON, Python, sweeps and trials.csv."""

import json
import subprocess

import h5py
import numpy as np
import pytest

import microswarm as ms
from conftest import SCENARIOS

FILE = SCENARIOS / "first_flight.yaml"
FORMER = ["turning_deg", "walls", "obstacles", "avoidance"]


@pytest.fixture(scope="module")
def record():
    return ms.run(FILE, progress=False)


def test_a_metric_has_one_name_everywhere(record, program, tmp_path):
    names = list(record.metrics)
    assert {"length_um", "turning_rad", "walls_clearance_um", "avoidance_least_gap_um"} <= set(names)
    record.save(tmp_path / "run.h5")
    with h5py.File(tmp_path / "run.h5") as file:
        stored = {key: value for key, value in file["metrics"].attrs.items() if key in names}
    assert stored == record.metrics
    said = json.loads(subprocess.run([program, "run", FILE, "--json"], capture_output=True, check=True).stdout)["metrics"]
    assert list(said) == names + FORMER
    assert {name: np.inf if said[name] is None else said[name] for name in names} == record.metrics
    table = ms.sweep(FILE, progress=False)
    assert {name: table[name][0] for name in names} == record.metrics and not set(FORMER) & set(table)
    subprocess.run([program, "run", FILE, "--trials", "2", "--out", tmp_path / "out"], capture_output=True, check=True)
    head = (tmp_path / "out" / "trials.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
    assert head[2 : 2 + len(names)] == names


def test_former_names_are_read_with_a_note(record, program):
    said = json.loads(subprocess.run([program, "run", FILE, "--json"], capture_output=True, check=True).stdout)["metrics"]
    table = ms.sweep(FILE, progress=False)
    for metrics in (record.metrics, table):
        with pytest.warns(FutureWarning, match="'turning_deg' is now 'turning_rad'"):
            assert metrics["turning_deg"] == pytest.approx(said["turning_deg"])
        with pytest.raises(KeyError, match="turning"):
            record.frames["turning_deg"]
    with pytest.warns(FutureWarning, match="'walls' is now"):
        assert record.metrics["walls"]["clearance_um"] == record.metrics["walls_clearance_um"] == said["walls"]["clearance_um"]


def test_a_path_has_the_names_of_metrics(program, tmp_path):
    map = ms.Map.load(SCENARIOS / "maps" / "retina.geojson")
    path = ms.plan(map, (2323, 3816), (11103, 2397), clearance_um=15)
    command = [program, "plan", SCENARIOS / "maps" / "retina.geojson", "--start", "2323,3816", "--goal", "11103,2397", "--json"]
    said = json.loads(subprocess.run([*command, "--set", "planner.clearance_um=15"], capture_output=True, check=True).stdout)
    assert said["length_um"] == path.length_um and said["turning_rad"] == path.turning_rad and said["time_s"] > 0
