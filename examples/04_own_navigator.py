# SPDX-License-Identifier: Apache-2.0
"""A navigator of one's own in the loop, with metrics and a record like any other."""

import math
import sys
from typing import Any, Optional

import microswarm as ms


class Repelled:
    """Heads for the goal and turns aside from what is near, by the inverse of the distance."""

    def __init__(self, goal: tuple[float, float]) -> None:
        self.goal = goal

    def step(self, seen: Any) -> Optional[tuple[float, float]]:
        if seen.swarm is None:
            return None  # never drive on when unsure
        x, y, _, radius = seen.swarm
        to_x, to_y = self.goal[0] - x, self.goal[1] - y
        distance = math.hypot(to_x, to_y)
        to_x, to_y = to_x / distance, to_y / distance
        for disc_x, disc_y, disc_radius in seen.obstacles_um:
            away = math.hypot(x - disc_x, y - disc_y)
            gap = away - disc_radius - radius
            if gap < 200:
                push = 100 / (gap + 20) / away
                to_x, to_y = to_x + push * (x - disc_x), to_y + push * (y - disc_y)
        return math.atan2(to_y, to_x), 60  # heading [rad], speed [µm/s]


scenario = ms.Scenario.from_text(
    """
map: {type: polygons, hi_um: [2000, 1000]}
start: {x_um: 200, y_um: 500}
goal_um: [1800, 500]
obstacles:
  - shape: {type: disc, radius_um: 80}
    motion: {type: harmonic_line, centre_um: [900, 560], amplitude_um: [0, 200]}
"""
)
record = ms.run(scenario, navigator=Repelled(scenario.goal_um))
metrics = record.metrics
print(
    f"{record.status} after {metrics['time_s']:.1f} s, "
    f"nearest obstacle {metrics['obstacles_clearance_um']:.1f} µm from the centre, {metrics['contacts']} contacts"
)
record.save("04_own_navigator.h5")
sys.exit(0 if record.solved else 3)
