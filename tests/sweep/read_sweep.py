#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares a sweep in HDF5 with the same in CSV: read_sweep.py FILE.h5 FILE.csv."""

import csv
import sys

import h5py

with open(sys.argv[2], encoding="utf-8", newline="") as file:
    rows = list(csv.DictReader(file))
with h5py.File(sys.argv[1], "r") as sweep:
    assert sweep.attrs["format"].decode() == "microswarm sweep"
    assert sweep["sweep"][()].decode().startswith("name:")
    trials = sweep["trials"]
    assert set(trials) == set(rows[0])
    assert trials["time_s"].attrs["unit"].decode() == "s"
    assert trials["contacts"].dtype == "<i8"
    for name, dataset in trials.items():
        for value, row in zip(dataset[:], rows, strict=True):
            if isinstance(value, bytes):
                assert value.decode() == row[name], name
            else:
                assert value == float(row[name]), name
    assert len(sweep["cells/scenario"]) == 8
