# SPDX-License-Identifier: Apache-2.0
"""Vessels in photographs, and robots in videos."""

from __future__ import annotations

import os
import warnings
from typing import Any, Iterable, Optional, Union

import numpy as np

from . import _core
from .maps import Map
from .runs import Progress, shown
from .values import InputError, array_of, number, path_text, refused, setting

PathLike = Union[str, "os.PathLike[str]"]


class Segmentation:
    """Vessels of a photograph.

    mask             vessels, as booleans of shape (height, width), the upper row first
    map              the Map, free in the vessels; the lower left corner of the picture is (0, 0), y points up
    field_of_view    area shown by the optics, like `mask`
    method           method that was taken, "lines" or "regions"
    polarity         polarity that was taken, "dark" or "bright"
    two_level_share  share of the variance that two greys explain: above 0.9 `regions` are taken; None if method= was given
    polarity_odds    evidence for the polarity over that for the other, 1 or more; None if polarity= was given
    vessel_share     area of the vessels, as a share of the field of view
    wide_width_um    width of the wide vessels
    pieces           connected networks, of which `kept_share` of the area was kept
    bridges          gaps that were closed
    """

    def __init__(self, made: dict[str, Any]) -> None:
        self.map = Map(made["map"])
        self.mask: np.ndarray = made["mask"]
        self.field_of_view: np.ndarray = made["field_of_view"]
        self.method: str = made["method"]
        self.polarity: str = made["polarity"]
        self.two_level_share: Optional[float] = made["two_level_share"]
        self.polarity_odds: Optional[float] = made["polarity_odds"]
        self.vessel_share: float = made["vessel_share"]
        self.wide_width_um: float = made["wide_width_um"]
        self.pieces: int = made["pieces"]
        self.kept_share: float = made["kept_share"]
        self.bridges: int = made["bridges"]

    def __repr__(self) -> str:
        return f"<Segmentation by {self.method}, {self.polarity}: vessels cover {100 * self.vessel_share:.3g} %, wide ones {self.wide_width_um:.4g} µm>"


def segment(image: Any, um_per_px: float, *, smooth_px: float = 1.0, **values: Any) -> Segmentation:
    """Finds the vessels of a photograph, like `microswarm map segment`.

    image       array of uint8 or uint16 of shape (height, width) or (height, width, 3) with red, green, blue, the
                upper row first, or the name of a file. 16-bit numbers have as many bits as the largest one needs.
    um_per_px   side of a pixel, 1e-6 to 1e6
    smooth_px   tolerance of the outlines, 0 to 100
    values      values of `map segment --set`: method="lines", polarity="dark", min_width_px=6, keep="all", …

    InputError if no vessels are found.
    """
    settings = [setting(key, value) for key, value in values.items()]
    source: Any = path_text(image, "image") if isinstance(image, (str, os.PathLike)) else picture_of("image", image)
    scale = in_range("um_per_px", um_per_px, 1e-6, 1e6)
    return Segmentation(_core.segment(source, scale, in_range("smooth_px", smooth_px, 0, 100), settings))


def channel_graph(map: Map, cell_um: float = 0) -> tuple[np.ndarray, np.ndarray]:
    """Skeleton of a map's channels with lengths and widths, like `microswarm map graph`.

    cell_um   resolution; 0: a million cells. Channels narrower than three cells may be cut.

    Returns branches and nodes as structured arrays, which pandas.DataFrame accepts. Branches: branch and its nodes
    node_a, node_b, numbered from 1; network, the connected part; type as in skan, 0 end to end, 1 junction to end,
    2 junction to junction, 3 closed; length_um, straight_um, mean_width_um, min_width_um, max_width_um,
    narrowest_x_um, narrowest_y_um. Nodes: node, network, degree, x_um, y_um, width_um.
    """
    if not isinstance(map, Map):
        raise refused("map", map, "a Map")
    branches, nodes = _core.channel_graph(map._core, in_range("cell_um", cell_um, 0, 1e6))
    return structured(branches), structured(nodes)


