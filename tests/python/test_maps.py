# SPDX-License-Identifier: Apache-2.0
"""Maps and paths."""

import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT
from microswarm.environments import free_cells


@pytest.fixture
def room():
    """400 × 400 µm with a wall from below, open above."""
    image = np.full((40, 40), 255, dtype=np.uint8)
    image[10:, 18:22] = 0
    return ms.Map.from_image(image, 10)


def test_a_map_of_an_image(room):
    assert room.bounds_um == (0, 0, 400, 400)
    assert room.clearance([[50, 50], [200, 50], [50, 390]]) == pytest.approx([50, 0, 10])
    assert room.is_free(np.array([[50, 50], [175, 50]]), 10).tolist() == [True, False]
    (ring,) = room.walls_um[0]
    assert ring.min(axis=0).tolist() == [180, 0] and ring.max(axis=0).tolist() == [220, 300]


def test_keys_and_units_of_a_file(tmp_path):
    matrix = tmp_path / "m.txt"
    matrix.write_text("1 1 1\n1 0 1\n1 1 1\n")
    with pytest.warns(FutureWarning, match="map.wall=one"):
        free = ms.Map.load(matrix, 10)
    assert free.clearance([[5, 5], [15, 15]]).tolist() == [5, 0]
    assert ms.Map.load(matrix, 10, wall="one").clearance([[5, 5], [15, 15]]).tolist() == [0, 5]
    drawing = tmp_path / "a.geojson"
    drawing.write_text('{"type":"LineString","coordinates":[[0,0],[3,0]]}')
    assert ms.Map.load(drawing, um_per_unit=1000, line_width_um=100).bounds_um == (-50, -50, 3050, 50)
    with pytest.warns(FutureWarning, match="give um_per_unit") as caught:
        ms.Map.load(drawing, line_width_um=1)
    assert "--" not in str(caught[0].message)
    degrees = tmp_path / "b.geojson"
    degrees.write_text('{"type":"Point","coordinates":[1,2],"crs":{}}')
    with pytest.raises(ms.InputError, match="give um_per_unit") as refused:
        ms.Map.load(degrees)
    assert "--" not in str(refused.value)
    with pytest.raises(ms.InputError, match="line_width"):
        ms.Map.load(drawing, um_per_unit=1000)
    with pytest.raises(ms.InputError, match="map.fre"):
        ms.Map.load(matrix, 10, fre="dark")


def test_a_goal_in_a_wall_is_refused_and_one_near_it_is_noted(room):
    for planner in ms.planners:
        with pytest.raises(ms.InputError, match="goal is 20 µm inside wall"):
            ms.plan(room, (50, 50), (200, 50), planner, 10)
    with pytest.warns(FutureWarning, match="the path ends 1[5-7]"):
        assert ms.plan(room, (50, 50), (175, 50), clearance_um=20, goal_tolerance_um=30).solved


def test_an_image_of_noise_is_refused():
    image = np.ones((2400, 2400), dtype=bool)
    image[::2, ::2] = False
    with pytest.raises(ms.InputError, match="5760000 corners, at most 5000000"):
        ms.Map.from_image(image, 1)


