#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the samples in this folder: a small synthetic file for each kind of real input.

The answers beside them (shortest paths, fields, positions) are worked out here, without the library.
Runs on Python alone and writes the same bytes every time: `tests/samples/make_samples.py`.
"""

import heapq
import math
import random
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent


def write(name, content):
    path = HERE / name
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def png(rows, depth=8):
    """Greyscale PNG of rows of numbers; depth 1 or 8."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    def packed(row):
        if depth == 8:
            return bytes(row)
        bits = "".join(str(v) for v in row).ljust((len(row) + 7) // 8 * 8, "0")
        return bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8))

    data = b"".join(b"\0" + packed(row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), depth, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 9))
            + chunk(b"IEND", b""))


def pgm(rows):
    header = f"P5\n{len(rows[0])} {len(rows)}\n255\n".encode()
    return header + b"".join(bytes(row) for row in rows)


def to_segment(x, y, a, b):
    (ax, ay), (bx, by) = a, b
    t = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)
    t = min(1, max(0, t))
    return math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay))


def vessels():
    """A photograph of dark vessels in a bright round field, and the mask of the vessels."""
    side, rng = 200, random.Random(1)
    tree = [((30, 100), (75, 95), 5.0), ((75, 95), (120, 70), 4.0), ((120, 70), (160, 50), 3.0),
            ((75, 95), (110, 130), 4.0), ((110, 130), (155, 140), 3.0), ((110, 130), (115, 175), 3.0),
            ((120, 70), (105, 30), 3.0)]
    photo, mask = [], []
    for y in range(side):
        photo.append([])
        mask.append([])
        for x in range(side):
            in_view = math.hypot(x - 99.5, y - 99.5) < 95
            depth = max(w - to_segment(x, y, a, b) for a, b, w in tree)
            vessel = in_view and depth > 0
            light = 150 + 0.15 * x - 0.1 * y
            grey = light * (1 - 0.35 * min(1, max(0, depth + 0.5))) + 2 * rng.randint(-1, 1)
            photo[-1].append(round(grey) if in_view else 3)
            mask[-1].append(int(vessel))
    write("vessels/retina.png", png(photo))
    write("vessels/retina_mask.png", png(mask, depth=1))


def walkers():
    """Tracks in the columns of the UCY set: frame, id, x, z, y, vx, vz, vy; a row a second."""
    rng, rows = random.Random(2), []
    for walker in range(1, 17):
        begin, speed = 25 * rng.randint(0, 24), rng.uniform(0.9, 1.4)
        x, y = -7.5, rng.uniform(5, 21)
        direction = rng.uniform(-0.3, 0.3)
        if walker % 2 == 0:
            x, direction = 7.0, math.pi - direction
        vx, vy = speed * math.cos(direction), speed * math.sin(direction)
        for second in range(int(14 / speed)):
            rows.append((begin + 25 * second, walker, x + vx * second, 0, y + vy * second, vx, 0, vy))
    write("walkers.txt", "".join(" ".join(f"{v:.4f}".rstrip("0").rstrip(".") for v in row) + "\n"
                                 for row in rows))


def octile_distances(grid, start):
    """Shortest ways from a cell: diagonals cost √2 and cut no corner."""
    height, width = len(grid), len(grid[0])
    best, queue = {start: 0.0}, [(0.0, start)]
    while queue:
        d, (x, y) = heapq.heappop(queue)
        if d > best[x, y]:
            continue
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                u, v = x + dx, y + dy
                if (dx, dy) == (0, 0) or not (0 <= u < width and 0 <= v < height):
                    continue
                if "@" in (grid[v][u], grid[y][u], grid[v][x]):
                    continue
                step = d + math.hypot(dx, dy)
                if step < best.get((u, v), math.inf) - 1e-12:
                    best[u, v] = step
                    heapq.heappush(queue, (step, (u, v)))
    return best