def track(
    frames: Union[np.ndarray, Iterable[Any], PathLike],
    um_per_px: Optional[float] = None,
    fps: Optional[float] = None,
    *,
    times_s: Any = None,
    return_events: bool = False,
    progress: Progress = None,
    **values: Any,
) -> Any:
    """Finds robots in pictures and tracks them, like `microswarm track`.

    frames         array of shape (n, height, width) or (n, height, width, 3), any iterable of such pictures,
                   which are held one at a time, or the name of a video, folder of pictures or TIFF. Pictures are
                   uint8, or uint16, whose numbers have as many bits as the first picture needs, or `depth`.
                   Or the name of a table, whose tracks are taken, and whose positions are linked where it has none:
                   CSV of trackpy, CSV or XML of TrackMate, or tracks.csv.
    um_per_px      side of a pixel, 1e-6 to 1e6; default: what ImageJ or OME wrote into a TIFF
    fps            frame rate [Hz]; default: the times of the file, or of the table that `rig run --video` wrote beside
                   it
    times_s        time of each picture [s], ascending, instead of fps, or for a file the name of a table of them:
                   one a line, or a column t_s
    return_events  return (tracks, events)
    progress       called with the completed share; False: nothing is shown
    values         values of `track --set`, with or without their group: diameter_px=11, min_mass=40, tone="bright",
                   channel="red", memory=5, search_range_um=4, stack_channel=2 and slice=1 of a TIFF that holds
                   several, or find={"diameter_px": 11}. search_range_um is the farthest that a robot moves from
                   picture to picture; fast ones need it. region={"x_px": 10, "y_px": 0, "width_px": 300,
                   "height_px": 200} tracks in a part of the pictures

    What was assumed in reading a file is a warning.

    Returns a structured array with a row for each robot in each picture, ordered by pictures, which pandas.DataFrame
    accepts. Columns as trackpy's: frame and particle, from 0; x and y in pixels, where y points down and (0, 0) is the
    centre of the upper left pixel; mass, signal. Columns as those of tracks.csv: x_um and y_um, where y points up and
    (0, 0) is the lower left corner of the picture; t_s, vx_um_per_s, vy_um_per_s, radius_um, eccentricity. `mass` and
    `signal` are grey values of 8 bits. Events have frame, event ("birth", "death", "merge", "split"), particle and
    other, -1 without.
    """
    is_file = isinstance(frames, (str, os.PathLike))
    if times_s is not None and fps is not None:
        raise InputError("fps and times_s are both given")
    table = path_text(times_s, "times_s") if is_file and isinstance(times_s, (str, os.PathLike)) else ""
    times = None if times_s is None or table else ascending(times_s)
    if times is not None:
        fps = (len(times) - 1) / (times[-1] - times[0])
    settings = track_settings(values)
    if um_per_px is not None:
        settings.insert(0, setting("um_per_px", in_range("um_per_px", um_per_px, 1e-6, 1e6)))
    elif not is_file:
        raise InputError("um_per_px is missing: arrays state no scale")
    if fps is not None:
        settings.append(setting("rate_hz", in_range("fps", fps, 1e-6, 1e6)))
    with shown(progress) as report:
        if is_file:
            made = _core.track_file(path_text(frames, "frames"), settings, table, report)
            if made["ended"]:
                warnings.warn(f"the tracks end at picture {made['frames']}: {made['ended']}", stacklevel=2)
        elif fps is None:
            raise InputError("fps is missing, or times_s: arrays state no times")
        else:
            made = track_arrays(frames, settings, report, times)
    if times is not None and len(times) != made["frames"]:
        raise InputError(f"times_s has {len(times)} times, there are {made['frames']} pictures")
    for note in made["notes"]:
        warnings.warn(note, stacklevel=2)
    if made["is_noise"]:
        warnings.warn(
            "most tracks are one picture long: noise may be taken for robots, raise min_mass; or robots move more than "
            f"the search range of {made['search_range_um']:.4g} µm a picture, give search_range_um",
            stacklevel=2,
        )
    if made["unsettled"]:
        warnings.warn(f"{made['unsettled']} features did not settle on their centroids", stacklevel=2)
    tracks = tracks_of(made)
    if times is not None:
        tracks["t_s"] = times[tracks["frame"]]
    return (tracks, structured(made["events"])) if return_events else tracks


