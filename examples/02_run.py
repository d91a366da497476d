# SPDX-License-Identifier: Apache-2.0
"""Runs a scenario from its file, prints its metrics and keeps the record."""

import os
import sys

import microswarm as ms

folder = os.environ.get("MICROSWARM_SCENARIOS", "scenarios")
try:
    scenario = ms.Scenario.load(sys.argv[1] if len(sys.argv) > 1 else f"{folder}/first_flight.yaml")
    scenario.navigator.speed_um_per_s = 50
    record = ms.run(scenario)
    metrics = record.metrics
    print(
        f"{record.status} after {metrics['time_s']:.1f} s, {metrics['length_um']:.0f} µm; "
        f"nearest wall {metrics['walls_clearance_um']:.1f} µm"
    )
    record.save("02_run.h5")  # or record.frames["x_um"], an array
    sys.exit(0 if record.solved else 3)
except ms.InputError as error:  # a line for each thing wrong
    print(error, file=sys.stderr)
    sys.exit(2)
