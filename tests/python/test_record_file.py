# SPDX-License-Identifier: Apache-2.0
"""A record in the hands of other programs: HDF5's own tools, and Octave."""

import copy
import pickle
import re
import shutil
import subprocess

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT, SCENARIOS


@pytest.fixture
def run_h5(flight, tmp_path):
    record = ms.run(flight, progress=False)
    record.save(tmp_path / "run.h5")
    return record, tmp_path


def octave(code, folder):
    """What Octave prints."""
    program = shutil.which("octave-cli")
    if not program:
        pytest.skip("Octave is not installed")
    made = subprocess.run([program, "--no-gui", "--norc", "--no-history", "--eval", code], cwd=folder, capture_output=True, text=True, check=False)
    assert "error" not in made.stderr and "HDF5-DIAG" not in made.stderr, made.stderr
    return made.stdout


def headers(file):
    """What h5dump says of types and shapes: of each dataset and of each attribute."""
    program = shutil.which("h5dump")
    if not program:
        pytest.skip("hdf5-tools is not installed")
    return subprocess.run([program, "-H", file], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("name", ["first_flight.yaml", "papers/gather/t_junction.yaml"])
def test_matlab_knows_every_type_of_a_record(tmp_path, name):
    scenario = ms.Scenario.load(SCENARIOS / name).set("time_limit_s", 2)
    scenario.description = "Grüße"  # a text that needs UTF-8
    ms.run(scenario, progress=False).save(tmp_path / "run.h5")
    text = headers(tmp_path / "run.h5")
    kinds = re.findall(r"DATATYPE\s+(\S+)", text)
    assert set(kinds) == {"H5T_IEEE_F64LE", "H5T_STD_I64LE", "H5T_STD_U64LE", "H5T_STRING"}
    sizes = re.findall(r"STRSIZE (\S+);", text)
    assert len(sizes) == kinds.count("H5T_STRING") and all(one.isdigit() for one in sizes)  # no H5T_VARIABLE
    shapes = re.findall(r"DATASPACE\s+(SCALAR|SIMPLE \{ \( \d+ \) / \( \d+ \) \})", text)
    assert len(shapes) == text.count("DATASPACE ") == len(kinds)
    assert not re.search(r"SOFTLINK|EXTERNAL_LINK|H5T_(VLEN|COMPOUND|ENUM|REFERENCE|OPAQUE|ARRAY)", text)


def test_octave_reads_what_the_page_says(run_h5):
    record, folder = run_h5
    page = (ROOT / "docs/reference/record.md").read_text(encoding="utf-8")
    lines = re.search(r"```octave\n(.*?)```", page, re.S).group(1)
    lines = "plot = @(varargin) [];\n" + lines
    shown = "printf('%.17g %.17g\\n', [x_um; y_um]); printf('%s\\n', strjoin(fieldnames(run)', ' '));"
    printed = octave(lines + shown, folder).splitlines()
    assert printed.pop(0).startswith("ans = ")
    rows = np.array([[float(one) for one in line.split()] for line in printed[:-1]])
    assert np.array_equal(rows[:, 0], record.frames["x_um"]) and np.array_equal(rows[:, 1], record.frames["y_um"])
    assert {"frames", "paths", "plans", "events", "scenario", "map", "metrics", "timing"} <= set(printed[-1].split())


def test_octave_reads_every_column(run_h5):
    record, folder = run_h5
    code = "run = load('-hdf5', 'run.h5'); for [value, key] = run.frames, printf('%s', key); printf(' %.17g', double(value)); printf('\\n'); end"
    columns = {line.split()[0]: line.split()[1:] for line in octave(code, folder).splitlines()}
    for key in record.frames.to_array().dtype.names:
        if key != "state":  # words are stored as numbers
            assert np.array_equal(np.array(columns[key], dtype=float), record.frames[key], equal_nan=True), key


def test_octave_reads_groups_by_name_beside_a_text_that_it_cannot_read(flight, tmp_path):
    flight.description = "Grüße"
    record = ms.run(flight, progress=False)
    record.save(tmp_path / "run.h5")
    printed = octave("run = load('-hdf5', 'run.h5', 'frames'); printf('%.17g ', run.frames.x_um);", tmp_path)
    assert np.array_equal(np.array(printed.split(), dtype=float), record.frames["x_um"])


def test_records_pickle(flight):
    record = ms.run(flight, progress=False)
    for other in (pickle.loads(pickle.dumps(record)), copy.deepcopy(record)):
        assert other.hash == record.hash and other.metrics == record.metrics and other.replay() == (True, "")
        assert np.array_equal(other.step_time_s, record.step_time_s)
