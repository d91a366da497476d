# SPDX-License-Identifier: Apache-2.0
"""Many runs, beside those of the command line."""

import csv
import json
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT, SCENARIOS

GRID = {"navigator.clearance_um": [45, 60], "navigator.speed_um_per_s": np.array([40.0, 60.0])}
METHODS = {"straight": {"navigator.guide": "straight"}, "no look-ahead": {"navigator.horizon_s": 0}}


def wall_clock(name):
    return name in ("compute_s", "step_mean_s", "step_max_s", "planning_mean_s", "planning_max_s")


def test_the_table_is_that_of_the_command_line(program, flight, tmp_path):
    table = ms.sweep(flight, GRID, methods=METHODS, trials=2, seed=5, jobs=2, progress=False)
    methods = [{"name": name, "set": [f"{key}={value}" for key, value in settings.items()]} for name, settings in METHODS.items()]
    sweep = {
        "scenario": str(SCENARIOS / "first_flight.yaml"),
        "set": ["time_limit_s=5"],
        "grid": [{"key": key, "values": [str(one) for one in values]} for key, values in GRID.items()],
        "methods": methods,
        "trials": 2,
        "seed": 5,
    }
    (tmp_path / "s.yaml").write_text(json.dumps(sweep))
    command = [program, "sweep", tmp_path / "s.yaml", "--out", tmp_path / "s.db", "--csv", tmp_path / "s.csv", "--jobs", "2"]
    subprocess.run(command, check=True, capture_output=True)
    with open(tmp_path / "s.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert table.rows == len(rows) == 16 and list(table) == list(rows[0])
    for name, column in table.items():
        if wall_clock(name):
            continue
        for ours, theirs in zip(column, rows):
            if column.dtype.kind == "U":
                assert ours == theirs[name]
            elif theirs[name] == "":
                assert np.isnan(ours)
            else:
                assert ours == float(theirs[name]), name
    assert table.docs["length_um"] and table.to_array().shape == (16,)


def test_rows_are_runs_and_do_not_depend_on_the_number_of_threads(flight):
    flight.navigator.speed_um_per_s = 30  # is varied below
    grid = {"navigator.speed_um_per_s": [40, 60], "seed": range(3)}
    table = ms.sweep(flight, grid, jobs=2, progress=False)
    again = ms.sweep(flight, grid, jobs=1, progress=False)
    for name in table:
        if not wall_clock(name):
            np.testing.assert_array_equal(table[name], again[name])
    for row in table.to_array():
        single = flight.copy().set("navigator.speed_um_per_s", row["navigator_speed_um_per_s"])
        assert ms.run(single, seed=int(row["seed"]), progress=False).hash == row["record_hash"]


def test_without_a_grid_the_trials_differ(flight):
    flight.set("sensing.position_noise_um", 4)
    heard = []
    table = ms.sweep(flight, trials=3, progress=heard.append)
    assert table.rows == 3 and len(set(table["record_hash"])) == 3
    assert all(0 <= share <= 1 for share in heard)
    hashes = [ms.run(flight, trial=k, progress=False).hash for k in range(3)]
    assert list(table["record_hash"]) == hashes


def test_trials_that_are_one_run_are_noted(recwarn):
    for file in ("papers/radar/twelve.yaml", "papers/radar/single.yaml", "first_rig.yaml"):
        scenario = ms.Scenario.load(SCENARIOS / file).set("time_limit_s", 5)
        for values in ({"trials": 3}, {"grid": {"seed": range(3)}}):
            with pytest.warns(UserWarning, match="all 3 trials are the same run"):
                table = ms.sweep(scenario, progress=False, **values)
            assert len(set(table["record_hash"])) == 1
    recwarn.clear()
    table = ms.sweep(ms.Scenario.load(SCENARIOS / "first_flight.yaml"), trials=3, progress=False)
    assert len(set(table["record_hash"])) == 3 and not recwarn.list


@pytest.mark.parametrize(
    "values, words",
    [
        ({"grid": [1, 2]}, "grid is"),
        ({"grid": {"x": [1]}}, "unknown key 'x'"),
        ({"grid": {3: [1]}}, "3 is no key"),
        ({"grid": {"seed": 3}}, "must be a list"),
        ({"grid": {"seed": "12"}}, "must be a list"),
        ({"grid": {"seed": []}}, "is empty"),
        ({"grid": {"seed": [1, 1]}}, "twice"),
        ({"grid": {"seed": [-1]}}, "seed"),
        ({"grid": {"navigator.speed_um_per_s": [float("nan")]}}, "finite"),
        ({"grid": {"navigator.speed_um_per_s": ["fast"]}}, "must be a number"),
        ({"grid": {"goal_um": [[5000, 5000]]}}, "goal is outside the map"),
        ({"grid": {"seed": range(1000), "navigator.speed_um_per_s": np.arange(20, 2000)}}, "more than 100000 cells"),
        ({"methods": {"a": {"y": 2}}}, "unknown key 'y'"),
        ({"methods": {"a\nb": {}}}, "one line"),
        ({"methods": 3}, "methods is 3"),
        ({"trials": 0}, "trials is 0"),
        ({"trials": 10**7}, "trials is 10000000"),
        ({"trials": 1.5}, "must be a whole number"),
        ({"jobs": -1}, "jobs is -1"),
        ({"seed": -1}, "seed is -1"),
        ({"seed": 5, "grid": {"seed": [1, 2]}}, "seed is 5, and grid sets the seed too"),
        ({"seed": 5, "methods": {"a": {"seed": 1}}}, "seed is 5, and methods sets the seed too"),
        ({"grid": {"seed": [1, 2**53 + 1]}}, "seed in grid is '9007199254740993', must be at most 9007199254740992"),
        ({"grid": {"seed": ["1e17"]}}, "seed in grid is '1e17'"),
        ({"methods": {"\udcff": {}}}, "must be a text of UTF-8"),
        ({"progress": 7}, "progress must be"),
        ({"navigator": object()}, "navigators of your own"),
    ],
)
def test_bad_sweeps_are_refused(flight, values, words):
    with pytest.raises(ms.InputError, match=words):
        ms.sweep(flight, **{"progress": False, **values})


@pytest.mark.parametrize("grid", ['{"seed": range(100000)}', "{}"])
def test_ctrl_c_ends_a_sweep(grid):
    code = f"""
import microswarm as ms
print("runs", flush=True)
try:
    ms.sweep({str(SCENARIOS / "first_flight.yaml")!r}, {grid}, trials={1 if "range" in grid else 100000}, progress=False)
except KeyboardInterrupt:
    print("interrupted")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert process.stdout.readline() == "runs\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=30)[0] == "interrupted\n"


@pytest.mark.parametrize("by_seed", [False, True])
def test_ctrl_c_keeps_the_rows_of_finished_trials(flight, by_seed):
    def press(share):
        if share > 0:
            signal.raise_signal(signal.SIGINT)

    many = {"grid": {"seed": range(1000)}} if by_seed else {"trials": 1000}
    with pytest.raises(KeyboardInterrupt) as stop:
        ms.sweep(flight, **many, jobs=1, progress=press)
    table = stop.value.table
    assert isinstance(table, ms.Table) and 0 < table.rows < 1000 and str(table.rows) in str(stop.value)
    assert table["cell" if by_seed else "trial"].tolist() == list(range(table.rows))
    last = table.rows - 1
    single = ms.run(flight, progress=False, **({"seed": last} if by_seed else {"trial": last}))
    assert table["record_hash"][last] == single.hash


def test_ctrl_c_before_the_first_row_is_an_interruption(flight):
    with pytest.raises(KeyboardInterrupt) as stop:
        ms.sweep(flight, {"seed": range(20000)}, progress=lambda share: signal.raise_signal(signal.SIGINT))
    assert not hasattr(stop.value, "table") or stop.value.table.rows == 0
