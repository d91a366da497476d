# SPDX-License-Identifier: Apache-2.0
"""Tables of records and sweeps, as other packages take them."""

import copy
import pickle

import numpy as np
import pytest

import microswarm as ms


@pytest.fixture(scope="module")
def record():
    from conftest import SCENARIOS

    scenario = ms.Scenario.load(SCENARIOS / "first_flight.yaml").set("time_limit_s", 5).set("record.diagnostics", True)
    return ms.run(scenario, progress=False)


@pytest.fixture(scope="module")
def tables(record):
    from conftest import SCENARIOS

    swept = ms.sweep(SCENARIOS / "first_flight.yaml", {"seed": range(3)}, progress=False)
    shown = [one for one in record.diagnostics.values() if isinstance(one, ms.Table)]
    return [record.frames, record.events, record.plans, *record.plan_paths, *record.plan_trees, *shown, swept]


def test_pandas_takes_every_table(tables):
    pandas = pytest.importorskip("pandas")
    assert len(tables) > 4
    for table in tables:
        for frame in (pandas.DataFrame(table), table.to_pandas(), pandas.DataFrame(table.to_array()), pandas.DataFrame(np.asarray(table))):
            assert frame.shape == (table.rows, len(table)) and list(frame.columns) == list(table)
            for name, column in table.items():
                np.testing.assert_array_equal(frame[name].to_numpy(dtype=column.dtype), column)


def test_frames_that_take_dictionaries_take_every_table(tables):
    # polars.DataFrame, pyarrow.table and xarray.Dataset test for a dict, of arrays of one dimension and of plain types
    for table in tables:
        assert isinstance(table, dict) and type(table.to_dict()) is dict
        for column in table.to_dict().values():
            assert type(column) is np.ndarray and column.shape == (table.rows,) and column.dtype.kind in "iufbU"


def test_numpy_takes_every_table(tables):
    for table in tables:
        array = np.asarray(table)
        assert array.shape == (table.rows,) and array.dtype.names == tuple(table)
    frames = tables[0]
    plain = np.asarray(frames.to_array()[["x_um", "y_um"]].tolist())
    assert np.array_equal(plain[:, 0], frames["x_um"])


def test_a_table_is_read_only_and_its_copies_are_equal(record):
    frames = record.frames
    for change in (
        lambda: frames.__setitem__("x_um", 3),
        lambda: frames.update(x_um=3),
        lambda: frames.pop("x_um"),
        lambda: frames.setdefault("new", 3),
        lambda: frames.clear(),
        lambda: frames.__ior__({"x_um": 3}),
    ):
        with pytest.raises(TypeError, match="to_dict"):
            change()
    with pytest.raises(ValueError, match="read-only"):
        frames["x_um"][0] = 3
    for again in (copy.copy(frames), copy.deepcopy(frames), pickle.loads(pickle.dumps(frames))):
        assert type(again) is ms.Table and again.docs == frames.docs
        assert again.to_array().tobytes() == frames.to_array().tobytes()
        assert not again["x_um"].flags.writeable
    mine = frames.to_dict()
    mine["double_um"] = 2 * mine["x_um"]
    assert "double_um" not in frames and frames.rows == len(mine["double_um"])


@pytest.mark.parametrize("name, words", [("x", "did you mean 'x_um'"), ("xum", "did you mean 'x_um'"), ("colour", "t_s, x_um"), (3, "3 is not there")])
def test_a_column_that_is_not_there_is_told_with_near_words(record, name, words):
    with pytest.raises(KeyError, match=words):
        record.frames[name]
    assert name not in record.frames and record.frames.get(name) is None


def test_a_metric_that_is_not_there_is_told_with_near_words(record):
    with pytest.raises(KeyError, match="did you mean 'length_um'"):
        record.metrics["length"]
    assert type(pickle.loads(pickle.dumps(record.metrics))) is type(record.metrics)
