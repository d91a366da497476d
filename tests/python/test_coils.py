# SPDX-License-Identifier: Apache-2.0
"""Coils: fields, currents and calibration."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT, SCENARIOS

CUBE = SCENARIOS / "rigs/cube.yaml"
RNG = np.random.default_rng(3)


@pytest.fixture
def cube():
    return ms.Coils.load(CUBE)


def told_by(program, *words):
    told = subprocess.run([str(word) for word in (program, "rig", *words, "--json")], capture_output=True, text=True)
    assert told.stdout, told.stderr
    return json.loads(told.stdout)


def comma(numbers):
    return ",".join(repr(float(one)) for one in numbers)


@pytest.mark.parametrize("file", ["cube.yaml", "helmholtz.yaml"])
@pytest.mark.parametrize("field, at", [((3, 0, 0), (0, 0, 0)), ((1, -2, 0.5), (3000, -2000, 500)), ((900, 0, 0), (0, 0, 0))])
def test_fields_and_currents_are_those_of_the_program(program, file, field, at):
    told = told_by(program, "field", SCENARIOS / "rigs" / file, f"--at={comma(at)}", f"--field={comma(field)}")
    coils = ms.Coils.load(SCENARIOS / "rigs" / file)
    currents = coils.currents(field, at)
    share = coils.allowed_share(currents)
    held = share * currents
    assert coils.names == told["coils"] and coils.name == told["system"] and len(coils) == len(held)
    assert share == pytest.approx(told["scale"], rel=1e-12) and (share < 1) == (field[0] == 900)
    assert held == pytest.approx(told["currents_a"], rel=1e-12, abs=1e-15)
    assert coils.field(held, at) == pytest.approx(told["field_mt"], rel=1e-12, abs=1e-12)
    g = coils.gradient(held, at)
    assert [g[0, 0], g[0, 1], g[0, 2], g[1, 1], g[1, 2]] == pytest.approx(told["gradients_t_per_m"], rel=1e-9, abs=1e-12)
    assert coils.in_workspace(at) == told["in_workspace"]


def test_the_currents_make_the_fields(cube):
    fields = RNG.uniform(-5, 5, (200, 3))
    places = RNG.uniform(-5000, 5000, (200, 3))
    currents = cube.currents(fields, places)
    assert currents.shape == (200, 6)
    assert np.allclose(cube.field(currents, places), fields, atol=1e-10)
    for k in (0, 57):
        matrix = cube.matrix(places[k])
        assert np.allclose(currents[k], np.linalg.pinv(matrix) @ fields[k], atol=1e-10)
        assert np.array_equal(cube.currents(fields[k], places[k]), currents[k])
        step = 1.0
        for axis in range(3):
            ahead, back = (cube.field(currents[k], places[k] + sign * step * np.eye(3)[axis]) for sign in (1, -1))
            assert np.allclose((ahead - back) / (2 * step) * 1e3, cube.gradient(currents[k], places[k])[:, axis], atol=1e-6)
    gradients = cube.gradient(currents, places)
    assert np.allclose(np.trace(gradients, axis1=1, axis2=2), 0, atol=1e-9) and np.allclose(gradients, gradients.transpose(0, 2, 1))
    at_centre = cube.currents(fields)
    for same in (fields.tolist(), np.asfortranarray(fields), np.repeat(fields, 2, axis=1)[:, ::2]):
        assert np.array_equal(cube.currents(same), at_centre)
    assert np.array_equal(cube.currents(fields, np.tile(cube.centre_um, (200, 1))), at_centre)
    assert cube.currents(np.empty((0, 3))).shape == (0, 6)
    assert cube.currents(np.array([[1, 0, 0]])).shape == (1, 6) and cube.currents([1, 0, 0]).shape == (6,)


def test_a_share_of_the_currents_can_be_held(cube):
    currents = cube.currents([[3, 0, 0], [3000, 0, 0]])
    share = cube.allowed_share(currents)
    assert share[0] == 1 and 0 < share[1] < 1
    assert np.allclose(cube.allowed_share(share[:, None] * currents), 1)


def test_the_coils_of_a_rig_are_limited_by_its_driver():
    rig = SCENARIOS / "rigs/bench.yaml"
    coils, alone = ms.Coils.load(rig), ms.Coils.load(SCENARIOS / "rigs/helmholtz.yaml")
    assert coils.names == alone.names
    assert np.array_equal(coils.matrix(), alone.matrix())
    many = 1000 * np.ones(3)
    assert coils.allowed_share(many) <= alone.allowed_share(many) and coils.allowed_share(many) <= 10 / 1000


@pytest.mark.parametrize("folder", ["sample", "data"])
def test_measured_models_give_the_expected_fields(tmp_path, folder):
    """Also files of real calibrations."""
    if folder == "data" and "MICROSWARM_DATA" not in os.environ:
        pytest.skip("MICROSWARM_DATA names no folder of data")
    files = pathlib.Path(os.environ["MICROSWARM_DATA"]) / "magcal" if folder == "data" else ROOT / "tests/samples/coils"
    expected = sorted(files.glob("*.expected_fields.csv"))
    assert expected
    for one in expected:
        system = tmp_path / "system.yaml"
        system.write_text(f"coils: {{type: mpem, file: {one.with_name(one.name.replace('.expected_fields.csv', '.yaml'))}}}\n")
        coils = ms.Coils.load(system)
        table = np.loadtxt(one, delimiter=",", skiprows=1)  # px py pz, currents, Bx By Bz, five gradients, in_ws
        places, currents, table = np.split(table, [3, 3 + len(coils)], axis=1)
        fields, gradients = 1e3 * table[:, :3], table[:, 3:8]
        places *= 1e6
        assert np.allclose(coils.field(currents, places), fields, rtol=1e-6, atol=1e-9 * np.abs(fields).max())
        ours = coils.gradient(currents, places).reshape(-1, 9)[:, [0, 1, 2, 4, 5]]
        known = np.isfinite(gradients).all(axis=1)  # the reference gives none at the position of a source
        assert known.sum() >= len(known) / 2
        assert np.allclose(ours[known], gradients[known], rtol=1e-6, atol=1e-9 * np.abs(gradients[known]).max())
        assert [coils.in_workspace(place) for place in places] == table[:, 8].astype(bool).tolist()


def measured(cube, n=60, noise=0.0, gradients=True):
    currents = RNG.uniform(-3, 3, (n, 6))
    places = RNG.uniform(-800, 800, (n, 3)) if gradients else np.zeros((n, 3))
    fields = cube.field(currents, places) + (0.1, -0.2, 0.05) + noise * RNG.standard_normal((n, 3))
    return currents, fields, places


def test_a_calibration_finds_the_coils(cube, tmp_path):
    currents, fields, places = measured(cube, gradients=False)
    fitted = ms.Coils.from_measurements(currents, fields, names=cube.names, name="mine", offset=True)
    assert np.allclose(fitted.matrix(), cube.matrix(), atol=1e-9)
    assert fitted.fit["offset_mt"] == pytest.approx([0.1, -0.2, 0.05]) and fitted.fit["rms_abs_mt"] < 1e-12
    assert np.allclose(fitted.field(fitted.currents([2, 1, 0])), [2, 1, 0])
    assert np.allclose(fitted.field(np.zeros(6)), [0.1, -0.2, 0.05])
    fitted.save(tmp_path / "mine.yaml")
    back = ms.Coils.load(tmp_path / "mine.yaml")
    assert back.names == cube.names and back.name == "mine" and np.array_equal(back.matrix(), fitted.matrix())
    with pytest.raises(ms.InputError, match="only calibrated"):
        back.save(tmp_path / "again.yaml")
    assert not (tmp_path / "again.yaml").exists()


def test_standard_errors_tell_the_noise(cube):
    currents, fields, _ = measured(cube, n=400, noise=0.05, gradients=False)
    fitted = ms.Coils.from_measurements(currents, fields, offset=True)
    assert fitted.names == [f"coil{k}" for k in range(1, 7)]
    off = (fitted.matrix() - cube.matrix()) / fitted.fit["field_error_mt_per_a"]
    assert 0.5 < np.sqrt((off**2).mean()) < 1.6
    assert fitted.fit["rms_mt"] == pytest.approx([0.05] * 3, rel=0.15)
    assert np.allclose(fitted.fit["residuals_mt"], fields - fitted.field(currents))
    worst = np.linalg.norm(fitted.fit["residuals_mt"], axis=1)
    assert worst.argmax() == fitted.fit["worst_row"] and worst.max() == pytest.approx(fitted.fit["worst_mt"])


@pytest.mark.parametrize("gradients", [False, True])
def test_a_calibration_is_that_of_the_program(program, cube, tmp_path, gradients):
    currents, fields, places = measured(cube, noise=0.02)
    names = ["a", "b", "c", "d", "e", "f"]
    header = ",".join([f"i_{name}_a" for name in names] + ["bx_mt", "by_mt", "bz_mt", "x_um", "y_um", "z_um"])
    rows = [comma(row) for row in np.hstack((currents, fields, places))]
    file = tmp_path / "measured.csv"
    file.write_text("\n".join([header, *rows]) + "\n")
    words = ["calibrate", file, "--offset", "--out", tmp_path / "told.yaml", *(["--gradients"] if gradients else [])]
    told = told_by(program, *words)
    for fitted in (
        ms.Coils.from_csv(file, offset=True, gradients=gradients),
        ms.Coils.from_measurements(currents, fields, places, names=names, name="measured", offset=True, gradients=gradients),
    ):
        fit = fitted.fit
        for key in ("rms_mt", "rms_abs_mt", "worst_mt", "field_mt_per_a", "offset_mt"):
            assert fit[key] == told[key], key
        assert np.array_equal(fit["field_error_mt_per_a"], told["field_error_mt_per_a"])
        if gradients:
            assert fit["gradient_t_per_m_per_a"] == told["gradient_t_per_m_per_a"] and fit["centre_um"] == told["centre_um"]
        fitted.save(tmp_path / "ours.yaml")
        assert (tmp_path / "ours.yaml").read_text() == (tmp_path / "told.yaml").read_text()


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda c: c.currents(None), "fields_mt is None, must be numbers"),
        (lambda c: c.currents("strong"), "fields_mt is 'strong', must be numbers"),
        (lambda c: c.currents([1, 2]), "fields_mt must have the shape"),
        (lambda c: c.currents(5), "fields_mt must have the shape"),
        (lambda c: c.currents([[1, 2, 3], [4]]), "fields_mt"),
        (lambda c: c.currents([1, np.nan, 0]), "fields_mt has nan"),
        (lambda c: c.currents([1, 1e300, 0]), "fields_mt has 1e"),
        (lambda c: c.currents(np.zeros((2, 3), complex)), "must be numbers"),
        (lambda c: c.currents(np.zeros((2, 2, 3))), "fields_mt must have the shape"),
        (lambda c: c.currents([1, 0, 0], [0, 0]), "at_um"),
        (lambda c: c.currents([1, 0, 0], [0, 0, np.inf]), "at_um has inf"),
        (lambda c: c.currents(np.zeros((3, 3)), np.zeros((2, 3))), "at_um has 2 rows"),
        (lambda c: c.field([1, 2, 3]), "currents_a must have the shape"),
        (lambda c: c.field(np.full(6, -np.inf)), "currents_a has -inf"),
        (lambda c: c.gradient([[1, 2, 3]]), "currents_a"),
        (lambda c: c.allowed_share(np.zeros((2, 7))), "currents_a"),
        (lambda c: c.matrix("here"), "at_um"),
        (lambda c: c.in_workspace((0, 0, np.nan)), "at_um has nan"),
        (lambda c: ms.Coils.load("nothing.yaml"), "nothing.yaml"),
        (lambda c: ms.Coils.load(SCENARIOS / "first_flight.yaml"), "first_flight.yaml"),
        (lambda c: ms.Coils.load(SCENARIOS / "maps/retina.geojson"), "retina.geojson"),
        (lambda c: ms.Coils.from_csv("nothing.csv"), "nothing.csv"),
        (lambda c: ms.Coils.from_csv(CUBE), "header|cube.yaml"),
    ],
)
def test_bad_input(cube, call, words):
    with pytest.raises(ms.InputError, match=words):
        call(cube)


@pytest.mark.parametrize(
    "change, words",
    [
        ({"currents_a": np.zeros((60, 6))}, "never varied|coil1"),
        ({"currents_a": np.zeros((0, 6)), "fields_mt": np.zeros((0, 3)), "positions_um": None}, "there are none"),
        ({"currents_a": np.zeros((60, 0))}, "0 columns"),
        ({"currents_a": np.ones((60, 65))}, "65 columns"),
        ({"currents_a": np.full((60, 6), np.nan)}, "currents_a has nan"),
        ({"currents_a": None}, "currents_a"),
        ({"fields_mt": np.zeros((59, 3))}, "60 rows"),
        ({"fields_mt": np.zeros((60, 2))}, "fields_mt must have the shape"),
        ({"fields_mt": np.zeros((60, 3))}, "do not change the field"),
        ({"positions_um": np.zeros((60, 3)), "gradients": True}, "position"),
        ({"positions_um": np.zeros((59, 3))}, "60 rows"),
        ({"offset": "no"}, "offset is 'no', must be True or False"),
        ({"gradients": []}, r"gradients is \[\], must be True or False"),
        ({"names": 5}, "names is 5, must be 6 words"),
        ({"names": list("abcde") + ["\udcff"]}, "one of names is .*UTF-8"),
        ({"name": 5}, "name is 5, must be a text"),
        ({"names": ["a"]}, r"names is \['a'\], must be 6"),
        ({"names": "abcdef"}, "names is 'abcdef', must be 6"),
        ({"names": ["a"] * 6}, "a"),
        ({"centre_um": (0, 0)}, "centre_um"),
        ({"centre_um": (0, 0, 1e9), "gradients": True}, "centre_um has 1e"),
    ],
)
def test_bad_measurements(cube, change, words):
    currents, fields, places = measured(cube)
    with pytest.raises(ms.InputError, match=words):
        ms.Coils.from_measurements(**{"currents_a": currents, "fields_mt": fields, "positions_um": places, "offset": True, **change})
