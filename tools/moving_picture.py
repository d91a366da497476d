#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a record as a moving picture: the whole way above, the swarm from near below.

    tools/moving_picture.py out/demo/run.h5 build/demo/retina.jpg 9 docs/pictures/demo.gif

Arguments: the record, the photograph that its map was made from, µm per pixel of the photograph, and the GIF to
write. Needs the Debian packages python3-h5py, python3-pil, python3-yaml, fonts-dejavu-core and ffmpeg.
Obstacles must be discs that stand still or follow waypoints.
"""

import argparse
import math
import pathlib
import subprocess
import sys

import h5py
import numpy as np
import yaml
from PIL import Image, ImageDraw, ImageEnhance, ImageFont

WIDTH, ABOVE, BELOW, GAP = 800, 250, 280, 6  # px
SMOOTH = 2  # drawn so many times larger, then made smaller
AROUND = 1400  # [µm] width of what is seen below
RATE, SECONDS, PAUSE = 12, 10, 1.5  # pictures a second; how long; standing still at the end
WALL, FREE, EDGE = (64, 26, 22), (246, 222, 196), (140, 70, 56)
SWARM, TRAIL, PLAN, OBSTACLE, GOAL, WHITE = (
    (20, 92, 214), (64, 150, 255), (30, 30, 30), (214, 40, 40), (24, 160, 72), (255, 255, 255))
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


def write(draw, at, text, anchor):
    """Bright letters that can be read on any ground."""
    draw.text(at, text, fill=WHITE, anchor=anchor, stroke_width=2 * SMOOTH, stroke_fill=WALL,
              font=ImageFont.truetype(FONT, 14 * SMOOTH))


def place_at(obstacle, t):
    """Where an obstacle of a scenario is at time t."""
    motion = obstacle["motion"]
    if motion["type"] == "still":
        return motion["position_um"]
    if motion["type"] != "waypoints":
        sys.exit(f"an obstacle's motion is {motion['type']}, must be still or waypoints")
    points = np.array(motion["points_um"], float)
    ends = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    way = motion["speed_um_per_s"] * t
    if motion["at_end"] == "loop":
        sys.exit("an obstacle's motion loops, must stay or come back")
    if motion["at_end"] == "back":
        way = way % (2 * ends[-1])
        way = min(way, 2 * ends[-1] - way)
    return [np.interp(way, ends, points[:, axis]) for axis in (0, 1)]


def walls_of(record):
    """Rings of every wall, its outline first, the largest wall first."""
    points = np.column_stack([record["map/walls/x_um"], record["map/walls/y_um"]])
    rings = record["map/walls/ring_offset"][:]
    walls = record["map/walls/wall_offset"][:]
    all_rings = [points[a:b] for a, b in zip(rings, rings[1:])]
    found = [all_rings[a:b] for a, b in zip(walls, walls[1:])]
    return sorted(found, key=lambda wall: -np.prod(np.ptp(wall[0], axis=0)))


class View:
    """A part of the world as a picture; x right, y up."""

    def __init__(self, left, top, um_per_px, width, height):
        self.left, self.top, self.scale = left, top, SMOOTH / um_per_px
        self.size = (width * SMOOTH, height * SMOOTH)

    def px(self, points):
        points = np.atleast_2d(points)
        return [tuple(p) for p in (points - (self.left, self.top)) * (self.scale, -self.scale)]

    def disc(self, draw, at, radius_px, **look):
        x, y = self.px(at)[0]
        draw.ellipse((x - radius_px, y - radius_px, x + radius_px, y + radius_px), **look)

    def bar(self, draw, length_um, text):
        """A scale bar in the lower right corner."""
        right, bottom = self.size[0] - 12 * SMOOTH, self.size[1] - 12 * SMOOTH
        left = right - length_um * self.scale
        draw.line((left - SMOOTH, bottom, right + SMOOTH, bottom), fill=WALL, width=6 * SMOOTH)
        draw.line((left, bottom, right, bottom), fill=WHITE, width=3 * SMOOTH)
        write(draw, ((left + right) / 2, bottom - 5 * SMOOTH), text, "ms")


class Film:
    """What stays the same in all pictures of a record."""

    def __init__(self, record, photo, um_per_px):
        self.scenario = yaml.safe_load(record["scenario"][()])
        frames = {key: record[f"frames/{key}"][:] for key in ("t_s", "x_um", "y_um")}
        self.t, self.way = frames["t_s"], np.column_stack([frames["x_um"], frames["y_um"]])
        self.radius = record["frames/radius_um"][0]
        self.goal = self.scenario["goal_um"]
        self.walls = walls_of(record)
        self.plan_t, self.plan_at = record["paths/t_s"][:], record["paths/points/offset"][:]
        self.plans = np.column_stack([record["paths/points/x_um"], record["paths/points/y_um"]])
        self.above = self.overview(photo, um_per_px, record["map/bounds_um"][:])

    def overview(self, photo, um_per_px, bounds):
        """The photograph's part in which the swarm moves."""
        least, most = self.way.min(axis=0), self.way.max(axis=0)
        scale = max((most - least + 900) / (WIDTH, ABOVE))
        middle = (least + most) / 2
        left, top = middle[0] - scale * WIDTH / 2, middle[1] + scale * ABOVE / 2
        self.whole = View(left, top, scale, WIDTH, ABOVE)
        x, y = left / um_per_px, (bounds[3] - top) / um_per_px
        box = (x, y, x + WIDTH * scale / um_per_px, y + ABOVE * scale / um_per_px)
        with Image.open(photo) as picture:
            part = picture.convert("RGB").transform(self.whole.size, Image.Transform.EXTENT, box,
                                                    Image.BICUBIC)
        return ImageEnhance.Brightness(part).enhance(0.8)

    def at(self, t):
        return np.array([np.interp(t, self.t, self.way[:, axis]) for axis in (0, 1)])

    def trail(self, t):
        return np.vstack([self.way[self.t < t], self.at(t)])

    def draw_above(self, t, near):
        image = self.above.copy()
        draw = ImageDraw.Draw(image)
        draw.line(self.whole.px(self.trail(t)), fill=TRAIL, width=3 * SMOOTH, joint="curve")
        self.whole.disc(draw, self.goal, 7 * SMOOTH, outline=WHITE, fill=GOAL, width=SMOOTH)
        corner = (near.left + AROUND, near.top - AROUND * BELOW / WIDTH)
        corners = self.whole.px([(near.left, near.top), corner])
        draw.rectangle([*corners[0], *corners[1]], outline=WHITE, width=SMOOTH)
        self.whole.disc(draw, self.at(t), 5 * SMOOTH, outline=WHITE, fill=SWARM, width=SMOOTH)
        self.whole.bar(draw, 1000, "1 mm")
        return image

    def draw_below(self, t, near):
        image = Image.new("RGB", near.size, FREE)
        draw = ImageDraw.Draw(image)
        for outline, *holes in self.walls:
            draw.polygon(near.px(outline), fill=WALL, outline=EDGE)
            for hole in holes:
                draw.polygon(near.px(hole), fill=FREE, outline=EDGE)
        draw.line(near.px(self.trail(t)), fill=TRAIL, width=3 * SMOOTH, joint="curve")
        now = np.searchsorted(self.plan_t, t, side="right") - 1
        if now >= 0 and t < self.t[-1]:
            plan = self.plans[self.plan_at[now]:self.plan_at[now + 1]]
            draw.line(near.px(plan), fill=PLAN, width=round(1.5 * SMOOTH))
        for obstacle in self.scenario["obstacles"]:
            radius = obstacle["shape"]["radius_um"] * near.scale
            near.disc(draw, place_at(obstacle, t), radius, fill=OBSTACLE, outline=WHITE, width=SMOOTH)
        tolerance = self.scenario["goal_tolerance_um"] * near.scale
        near.disc(draw, self.goal, tolerance, outline=GOAL, width=2 * SMOOTH)
        near.disc(draw, self.at(t), self.radius * near.scale, fill=SWARM, outline=WHITE, width=SMOOTH)
        near.bar(draw, 100, "100 µm")
        write(draw, (12 * SMOOTH, near.size[1] - 10 * SMOOTH), f"{t:.0f} s", "ls")
        return image

    def picture(self, t):
        scale = AROUND / WIDTH
        # The view follows the mean of the way around t, so that it does not shake.
        middle = np.mean([self.at(time) for time in np.linspace(t - 1.5, t + 1.5, 21)], axis=0)
        near = View(middle[0] - AROUND / 2, middle[1] + scale * BELOW / 2, scale, WIDTH, BELOW)
        image = Image.new("RGB", (WIDTH, ABOVE + GAP + BELOW), WHITE)
        image.paste(self.draw_above(t, near).resize((WIDTH, ABOVE), Image.LANCZOS), (0, 0))
        image.paste(self.draw_below(t, near).resize((WIDTH, BELOW), Image.BOX), (0, ABOVE + GAP))
        return image


def write_gif(pictures, file):
    """All pictures with one palette."""
    size = f"{WIDTH}x{ABOVE + GAP + BELOW}"
    palette = ("split[a][b];[a]palettegen=max_colors=128:stats_mode=full[p];"
               "[b][p]paletteuse=dither=none:diff_mode=rectangle")
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size,
               "-r", str(RATE), "-i", "-", "-vf", palette, "-loop", "0", str(file)]
    data = b"".join(picture.tobytes() for picture in pictures)
    subprocess.run(command, input=data, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", type=pathlib.Path)
    parser.add_argument("photo", type=pathlib.Path)
    parser.add_argument("um_per_px", type=float)
    parser.add_argument("gif", type=pathlib.Path)
    options = parser.parse_args()
    with h5py.File(options.record) as record:
        film = Film(record, options.photo, options.um_per_px)
    times = np.linspace(0, film.t[-1], math.ceil(SECONDS * RATE))
    pictures = [film.picture(t) for t in times]
    pictures += [pictures[-1]] * round(PAUSE * RATE)
    write_gif(pictures, options.gif)
    print(f"{options.gif}: {len(pictures)} pictures, {options.gif.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
