#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a record with h5py: read_record.py FILE FRAMES HASH; fails when it is not as said."""

import sys

import h5py

path, frame_count, record_hash = sys.argv[1], int(sys.argv[2]), sys.argv[3]
with h5py.File(path, "r") as record:
    assert record.attrs["format"].decode() == "microswarm record"
    assert record.attrs["record_hash"].decode() == record_hash
    assert record.attrs["status"].decode() == "solved"
    assert record["scenario"][()].decode().startswith("name:")
    frames = record["frames"]
    for name, dataset in frames.items():
        assert dataset.shape == (frame_count,), name
        assert dataset.dtype in ("<f8", "<i8"), name
    assert frames["x_um"].attrs["unit"].decode() == "µm"
    assert frames["t_s"][0] == 0
    words = frames["state"].attrs["words"].decode().split()
    assert words[frames["state"][-1]] == "end"
    offset = record["plans/path/offset"][:]
    assert len(offset) == len(record["plans/t_s"]) + 1
    assert offset[-1] == len(record["plans/path/x_um"])
    assert record["metrics"].attrs["length_um"] > 1000
    assert len(record["timing/step_s"]) == frame_count - 1
