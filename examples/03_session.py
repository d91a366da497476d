# SPDX-License-Identifier: Apache-2.0
"""Steps a session, changes it between two ticks, and repeats what was recorded."""

import os
import sys
from typing import Any

import microswarm as ms


def change(session: ms.Session, key: str, value: Any) -> None:
    try:
        session.set(key, value)
    except ms.InputError as error:
        print("refused:", error)


folder = os.environ.get("MICROSWARM_SCENARIOS", "scenarios")
with ms.Session(f"{folder}/first_flight.yaml") as session:
    while session.step():
        view = session.view()
        if view["t_s"] < 5 or view["number"] != 60:
            continue
        change(session, "navigator.speed_um_per_s", 30)
        change(session, "obstacles.0.shape.radius_um", 20)
        change(session, "tick_s", 1)  # refused: not while it runs
    end = session.view()
    print(
        f"{session.status} at t = {end['t_s']:.1f} s, {end['goal_distance_um']:.1f} µm from the goal, "
        f"{len(end['obstacles_um'])} obstacles"
    )
    identical, difference = session.record().replay()  # with the changes
print("replay:", "identical" if identical else difference)
sys.exit(0 if identical else 1)