def grid_map():
    """A MovingAI map with queries and the lengths of their shortest paths."""
    rng, width, height = random.Random(3), 32, 24
    grid = [["."] * width for _ in range(height)]
    for _ in range(14):
        x, y = rng.randrange(width - 4), rng.randrange(height - 3)
        w, h = rng.choice([(1, 6), (7, 1), (3, 2), (2, 2)])
        for v in range(y, min(height, y + h)):
            for u in range(x, min(width, x + w)):
                grid[v][u] = "@"
    free = [(x, y) for y in range(height) for x in range(width) if grid[y][x] == "."]
    queries = []
    while len(queries) < 20:
        start, goal = rng.choice(free), rng.choice(free)
        length = octile_distances(grid, start).get(goal)
        if length:
            queries.append((length, start, goal))
    queries.sort()
    text = "".join("".join(row) + "\n" for row in grid)
    write("blocks.map", f"type octile\nheight {height}\nwidth {width}\nmap\n{text}")
    write("blocks.map.scen", "version 1\n" + "".join(
        f"{int(length) // 4}\tblocks.map\t{width}\t{height}\t{s[0]}\t{s[1]}\t{g[0]}\t{g[1]}\t"
        f"{length:.8f}\n" for length, s, g in queries))


def ros_map():
    """Free rooms, walls, and a corner that nobody has seen."""
    rows = [[254] * 40 for _ in range(30)]
    for y in range(30):
        for x in range(40):
            if x in (0, 39) or y in (0, 29) or (x == 20 and not 12 <= y <= 16):
                rows[y][x] = 0
            elif x > 33 and y > 23:
                rows[y][x] = 205
    write("rooms.pgm", pgm(rows))
    write("rooms.yaml", "image: rooms.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.0, -0.5, 0]\n"
                        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")


def maze():
    """A maze of channels 8 px wide with a dead end for a goal, one pixel a cell, white is free."""
    plan = ["#########", "#.......#", "#.#.###.#", "#.#...#.#", "#.###.#.#", "#...#...#", "#########"]
    rows = []
    for line in plan:
        row = [0 if c == "#" else 255 for c in line for _ in range(8)]
        rows += [row] * 8
    write("maze.pgm", pgm(rows))


def veins():
    """Rectangular walls, x, y, width and height."""
    walls = [(0, 0, 200, 10), (0, 110, 200, 10), (0, 0, 10, 120), (190, 0, 10, 120),
             (60, 10, 10, 55), (60, 85, 10, 25), (110, 35, 10, 75), (150, 10, 10, 60)]
    write("veins.csv", "x_um,y_um,width_um,height_um\n"
          + "".join(",".join(map(str, wall)) + "\n" for wall in walls))


# Coils as sources of potentials Ψ = Σ (A_n rⁿ + B_n / rⁿ⁺¹) P_n(cos θ), here up to n = 2.
COILS = {
    "Left": [((-0.06, 0, 0), (1, 0, 0), [], [2.1e-6, 4e-9])],
    "Right": [((0.06, 0.01, 0), (-0.8, 0.6, 0), [0, 2e-3], [1.8e-6]),
              ((0.01, 0.05, 0.02), (0, 0.6, 0.8), [1e-4], [])],
    "Below": [((0, 0, -0.05), (0, 0, 1), [], [3e-6, -6e-9])],
}


def potential(sources, p):
    total = 0.0
    for position, direction, grow, decay in sources:
        d = [p[i] - position[i] for i in range(3)]
        r = math.sqrt(sum(v * v for v in d))
        c = sum(d[i] * direction[i] for i in range(3)) / r
        legendre = [c, 1.5 * c * c - 0.5]
        total += sum(a * r ** (n + 1) * legendre[n] for n, a in enumerate(grow))
        total += sum(b / r ** (n + 2) * legendre[n] for n, b in enumerate(decay))
    return total


def derivative(function, p, axis, h=4e-4):
    """Central differences of the sixth order."""
    def at(steps):
        q = list(p)
        q[axis] += steps * h
        return function(q)
    return (45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + at(3) - at(-3)) / (60 * h)


def field(sources, p):
    return [-derivative(lambda q: potential(sources, q), p, i) for i in range(3)]


def coils():
    """A calibration as multipoles with fields worked out from its potential, and grids of it."""
    text = "System_Name: sample\nCoil_List: [Left, Right, Below]\n"
    for name, sources in COILS.items():
        names = [f"Src_{i}" for i in range(len(sources))]
        text += f"{name}:\n  Source_List: [{', '.join(names)}]\n"
        for source, (position, direction, grow, decay) in zip(names, sources):
            text += (f"  {source}:\n    A_Coeff: {grow or '~'}\n    B_Coeff: {decay or '~'}\n"
                     f"    Source_Direction: {list(direction)}\n"
                     f"    Source_Position: {list(position)}\n")
    text += "Workspace_Dimensions: [[-0.01, 0.01], [-0.01, 0.01], [-0.005, 0.01]]\n"
    write("coils/coils.yaml", text)

    rng = random.Random(4)
    rows = ["px_m,py_m,pz_m,I0_A,I1_A,I2_A,Bx_T,By_T,Bz_T,dBxdx,dBxdy,dBxdz,dBydy,dBydz,in_ws"]
    for i in range(32):
        p = [0, 0, 0] if i == 0 else [round(rng.uniform(-0.012, 0.012), 5) for _ in range(3)]
        currents = [1, 0, 0] if i == 0 else [round(rng.uniform(-5, 5), 3) for _ in range(3)]

        def total(q):
            return sum(c * potential(s, q) for c, s in zip(currents, COILS.values()))
        b = [-derivative(total, p, k) for k in range(3)]
        gradient = [-derivative(lambda q: derivative(total, q, k), p, j)
                    for k, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2))]
        inside = int(all(abs(v) <= 0.01 for v in p) and p[2] >= -0.005)
        rows.append(",".join([*map(str, p), *map(str, currents),
                              *(f"{v:.10e}" for v in (*b, *gradient)), str(inside)]))
    write("coils/coils.expected_fields.csv", "\n".join(rows) + "\n")

    for name, sources in COILS.items():
        text = "27\n3 3 3\n" + 3 * "-0.005 0.005\n"
        for i in range(27):
            p = [0.005 * (i // 9 - 1), 0.005 * (i // 3 % 3 - 1), 0.005 * (i % 3 - 1)]
            text += " ".join(f"{v:.6g}" for v in (*p, *field(sources, p))) + "\n"
        write(f"coils/{name}.txt", text)


def video():
    """Bright robots that drift, and where each one is."""
    rng, width, height = random.Random(5), 96, 72
    robots = [[rng.uniform(15, 80), rng.uniform(12, 60)]]
    while len(robots) < 6:
        p = [rng.uniform(15, 75), rng.uniform(12, 58)]
        if all(math.dist(p, q) > 16 for q in robots):
            robots.append(p)
    table = ["frame,particle,x,y"]
    for frame in range(8):
        rows = []
        for y in range(height):
            rows.append([])
            for x in range(width):
                spots = sum(90 * math.exp(-((x - u) ** 2 + (y - v) ** 2) / (2 * 1.9 ** 2))
                            for u, v in robots)
                rows[-1].append(round(60 + spots + rng.randint(-1, 1)))
        write(f"video/robots_{frame:03}.png", png(rows))
        for i, p in enumerate(robots):
            table.append(f"{frame},{i},{p[0]:.4f},{p[1]:.4f}")
            angle = 0.5 + 0.1 * i
            p[0] += 0.9 * math.cos(angle) + rng.uniform(-0.2, 0.2)
            p[1] += 0.5 * math.sin(angle) + rng.uniform(-0.2, 0.2)
    write("video_positions.csv", "\n".join(table) + "\n")


def rig_pictures():
    """What a rig's camera sees: a dark swarm on a bright ground, and a chessboard of 9 x 6 inner corners."""
    rng, width, height = random.Random(6), 160, 120

    def noise():
        return rng.randint(-2, 2)

    rows = [[(60 if math.hypot(x - 90, y - 55) <= 17 + 3 * rng.random() else 200) + noise() for x in range(width)]
            for y in range(height)]
    write("rig/frame.png", png(rows))
    rows = [[(40 if 20 <= x < 220 and 20 <= y < 160 and ((x - 20) // 20 + (y - 20) // 20) % 2 == 0 else 215) + noise()
             for x in range(240)] for y in range(180)]
    write("rig/grid.png", png(rows))


def measured():
    """Readings of three pairs of coils that stand a little askew."""
    table = ["i_x_a,i_y_a,i_z_a,bx_mt,by_mt,bz_mt"]
    for coil in range(3):
        for current in (-2.0, -1.0, 0.0, 1.0, 2.0):
            i = [current if k == coil else 0.0 for k in range(3)]
            b = [0.9 * i[k] + 0.05 * i[(k + 1) % 3] for k in range(3)]
            table.append(",".join(f"{v:.4f}" for v in i + b))
    write("coils/measured.csv", "\n".join(table) + "\n")


if __name__ == "__main__":
    for make in (vessels, walkers, grid_map, ros_map, maze, veins, coils, video, rig_pictures, measured):
        make()
