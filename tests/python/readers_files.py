# SPDX-License-Identifier: Apache-2.0
"""Files of a reader's that pages name and that are not shipped, as small ones of the same kind."""

import pathlib
import shutil
import struct
import subprocess
import zlib

import numpy as np

from conftest import ROOT

SAMPLES = ROOT / "tests/samples"


def write_png(path, grey):
    """Writes a picture of 8 bits, the upper row first."""
    grey = np.clip(grey, 0, 255).astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    whole = [struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in chunks]
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(whole))


def chip(bright):
    """A room of 800 × 400 pixels with a wall, which leaves a way above it."""
    walls = np.zeros((400, 800), bool)
    walls[150:, 390:410] = True
    walls[[0, -1]] = walls[:, [0, -1]] = True
    return np.where(walls == bright, 60, 220)


def photograph():
    """Noisy, 1400 × 700 pixels: a dark vessel between the two positions that the page names, and one across it."""
    rows, columns = np.mgrid[0:700, 0:1400]
    share = (columns - 258) / 976  # of the way
    middle = 276 + 158 * share + 60 * np.sin(2 * np.pi * share)
    vessel = (abs(rows - middle) < 9) | (abs(columns - 700) < 6)
    return 170 - 80 * vessel + np.random.default_rng(1).normal(0, 5, rows.shape)


def own_map(program):
    del program
    write_png("chip.png", chip(bright=True))
    write_png("dark.png", chip(bright=False))
    line = '{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}}'
    pathlib.Path("chip.geojson").write_text('{"type": "FeatureCollection", "features": [' + line + "]}", encoding="utf-8")


def photograph_to_map(program):
    del program
    write_png("build/demo/retina.jpg", photograph())


def replay_and_compare(program):
    run = [program, "run", "scenarios/first_flight.yaml", "--set", "time_limit_s=5", "--set", "seed=2", "--out", "out/b"]
    assert subprocess.run(run, capture_output=True).returncode == 3


def record(program):
    replay_and_compare(program)
    shutil.copy("out/b/run.h5", "run.h5")


def track_robots(program):
    del program
    pathlib.Path("swarm.mp4").symlink_to(SAMPLES / "video")  # a folder of pictures is a video, too


def calibrate_a_rig(program):
    del program
    shutil.copy(SAMPLES / "coils/coils.yaml", "OctoMag_Calibration.yaml")


OF_PAGE = {
    "docs/tutorials/own-map.md": own_map,
    "docs/tutorials/photograph-to-map.md": photograph_to_map,
    "docs/how-to/calibrate-a-rig.md": calibrate_a_rig,
    "docs/how-to/replay-and-compare.md": replay_and_compare,
    "docs/how-to/track-robots.md": track_robots,
    "docs/reference/record.md": record,
}