def test_ctrl_c_ends_a_question_about_many_places():
    code = """
import microswarm as ms, numpy as np
rng = np.random.default_rng(1)
map = ms.Map.from_image(rng.random((200, 200)) < 0.9, 1)
places = np.full((20_000_000, 2), 3.7)
print("asks", flush=True)
try:
    map.clearance(places)
except KeyboardInterrupt:
    print("interrupted")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert process.stdout.readline() == "asks\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=30)[0] == "interrupted\n"


def test_many_places_are_answered_like_few(room):
    places = np.random.default_rng(2).uniform(-10, 410, (70_000, 2))
    few = [room.clearance(part) for part in np.split(places, 7)]
    np.testing.assert_array_equal(room.clearance(places), np.concatenate(few))
    few = [room.is_free(part, 20) for part in np.split(places, 7)]
    np.testing.assert_array_equal(room.is_free(places, 20), np.concatenate(few))


def test_images_of_every_kind_give_the_same_map(room):
    image = np.full((40, 40), True)
    image[10:, 18:22] = False
    grey = np.where(image, 128, 127).astype(np.uint8)
    places = np.random.default_rng(1).uniform(0, 400, (200, 2))
    wide = np.repeat(np.where(image, 200.0, 3.0), 2, axis=1)[:, ::2]
    assert not wide.flags["C_CONTIGUOUS"]
    maps = [
        ms.Map.from_image(image, 10),
        ms.Map.from_image(~image, 10, free="dark"),
        ms.Map.from_image(wide, 10, threshold=128),
        ms.Map.from_image(np.asfortranarray(image), 10),
        ms.Map.from_image(image.astype(int), 10, threshold=1),
        ms.Map.from_image(grey, 10),
        *(ms.Map.from_image(image.astype(kind), 10) for kind in (np.uint8, int, float)),
    ]
    for one in maps:
        assert np.array_equal(one.clearance(places), room.clearance(places))


def test_an_image_of_one_kind_of_pixels_is_refused_or_told():
    labels = np.array([[0, 1, 2]], np.uint8)
    mask = labels.clip(0, 1)
    grey = np.array([[60, 200]], np.uint8)
    for image, values in ((labels, {}), (mask, {"threshold": 128}), (grey, {"threshold": 300}), (grey > 255, {}), (grey, {"free": "dark", "threshold": 0})):
        with pytest.raises(ms.InputError, match="all of image is wall"):
            ms.Map.from_image(image, 1, **values)
    for image, values in ((grey.astype(np.uint16) * 257, {"threshold": 128}), (grey > 0, {})):
        with pytest.warns(FutureWarning, match="no walls"):
            ms.Map.from_image(image, 1, **values)


def test_a_grey_array_is_the_map_of_its_file(tmp_path):
    grey = np.full((60, 80), 200, dtype=np.uint8)
    grey[9:, 37:42] = 20  # dark, not black
    (tmp_path / "grey.pgm").write_bytes(b"P5 80 60 255\n" + grey.tobytes())
    for map in (ms.Map.load(tmp_path / "grey.pgm", 10), ms.Map.from_image(grey, 10)):
        assert ms.plan(map, (50, 50), (750, 50), clearance_um=15).length_um == pytest.approx(1206, abs=1)


def test_a_grey_maze_has_the_walls_of_its_file(tmp_path):
    maze = np.pad(np.random.default_rng(1).random((28, 38)) < 0.8, 1)
    grey = np.where(maze, 200, 20).astype(np.uint8)
    (tmp_path / "maze.pgm").write_bytes(b"P5 40 30 255\n" + grey.tobytes())
    np.savetxt(tmp_path / "maze.csv", grey, delimiter=",", fmt="%d")
    for one in (grey, tmp_path / "maze.pgm"):
        assert np.array_equal(free_cells(one), maze)
    for one in (grey.astype(float), grey.astype(int), tmp_path / "maze.csv"):
        with pytest.raises(ms.InputError, match="neither a mask"):
            free_cells(one)


@pytest.mark.parametrize(
    "image, um_per_px, words",
    [
        (np.zeros(5), 1, "2 dimensions"),
        (np.zeros((5, 5, 3)), 1, "2 dimensions"),
        (np.zeros((0, 5), bool), 1, "must be 1 to"),
        (np.array([["a"]]), 1, "numbers"),
        (np.full((3, 3), np.nan), 1, "finite"),
        (np.full((3, 3), 0.5), 1, "threshold is missing"),
        (np.full((3, 3), 200.0), 1, "threshold is missing"),
        (np.full((3, 3), 200), 1, "threshold is missing"),
        (None, 1, "2 dimensions"),
        ([[1, 2], [3]], 1, r"image is \[\[1, 2\], \[3\]\], must be an array"),
        (np.broadcast_to(np.True_, (100_000, 100_000)), 1, "a side must be 1 to 65535"),
        (np.ones((3, 3), bool), 10**400, "um_per_px is 1000.*…, must be finite"),
        (np.ones((3, 3), bool), 0, "um_per_px"),
        (np.ones((3, 3), bool), np.nan, "um_per_px"),
    ],
)
def test_bad_images(image, um_per_px, words):
    with pytest.raises(ms.InputError, match=words):
        ms.Map.from_image(image, um_per_px)


def test_bad_places(room):
    for places in ([1, 2], np.zeros((3, 3)), 5, [[1, 2], [3]], [["a", "b"]], np.zeros((3, 2), complex)):
        with pytest.raises(ms.InputError, match="shape"):
            room.clearance(places)
    assert room.clearance(np.empty((0, 2))).shape == (0,)
    assert room.clearance([[np.nan, 1]]).tolist() == [0]


@pytest.mark.parametrize("planner", ms.planners)
def test_every_planner_finds_the_way_around(room, planner):
    path = ms.plan(room, (50, 50), (350, 50), planner, clearance_um=15)
    assert path.solved and path.status == "solved" and path.why_none == ""
    assert path.planner["type"] == planner and path.planner["clearance_um"] == 15
    assert path.points_um[0].tolist() == [50, 50]
    shortest = ms.plan(room, (50, 50), (350, 50), clearance_um=15).length_um
    # All but the exact planner end within the tolerance.
    assert path.length_um + path.planner["goal_tolerance_um"] >= (1 - 1e-9) * shortest
    assert room.is_free(path.points_um, 14.9).all()


def test_equal_seeds_give_equal_paths(room):
    paths = [ms.plan(room, (50, 50), (350, 50), "rrt_star", seed=seed).points_um for seed in (1, 1, 2)]
    assert np.array_equal(paths[0], paths[1])
    assert not np.array_equal(paths[0], paths[2])


def test_what_cannot_be_planned(room):
    for start, goal, values, words in [
        ((200, 50), (350, 50), {}, "start"),
        ((50, 50), (5000, 50), {}, "outside"),
        ((50,), (350, 50), {}, r"start is \(50,\), must be"),
        ((50, 50), (350, np.nan), {}, "finite"),
        ((50, 50, np.nan), (350, 50), {}, "finite"),
        ((50, 50, -np.inf), (350, 50), {}, "finite"),
        ((10**400, 50), (350, 50), {}, "start is"),
        ((50, 50), (350, 50), {"planner": "magic"}, "allowed"),
        ((50, 50), (350, 50), {"planner": "rrt", "stpe_um": 5}, "did you mean 'step_um'"),
        ((50, 50), (350, 50), {"planner": "rrt", "max_nodes": -1}, "max_nodes"),
        ((50, 50), (350, 50), {"seed": -1}, "seed is -1"),
        ((50, 50), (350, 50), {"seed": 2**64}, "seed is"),
        ((50, 50), (350, 50), {"seed": None}, "seed is None"),
        ((50, 50), (350, 50), {"clearance_um=5 #": 1}, "no key"),
    ]:
        with pytest.raises(ms.InputError, match=words):
            ms.plan(room, start, goal, **values)
    with pytest.raises(ms.InputError, match="map is None, must be a Map"):
        ms.plan(None, (50, 50), (350, 50))
    limited = ms.plan(room, (50, 50), (350, 50), "rrt", max_nodes=3)
    assert not limited.solved and "max_nodes" in limited.why_none


def test_walls_are_given_and_given_back():
    wall = [(900, 0), (1000, 0), (1000, 600), (900, 600)]
    chip = ms.Map.from_walls((0, 0, 2000, 1000), [wall], [(500, 700, 80)])
    assert chip.bounds_um == (0, 0, 2000, 1000)
    assert chip.discs_um.tolist() == [[500, 700, 80]]
    assert {tuple(p) for p in chip.walls_um[0][0]} == {(float(x), float(y)) for x, y in wall}
    assert chip.clearance([(700, 300), (500, 900), (950, 10)]).tolist() == [200, 100, 0]
    again = ms.Map.from_walls(chip.bounds_um, [one[0] for one in chip.walls_um], chip.discs_um)
    assert repr(again) == repr(chip)
    backwards = np.asarray(wall, dtype=np.int32)[::-1]  # not contiguous, and clockwise
    assert ms.Map.from_walls((0, 0, 2000, 1000), [backwards]).clearance([(700, 300)])[0] == 200


@pytest.mark.parametrize(
    "bounds, walls, discs, told",
    [
        ((0, 0, 1), (), (), "bounds_um"),
        (None, (), (), "bounds_um"),
        ((0, 0, 0, 9), (), (), "bounds"),
        ((0, 0, np.nan, 9), (), (), "bounds"),
        ((0, 0, 9, 9), None, (), "walls_um"),
        ((0, 0, 9, 9), [(1, 2)], (), "walls_um"),
        ((0, 0, 9, 9), [[(1, 2), (3, 4)]], (), r"walls_um\[0\]"),
        ((0, 0, 9, 9), [[(1, 2), (3, np.nan), (5, 5)]], (), ""),
        ((0, 0, 9, 9), [["a"]], (), "walls_um"),
        ((0, 0, 9, 9), (), [(1, 2)], "discs_um"),
        ((0, 0, 9, 9), (), [(1, 2, -1)], "radius"),
        ((0, 0, 9, 9), (), [(1, 2, np.inf)], ""),
        ((0, 0, 9, 9), (), "abc", "discs_um"),
    ],
)
def test_walls_that_are_none_are_told(bounds, walls, discs, told):
    with pytest.raises(ms.InputError, match=told):
        ms.Map.from_walls(bounds, walls, discs)
