# SPDX-License-Identifier: Apache-2.0
"""A path around a wall by D-RRT*."""

import sys

import microswarm as ms

wall = [(900, 0), (1000, 0), (1000, 600), (900, 600)]
chip = ms.Map.from_walls((0, 0, 2000, 1000), [wall])
found = ms.plan(chip, (200, 300), (1800, 300), "drrt_star", clearance_um=60, seed=42)  # from the swarm's centre

print(f"{found.status}: {found.length_um:.0f} µm in {len(found.points_um)} points, {len(found.tree_um)} nodes")
for x, y in found.points_um:
    print(f"{x:.1f},{y:.1f}")
sys.exit(0 if found.solved else 1)
