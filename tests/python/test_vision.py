# SPDX-License-Identifier: Apache-2.0
"""Vessels of photographs and robots in videos."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT

SAMPLES = ROOT / "tests/samples"


def spots(places, shape=(60, 100), sigma=2.5, depth=90):
    """Dark robots on a bright, slightly uneven background, as uint8."""
    y, x = np.mgrid[: shape[0], : shape[1]]
    grey = 190.0 + 3 * np.sin(x / 7)
    for px, py in places:
        grey -= depth * np.exp(-((x - px) ** 2 + (y - py) ** 2) / (2 * sigma**2))
    return np.clip(np.rint(grey), 0, 255).astype(np.uint8)


def places_at(k):
    return [(15 + 2 * k, 20 + 0.5 * k), (80 - 1.5 * k, 45)]


@pytest.fixture
def video():
    return np.stack([spots(places_at(k)) for k in range(12)])


def write_pnm(path, picture):
    magic = b"P5" if picture.ndim == 2 else b"P6"
    most = b"255" if picture.dtype == np.uint8 else b"65535"
    data = picture if picture.dtype == np.uint8 else picture.astype(">u2")
    path.write_bytes(magic + b"\n%d %d\n" % (picture.shape[1], picture.shape[0]) + most + b"\n" + data.tobytes())


def tracks_of_program(program, source, folder, *words):
    command = [program, "track", source, "--out", folder, "--no-overlay", *words]
    subprocess.run([str(word) for word in command], check=True, capture_output=True)
    return np.genfromtxt(folder / "tracks.csv", delimiter=",", names=True, dtype=None), (folder / "events.csv").read_text()


def folder_of(path, video):
    path.mkdir()
    for k, picture in enumerate(video):
        write_pnm(path / (f"{k:03}.pgm" if picture.ndim == 2 else f"{k:03}.ppm"), picture)
    return path


def assert_like_the_csv(tracks, csv):
    assert tracks["particle"].tolist() == csv["id"].tolist()
    assert set(csv.dtype.names) == {*tracks.dtype.names, "id"}
    for name in tracks.dtype.names:
        ours = tracks[name]
        assert [f"{one:.9g}" for one in ours] == [f"{one:.9g}" for one in csv[name]], name


@pytest.mark.parametrize("colour", [False, True])
def test_tracks_are_those_of_the_program(program, tmp_path, video, colour):
    if colour:
        video = np.stack([video, video[:, ::-1], 255 - video], axis=-1)
    folder = folder_of(tmp_path / "in", video)
    words = ["--um-per-px", 0.4, "--rate", 8, "--set", "find.min_mass=100", "--set", "track.memory=2", "--set", "channel=red"]
    csv, events_csv = tracks_of_program(program, folder, tmp_path / "out", *words)
    values = {"min_mass": 100, "track": {"memory": 2}, "channel": "red", "progress": False}
    tracks, events = ms.track(video, 0.4, 8, return_events=True, **values)
    assert_like_the_csv(tracks, csv)
    lines = [line.split(",") for line in events_csv.splitlines()[1:]]
    assert [[str(e["frame"]), e["event"], str(e["particle"])] for e in events] == [[line[0], *line[2:4]] for line in lines]
    for same in (folder, str(folder), list(video), (one for one in video), np.asfortranarray(video), video.astype(">u1")):
        assert ms.track(same, 0.4, 8, **values).tobytes() == tracks.tobytes()


def test_numbers_of_16_bits_are_scaled_as_those_of_a_file(program, tmp_path, video):
    deep = video.astype(np.uint16) * 15  # 12 bits
    tracks = ms.track(deep, 1, 10, min_mass=100)
    for one in (deep.astype(">u2"), np.repeat(deep, 2, axis=2)[:, :, ::2]):
        assert ms.track(one, 1, 10, min_mass=100).tobytes() == tracks.tobytes()
    scaled = np.rint(deep * (255 / 4095)).astype(np.uint8)
    assert np.array_equal(ms.track(scaled, 1, 10, min_mass=100)["particle"], tracks["particle"])
    assert ms.track(deep, 1, 10, min_mass=100, depth=12).tobytes() == tracks.tobytes()
    with pytest.raises(ms.InputError, match="depth is 20"):
        ms.track(deep, 1, 10, depth=20)


def test_tracks_are_where_the_robots_are(video):
    tracks = ms.track(video, 0.5, 4, min_mass=100)
    assert set(tracks["particle"].tolist()) == {0, 1}
    for k in range(len(video)):
        seen = np.sort(tracks[tracks["frame"] == k], order="x")
        true = np.array(sorted(places_at(k)))
        assert np.abs(seen["x"] - true[:, 0]).max() < 0.2 and np.abs(seen["y"] - true[:, 1]).max() < 0.2
    assert np.allclose(tracks["x_um"], (tracks["x"] + 0.5) * 0.5)
    assert np.allclose(tracks["y_um"], (60 - 0.5 - tracks["y"]) * 0.5)
    assert np.array_equal(tracks["t_s"], tracks["frame"] / 4)
    last = tracks[(tracks["particle"] == tracks["particle"][0]) & (tracks["frame"] == 11)]
    assert last["vx_um_per_s"][0] == pytest.approx(4, rel=0.05)
    assert last["vy_um_per_s"][0] == pytest.approx(-1, rel=0.05)


def test_fast_robots_need_a_range():
    fast = np.stack([spots([(12 + 14 * k, 30)]) for k in range(6)])
    with pytest.warns(UserWarning, match="search_range_um"):
        alone = ms.track(fast, 0.5, 4, min_mass=100)
    assert len(set(alone["particle"].tolist())) == 6
    assert set(ms.track(fast, 0.5, 4, min_mass=100, search_range_um=8)["particle"].tolist()) == {0}


def test_a_region_is_tracked_in(video):
    whole = ms.track(video, 0.5, 4, min_mass=100)
    right = ms.track(video, 0.5, 4, min_mass=100, region={"x_px": 50, "y_px": 10, "width_px": 50, "height_px": 50})
    assert set(right["particle"].tolist()) == {0}
    there = whole[whole["x"] > 50]
    assert np.abs(np.sort(right["x"]) - np.sort(there["x"])).max() < 0.05
    with pytest.raises(ms.InputError, match="region"):
        ms.track(video, 0.5, 4, region={"x_px": 90, "y_px": 10, "width_px": 50, "height_px": 50})


def test_pandas_takes_tracks(video):
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(ms.track(video, 0.5, 4, min_mass=100))
    assert list(table.columns[:4]) == ["frame", "particle", "x", "y"]
    assert len(table.groupby("particle")) == 2


def test_tracks_of_a_table_are_taken(program, tmp_path, video):
    tracks = ms.track(video, 0.5, 4, min_mass=100)
    file = tmp_path / "t.csv"

    def write(*names):
        np.savetxt(file, np.column_stack([tracks[name] for name in names]), fmt="%.9g", delimiter=",", header=",".join(names), comments="")

    write("frame", "x", "y", "particle", "mass")
    taken = ms.track(file, 0.5, 4)
    csv, _ = tracks_of_program(program, file, tmp_path / "out", "--um-per-px", 0.5, "--rate", 4)
    assert_like_the_csv(taken, csv)
    assert np.array_equal(taken["particle"], tracks["particle"])
    for name in ("x_um", "t_s", "vx_um_per_s", "vy_um_per_s", "mass"):
        assert np.allclose(taken[name], tracks[name], rtol=1e-6), name
    for values, words in (({"fps": 4}, "give um_per_px"), ({"um_per_px": 0.5}, "give fps"), ({"um_per_px": 0.5, "times_s": file}, "times_s")):
        with pytest.raises(ms.InputError, match=words):
            ms.track(file, **values)
    with pytest.raises(ms.InputError, match="region"):
        ms.track(file, 0.5, 4, region={"x_px": 0, "y_px": 0, "width_px": 9, "height_px": 9})
    write("frame", "x", "y", "t_s")
    with pytest.warns(UserWarning, match="has no tracks"):
        linked = ms.track(file, 0.5)
    assert np.array_equal(linked["t_s"], tracks["t_s"]) and len(set(linked["particle"].tolist())) == 2
    file.write_text("frame,x,y,particle,t_s\n0,1,2,0,1\n1,1,2,0,1\n")
    with pytest.raises(ms.InputError, match=r"t\.csv:3: frame 1 is at 1 s"):
        ms.track(file, 0.5)


def test_times_of_ones_own(video, tmp_path):
    times = 100 + np.arange(12) / 4
    tracks = ms.track(video, 0.5, times_s=times, min_mass=100)
    even = ms.track(video, 0.5, 4, min_mass=100)
    assert np.array_equal(tracks["t_s"], times[tracks["frame"]])
    assert np.allclose(tracks["vx_um_per_s"], even["vx_um_per_s"])
    folder = folder_of(tmp_path / "in", video)
    assert ms.track(folder, 0.5, times_s=list(times), min_mass=100).tobytes() == tracks.tobytes()
    for bad in (times[:-1], times[::-1], [1], "soon", np.full(12, np.nan), np.zeros((12, 2)), None):
        with pytest.raises(ms.InputError, match="times"):
            ms.track(video, 0.5, times_s=bad)
    with pytest.raises(ms.InputError, match="11 times, there are more"):
        ms.track((one for one in video), 0.5, times_s=times[:-1])
    with pytest.raises(ms.InputError, match="both"):
        ms.track(video, 0.5, 4, times_s=times)
    with pytest.raises(ms.InputError, match="states no times"):
        ms.track(folder, 0.5)
    table = tmp_path / "times.csv"
    table.write_text("picture,t_s\n" + "".join(f"{k},{t}\n" for k, t in enumerate(times)))
    assert ms.track(folder, 0.5, times_s=table, min_mass=100).tobytes() == tracks.tobytes()
    table.write_text("1\n2\n")
    with pytest.raises(ms.InputError, match="2 times, there are 12 pictures"):
        ms.track(folder, 0.5, times_s=table)


def test_velocities_follow_the_times(video):
    tracks = ms.track(video, 0.5, times_s=np.arange(12), min_mass=100)
    even = ms.track(video, 0.5, 4, min_mass=100)
    last, same = (one[one["frame"] == 11] for one in (tracks, even))
    assert np.allclose(last["vx_um_per_s"], same["vx_um_per_s"] / 4, rtol=0.02)


def test_gaps_in_names_are_gaps_in_time(video, tmp_path):
    folder = folder_of(tmp_path / "in", video)
    for k in range(6, 12):
        (folder / f"{k:03}.pgm").rename(folder / f"{k + 20:03}.pgm")
    with pytest.warns(UserWarning, match="1 gap, first between 005.pgm and 026.pgm"):
        tracks = ms.track(folder, 0.5, 4, min_mass=100)
    assert set(tracks["t_s"].tolist()) == {k / 4 for k in (*range(6), *range(26, 32))}


def test_gaps_in_names_of_several_numbers_need_times(video, tmp_path):
    folder = folder_of(tmp_path / "in", video)
    for k in range(12):
        (folder / f"{k:03}.pgm").rename(folder / f"{k // 4}_{k:03}.pgm")
    with pytest.warns(UserWarning, match="gaps need times_s") as caught:
        ms.track(folder, 0.5, 4, min_mass=100)
    assert not any("--" in str(one.message) for one in caught)


def test_a_scale_is_needed(video, tmp_path):
    with pytest.raises(ms.InputError, match="um_per_px is missing"):
        ms.track(video, fps=4)
    with pytest.raises(ms.InputError, match="states no scale: give um_per_px"):
        ms.track(folder_of(tmp_path / "in", video), fps=4)


def test_one_picture_at_a_time_is_held(video):
    held = []

    def camera():
        for picture in video:
            held.append(picture.copy())
            if len(held) > 1:
                held[-2] = None
            yield held[-1]

    shares = []
    assert len(ms.track(camera(), 0.5, 4, min_mass=100)) == 24
    ms.track(video, 0.5, 4, min_mass=100, progress=shares.append)
    assert len(shares) == 12 and shares[-1] == 1 and shares == sorted(shares)


def test_an_exception_of_the_pictures_is_raised(video):
    def broken():
        yield video[0]
        raise OSError("unplugged")

    with pytest.raises(OSError, match="unplugged"):
        ms.track(broken(), 0.5, 4)


@pytest.mark.parametrize(
    "frames, words",
    [
        (None, "frames is None"),
        (5, "frames is 5"),
        ([], "no pictures"),
        (np.empty((0, 5, 5), np.uint8), "no pictures"),
        (np.zeros((5, 5), np.uint8), "shape"),
        (np.zeros((5, 5, 3), np.uint8), "shape"),
        (np.zeros((2, 5, 5, 4), np.uint8), r"frame 0 has the shape \(5, 5, 4\)"),
        (np.zeros((2, 5, 5)), "frame 0 is of float64"),
        (np.full((2, 5, 5), np.nan), "frame 0 is of float64"),
        ([np.zeros((5, 5), np.int32)], "frame 0 is of int32"),
        ([None], "frame 0 is None, must be an array"),
        ([[[1, 2], [3]]], r"frame 0 is \[\[1, 2\], \[3\]\], must be an array"),
        ([np.zeros((9, 9), np.uint8), np.zeros((9, 8), np.uint8)], "frame 1: 9 × 8 pixels, the first has 9 × 9"),
        (np.zeros((2, 0, 5), np.uint8), "at least 1"),
        ([np.broadcast_to(np.uint8(3), (1 << 40, 1 << 20))], "at most"),
        ("nothing.mp4", "nothing.mp4"),
    ],
)
def test_bad_frames(frames, words):
    with pytest.raises(ms.InputError, match=words):
        ms.track(frames, 1, 10)


@pytest.mark.parametrize(
    "values, words",
    [
        ({"um_per_px": 0}, "um_per_px is 0"),
        ({"um_per_px": np.nan}, "um_per_px"),
        ({"um_per_px": None}, "um_per_px"),
        ({"fps": -1}, "fps is -1"),
        ({"fps": None}, "fps is missing"),
        ({"diameter_px": 1}, "diameter_px is 1"),
        ({"diametr_px": 11}, "did you mean 'diameter_px'"),
        ({"tone": "pink"}, "tone"),
        ({"find": 3}, "find"),
        ({"track": {"memry": 3}}, "did you mean 'memory'"),
        ({"rate_hz": 3}, "fps"),
        ({"progress": 3}, "progress"),
    ],
)
def test_bad_values_of_tracking(video, values, words):
    with pytest.raises(ms.InputError, match=words):
        ms.track(video, **{"um_per_px": 1, "fps": 10, **values})


def test_noise_is_warned_of():
    noise = np.random.default_rng(1).integers(0, 255, (8, 60, 60), dtype=np.uint8)
    with pytest.warns(UserWarning, match="noise"):
        ms.track(noise, 1, 10, min_mass=0)


def segmented_by_program(program, folder, *words):
    command = [program, "map", "segment", *words, "--out", folder / "v.geojson", "--json"]
    told = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True)
    return json.loads(told.stdout), ms.Map.load(folder / "v.geojson")


def same_walls(a, b):
    return len(a.walls_um) == len(b.walls_um) and all(
        np.array_equal(p, q) for one, two in zip(a.walls_um, b.walls_um) for p, q in zip(one, two)
    )


@pytest.mark.parametrize("values", [{}, {"method": "lines", "keep": "all", "min_width_px": 3, "smooth_px": 2}])
def test_vessels_are_those_of_the_program(program, tmp_path, values):
    photo = SAMPLES / "vessels/retina.png"
    words = [word for key, value in values.items() if key != "smooth_px" for word in ("--set", f"{key}={value}")]
    words += ["--smooth", values.get("smooth_px", 1)]
    told, chip = segmented_by_program(program, tmp_path, photo, "--um-per-px", 6, *words)
    found = ms.segment(photo, 6, **values)
    assert found.vessel_share == told["vessel_share"] and found.pieces == told["pieces"]
    assert found.kept_share == told["kept_share"] and found.bridges == told["bridges"]
    assert found.wide_width_um == told["wide_width_um"]
    assert found.map.bounds_um == chip.bounds_um and same_walls(found.map, chip)
    assert found.mask.dtype == bool and found.mask.shape == found.field_of_view.shape == (200, 200)


def test_the_map_is_free_where_the_mask_is(tmp_path):
    picture = np.full((120, 160), 200, np.uint8)
    picture[50:70, 10:150] = 60
    picture[20:50, 70:86] = 60
    found = ms.segment(picture, 5, method="regions", polarity="dark", smooth_px=0)
    assert found.mask.sum() == pytest.approx((picture == 60).sum(), rel=0.05)
    rows, columns = np.nonzero(found.mask)
    inner = [found.mask[max(0, r - 2) : r + 3, max(0, c - 2) : c + 3].all() for r, c in zip(rows, columns)]
    middles = np.column_stack(((columns + 0.5) * 5, (120 - rows - 0.5) * 5))
    assert found.map.is_free(middles[inner]).all()
    write_pnm(tmp_path / "p.pgm", picture)
    for same in (tmp_path / "p.pgm", np.asfortranarray(picture), picture[::-1][::-1], np.stack([picture] * 3, -1), picture[..., None], picture.astype(np.uint16) * 16):
        assert np.array_equal(ms.segment(same, 5, method="regions", polarity="dark").mask, found.mask)


def test_method_and_polarity_are_named():
    picture = np.full((160, 220), 190, np.uint8)
    picture[70:90, :] = 90
    for image, polarity in ((picture, "dark"), ((280 - picture.astype(int)).astype(np.uint8), "bright")):
        found = ms.segment(image, 5)
        assert (found.method, found.polarity) == ("regions", polarity)
        assert found.two_level_share > 0.9 and found.polarity_odds > 1
    assert ms.segment(picture, 5, method="regions", polarity="dark").two_level_share is None


def test_channels_are_measured():
    wall = np.zeros((100, 300), bool)
    wall[:35] = wall[65:] = True
    branches, nodes = ms.channel_graph(ms.Map.from_image(~wall, 2), cell_um=2)
    assert len(branches) == 1 and list(nodes["degree"]) == [1, 1] and branches["type"][0] == 0
    assert branches["mean_width_um"][0] == pytest.approx(60, abs=1)
    assert branches["length_um"][0] == pytest.approx(540, abs=12)
    with pytest.raises(ms.InputError, match="map is"):
        ms.channel_graph("map.png")


@pytest.mark.parametrize(
    "image, values, words",
    [
        (None, {}, "image is None, must be an array of uint8 or uint16"),
        (np.zeros(5, np.uint8), {}, "image has the shape"),
        (np.zeros((5, 5, 2), np.uint8), {}, "image has the shape"),
        (np.zeros((5, 5)), {}, "image is of float64"),
        (np.full((5, 5), np.nan), {}, "image is of float64"),
        (np.array([["a"]]), {}, "image is array"),
        ([[1, 2], [3]], {}, "array"),
        (np.zeros((0, 5), np.uint8), {}, "at least 1"),
        (np.broadcast_to(np.uint8(3), (1 << 40, 1 << 20)), {}, "at most"),
        (np.zeros((50, 50), np.uint8), {}, "no vessels"),
        (np.zeros((1, 1), bool), {}, "no vessels"),
        (np.zeros((50, 50), np.uint8), {"um_per_px": np.inf}, "um_per_px"),
        (np.zeros((50, 50), np.uint8), {"smooth_px": -1}, "smooth_px"),
        (np.zeros((50, 50), np.uint8), {"threshold": 1e9}, "threshold"),
        (np.zeros((50, 50), np.uint8), {"thresold": 1}, "did you mean 'threshold'"),
        ("nothing.png", {}, "nothing.png"),
        ("\0", {}, "must be the name of a file"),
    ],
)
def test_bad_photographs(image, values, words):
    with pytest.raises(ms.InputError, match=words):
        ms.segment(image, **{"um_per_px": 5, **values})


@pytest.mark.skipif("MICROSWARM_DATA" not in os.environ, reason="MICROSWARM_DATA names no folder of data")
def test_real_photographs_and_videos(program, tmp_path):
    data = pathlib.Path(os.environ["MICROSWARM_DATA"])
    photo = data / "vessels/CHASE_01L.jpg"
    told, chip = segmented_by_program(program, tmp_path, photo, "--um-per-px", 6)
    found = ms.segment(photo, 6)
    assert found.vessel_share == told["vessel_share"] and same_walls(found.map, chip)

    values = {"diameter_px": 17, "tone": "bright", "shape": "ring", "min_mass": 500}
    tracks = ms.track(data / "video/brightfield", 0.1519, 10, **values)
    reference = np.genfromtxt(data / "video/brightfield_ref_trackpy.csv", delimiter=",", names=True)
    assert len(tracks) == len(reference) == 100 and len(set(tracks["particle"].tolist())) == 5
    for row in reference:
        seen = tracks[tracks["frame"] == row["frame"]]
        assert np.hypot(seen["x"] - row["x"], seen["y"] - row["y"]).min() < 2