def track_arrays(frames: Any, settings: list[tuple[str, str]], report: Any, times: Optional[np.ndarray]) -> dict[str, Any]:
    """Tracks pictures in memory one by one."""
    if isinstance(frames, np.ndarray) and (frames.ndim not in (3, 4) or (frames.ndim == 3 and frames.shape[2] == 3)):
        raise InputError(f"frames has the shape {frames.shape}, must be (n, height, width) or (n, height, width, 3)")
    count = len(frames) if hasattr(frames, "__len__") else None
    if times is not None and count is not None and len(times) != count:
        raise InputError(f"times_s has {len(times)} times, there are {count} pictures")
    try:
        pictures = iter(frames)
    except TypeError:
        raise refused("frames", frames, "an array, an iterable of arrays or a file") from None
    tracker = _core.ArrayTracker(settings)
    done = 0
    for done, frame in enumerate(pictures, 1):
        if times is not None and done > len(times):
            raise InputError(f"times_s has {len(times)} times, there are more pictures")
        tracker.step(picture_of(f"frame {done - 1}", frame), None if times is None else times[done - 1])
        if report and count:
            report(min(1.0, done / count))
    if done == 0:
        raise InputError("frames has no pictures")
    return tracker.finish()


def track_settings(values: dict[str, Any]) -> list[tuple[str, str]]:
    """Settings of the values; a key without a group gets its group."""
    keys = {key.rpartition(".")[2]: key for key in _core.track_keys()}
    for own in ("um_per_px", "rate_hz"):
        if own in values:
            raise InputError(f"{own} is an argument of its own" + (", fps" if own == "rate_hz" else ""))
    settings = []
    for key, value in values.items():
        if isinstance(value, dict):
            settings += [setting(f"{key}.{inner}", one) for inner, one in value.items()]
        else:
            settings.append(setting(keys.get(key, key if key in ("find", "track") else f"find.{key}"), value))
    return settings


def tracks_of(made: dict[str, Any]) -> np.ndarray:
    """The rows of a result as a structured array, trackpy's columns first."""
    rows = dict(made["rows"])
    rows.pop("id")  # equals particle
    columns = {key: rows.pop(key) for key in ("frame", "particle", "x", "y", "x_um", "y_um", "t_s")}
    return structured({**columns, **rows})


def structured(columns: dict[str, np.ndarray]) -> np.ndarray:
    """Columns of equal length as a structured array."""
    array = np.empty(len(next(iter(columns.values()))), dtype=[(key, column.dtype) for key, column in columns.items()])
    for key, column in columns.items():
        array[key] = column
    return array


def picture_of(name: str, image: Any) -> np.ndarray:
    """Checks a picture; returns a contiguous array of uint8 or uint16."""
    array = array_of(name, image, "an array of uint8 or uint16", kinds="buifc")
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[:, :, 0]
    if array.ndim != 2 and not (array.ndim == 3 and array.shape[2] == 3):
        raise InputError(f"{name} has the shape {array.shape}, must be (height, width) or (height, width, 3)")
    if array.dtype != bool and (array.dtype.kind != "u" or array.dtype.itemsize > 2):
        raise InputError(f"{name} is of {array.dtype}, must be of uint8 or uint16")
    _core.check_image_size(array.shape[1], array.shape[0], name)
    if array.dtype == bool:
        array = array * np.uint8(255)
    return np.ascontiguousarray(array, dtype=np.uint8 if array.dtype.itemsize == 1 else np.uint16)


def in_range(name: str, value: Any, least: float, most: float) -> float:
    """Checks a number within limits."""
    made = number(name, value)
    if not least <= made <= most:
        raise InputError(f"{name} is {made:g}, must be {least:g} to {most:g}")
    return made


def ascending(times_s: Any) -> np.ndarray:
    """Checks two or more ascending times."""
    try:
        times = np.asarray(times_s, dtype=float)
    except (TypeError, ValueError):
        times = np.empty(0)
    if times.ndim != 1 or len(times) < 2 or not np.isfinite(times).all() or not (np.diff(times) > 0).all():
        raise InputError("times_s must be at least two times that ascend")
    return times
