# SPDX-License-Identifier: Apache-2.0
"""Plans, steers, gathers and measures magnetic microrobot swarms.

Lengths are in µm, times in s, angles in rad, fields in mT, currents in A. Positions are arrays of
shape (n, 2), y points up. Bad input raises InputError, a ValueError with a line for each mistake;
its list `issues` has the mistakes as fields.

    import microswarm as ms
    scenario = ms.Scenario.load("first_flight.yaml")
    scenario.navigator.speed_um_per_s = 60
    result = ms.run(scenario)
    print(result.status, result.metrics["length_um"], result.frames["x_um"])
"""

from ._core import HardwareError, version as __version__
from .coils import Coils
from .errors import InputError, Issue
from .gathering import Gathering, gather
from .global_input import GlobalPlan, global_plan
from .maps import Map, Path, plan, planners
from .navigator import Command, Navigator
from .record import Record, Table, read_record
from .runs import Session, run
from .scenario import Scenario
from .sweeps import sweep
from .vision import Segmentation, channel_graph, segment, track

__all__ = [
    "Coils",
    "Command",
    "Gathering",
    "GlobalPlan",
    "HardwareError",
    "InputError",
    "Issue",
    "Map",
    "Navigator",
    "Path",
    "Record",
    "Scenario",
    "Segmentation",
    "Session",
    "Table",
    "__version__",
    "channel_graph",
    "gather",
    "global_plan",
    "plan",
    "planners",
    "read_record",
    "run",
    "segment",
    "track",
    "sweep",
]
