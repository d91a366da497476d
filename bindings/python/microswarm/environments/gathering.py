# SPDX-License-Identifier: Apache-2.0
"""Gathering of particles in a maze by the rules of the benchmark gym-gathering (Konitzny, Lu, Leclerc,
Fekete and Becker, "Gathering Physical Particles with a Global Magnetic Field Using Reinforcement
Learning", IROS 2022), with its names, observations, rewards and physics.
"""

from __future__ import annotations

import importlib.util
import os
import pathlib
from typing import Any, Optional, Sequence, Union

import numpy as np

from .. import _core
from ..maps import Map
from ..values import InputError, array_of, free_pixels, grid_of, number, path_text, setting, told, whole
from .bases import AutoresetMode
from .environment import SingleEnvironment, Steps, VectorEnvironment, View, count_of, mode_of, render_mode_of
from .spaces import Box, Discrete, MultiDiscrete

Maze = Union[np.ndarray, Map, str, "os.PathLike[str]"]

# Goal of each maze of the benchmark (column, row), and its file there.
MAZES = {
    "Corridor": ((82, 80), "map0318.csv"),
    "Capillary": ((61, 130), "map0518.csv"),
    "Brain": ((96, 204), "map0122.csv"),
    "Vessel": ((85, 66), "small_vessel.csv"),
    "Pulmonary": ((112, 32), "pulmonary.csv"),
}
PHYSICS = {"Algorithmic": "algorithmic", "Fuzzy": "fuzzy", "Physical": "physical"}
COUNTS: dict[str, Union[int, str]] = {"FixedPC": 256, "RandomPC": "random", "FilledPC": "filled"}
GOALS = ("FixedGoal", "RandomGoal")
MAX_SIDE = 8192


def ids() -> list[str]:
    """Names of the environments of the benchmark."""
    return [f"{maze}{physics}{count}{goal}-v0" for maze in MAZES for physics in PHYSICS for count in COUNTS for goal in GOALS]


def values_of(name: str) -> dict[str, Any]:
    """Values that the name of an environment stands for."""
    for maze, (goal, _) in MAZES.items():
        for physics in PHYSICS:
            for count in COUNTS:
                for kind in GOALS:
                    if name == f"{maze}{physics}{count}{kind}-v0":
                        fixed = kind == "FixedGoal"
                        return {
                            "maze": maze,
                            "goal": goal if fixed else None,
                            "physics": PHYSICS[physics],
                            "n_particles": COUNTS[count],
                            "observation_type": "simple" if fixed else "multichannel",
                        }
    raise InputError(f"{told(name)} is no environment: it must be a maze of {', '.join(MAZES)}, then {', '.join(PHYSICS)}, then {', '.join(COUNTS)}, then {' or '.join(GOALS)}, then -v0")


def _named_maze(name: str) -> np.ndarray:
    """A maze of the benchmark, from its package or the folder of real input."""
    folder = os.environ.get("MICROSWARM_DATA")
    if folder:
        file = pathlib.Path(folder, "gym_gathering", f"{name.lower()}.pgm")
        if file.exists():
            return free_cells(file)
    package = importlib.util.find_spec("gym_gathering")
    for place in (package.submodule_search_locations or []) if package else []:
        file = pathlib.Path(place, "mapdata", MAZES[name][1])
        if file.exists():
            return free_cells(file)
    raise InputError(f"the maze {name} is not here: give maze=, install gym_gathering, or set MICROSWARM_DATA to a folder with gym_gathering/{name.lower()}.pgm")


def free_cells(maze: Maze, cell_um: Optional[float] = None) -> np.ndarray:
    """The free cells of a maze as booleans of shape (rows, columns), the upper row first.

    maze      an array: of booleans or of 0 and 1, where True or 1 is free, or of grey values of uint8, where 128 and more is
              free; a file, whose bright pixels are free cells (of a .csv file of 0 and 1 the entries 1); a name of the
              benchmark; or a Map with cell_um, a cell being free if its middle is
    """
    if isinstance(maze, Map):
        if cell_um is None:
            raise InputError("cell_um is missing: a map has no cells of its own")
        size = number("cell_um", cell_um)
        x_lo, y_lo, x_hi, y_hi = maze.bounds_um
        if not 0 < size <= min(x_hi - x_lo, y_hi - y_lo):
            raise InputError(f"cell_um is {size:g}, must be above 0 and at most the map's {min(x_hi - x_lo, y_hi - y_lo):g}")
        columns, rows = int((x_hi - x_lo) / size + 1e-9), int((y_hi - y_lo) / size + 1e-9)
        if columns * rows > MAX_SIDE**2:
            raise InputError(f"cell_um is {size:g}: {columns} × {rows} cells are too many")
        x, y = np.meshgrid(x_lo + size * (np.arange(columns) + 0.5), y_hi - size * (np.arange(rows) + 0.5))
        return maze.is_free(np.column_stack((x.ravel(), y.ravel()))).reshape(rows, columns)
    if cell_um is not None:
        raise InputError("cell_um is for a Map")
    if isinstance(maze, str) and maze in MAZES:
        return _named_maze(maze)
    if isinstance(maze, (str, os.PathLike)):
        name = path_text(maze, "maze")
        if name.endswith(".csv"):
            try:
                cells = np.loadtxt(name, delimiter=",", ndmin=2)
            except (OSError, ValueError) as error:
                raise InputError(f"{name}: {error}") from None
            return free_pixels(name, grid_of(name, cells, MAX_SIDE), "write 0 and 1")
        return free_cells(Map.load(name, 1), 1)
    return free_pixels("maze", grid_of("maze", maze, MAX_SIDE), "give maze >= a threshold")


def _arguments(
    num_envs: int,
    threads: int,
    mode: Any,
    maze: Maze,
    goal: Any,
    n_particles: Union[int, str] = 256,
    physics: str = "algorithmic",
    observation_type: str = "simple",
    cell_um: Optional[float] = None,
    **rules: Any,
) -> tuple[Any, ...]:
    """Arguments of the native module."""
    rules |= {"physics": physics, "observation": observation_type}
    if isinstance(n_particles, str):
        if n_particles not in ("random", "filled"):
            raise InputError(f"n_particles is {told(n_particles)}, must be a number, 'random' or 'filled'")
        rules["particle_count"] = n_particles
    else:
        rules["n_particles"] = whole("n_particles", n_particles, 10**6)
    free = np.ascontiguousarray(free_cells(maze, cell_um), dtype=np.uint8)
    if isinstance(goal, str) and goal == "default":
        if not (isinstance(maze, str) and maze in MAZES):
            raise InputError("goal is missing: only mazes of the benchmark have one; give (column, row), or None for a random one")
        goal = MAZES[maze][0]
    place = None
    if goal is not None:
        try:
            column, row = goal
        except (TypeError, ValueError):
            raise InputError(f"goal is {told(goal)}, must be (column, row) or None for a random one") from None
        place = [whole("goal column", column, MAX_SIDE - 1), whole("goal row", row, MAX_SIDE - 1)]
    return free, place, [setting(key, value) for key, value in rules.items()], num_envs, threads, mode.value


class GatheringView(View):
    """Attributes of one gathering."""

    @property
    def particle_locations(self) -> np.ndarray:
        """Row and column of each particle; the order is undefined once particles have met."""
        return self._core.particles(self._index)

    @property
    def particle_weights(self) -> np.ndarray:
        """Weight of each particle; empty unless the physics is "physical"."""
        return self._core.weights(self._index)

    @property
    def goal(self) -> tuple[int, int]:
        """Column and row of the goal."""
        return self._core.goal(self._index)

    @property
    def costs(self) -> np.ndarray:
        """Steps from each cell to the goal; −1 for walls and cells from which it cannot be reached."""
        return self._core.costs(self._index)

    def render(self) -> np.ndarray:
        """Colour picture of uint8, shape (rows, columns, 3)."""
        costs = self.costs
        image = np.where((costs >= 0)[:, :, None], np.array([90, 150, 190], np.uint8), np.array([15, 30, 65], np.uint8))
        column, row = self.goal
        image[(costs >= 0) & (costs <= self.rules["goal_range"])] = (150, 190, 160)
        places = self.particle_locations
        image[places[:, 0], places[:, 1]] = (250, 250, 100)
        image[row, column] = (220, 60, 50)
        return image


class GatheringEnv(GatheringView, SingleEnvironment):
    """Particles in a maze that all follow the same input, to be gathered at a goal.

    action_space         Discrete(8): east, south-east, south, south-west, west, north-west, north, north-east
    observation_space    Box of uint8, of shape (rows, columns, channels). "simple": particles are 255;
                         "multichannel": walls, particles and, if it is random, the goal
    reward               decrease of the total and of the largest distance to the goal, as shares of the maze's
                         costs, minus 1 / the estimated length of an episode
    terminated           all are within goal_range steps of the goal
    truncated            max_episode_steps have passed
    info                 at the end of an episode "success" and "is_success", and "reason": "gathered" or "step_limit"

    maze         see free_cells()
    goal         (column, row), "default" for a maze of the benchmark, or None: a random one each episode
    values       n_particles=256: a number, "random", or "filled": one in every cell;
                 physics="algorithmic": a cell in the input's direction, "fuzzy": with random errors, or "physical":
                 with mass, drag and contacts; observation_type="simple" or "multichannel"; cell_um of a Map;
                 goal_range, max_episode_steps, total_cost_reward, max_cost_reward, time_penalty;
                 fuzzy: random_move_chance, random_move_distance, fuzzy_action_probability; physical: force,
                 drag, max_particle_weight, particle_self_collision, max_particles_per_cell
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 25}
    _opened_by = _core.GatheringBatch
    _native = ("_core", "_step")

    def __init__(self, maze: Maze, goal: Any = "default", *, render_mode: Optional[str] = None, **values: Any) -> None:
        self.render_mode = render_mode_of(render_mode)
        self._arguments = _arguments(1, 1, AutoresetMode.NEXT_STEP, maze, goal, **values)
        self._attach(self._open())
        self.action_space = Discrete(8)
        self.observation_space = Box(0, 255, self._shape(), np.uint8)

    def _attach(self, core: Any) -> None:
        super()._attach(core)
        self._step = core.step_one

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Applies an input; returns (observation, reward, terminated, truncated, info)."""
        try:
            return self._step(action)
        except TypeError:
            raise InputError(f"action is {told(action)}, must be a whole number from 0 to 7") from None


class GatheringVectorEnv(VectorEnvironment):
    """`num_envs` gatherings of the same maze and rules, stepped together on all cores.

    Environment i is seeded with seed + i and equals a GatheringEnv with that seed. The arguments are those of
    GatheringEnv, and:

    threads           number of threads; 0: one a core. Results do not depend on it
    copy              False: each step updates and returns the same array of observations
    autoreset_mode    as Gymnasium's AutoresetMode, or its text. "NextStep": the step after the end of an episode begins the
                      next one, with reward 0; "SameStep": the step that ends it, infos has "final_obs" and "final_info";
                      "Disabled": a reset with a "reset_mask"
    """

    _opened_by = _core.GatheringBatch
    _view = GatheringView

    def __init__(
        self,
        num_envs: int,
        maze: Maze,
        goal: Any = "default",
        *,
        threads: int = 0,
        copy: bool = True,
        autoreset_mode: Any = AutoresetMode.NEXT_STEP,
        render_mode: Optional[str] = None,
        **values: Any,
    ) -> None:
        mode = mode_of(autoreset_mode)
        self._arguments = _arguments(count_of(num_envs), whole("threads", threads, 1024), mode, maze, goal, **values)
        super().__init__(num_envs, copy, mode, render_mode_of(render_mode))
        self.single_action_space = Discrete(8)
        self.single_observation_space = Box(0, 255, self._all.shape[1:], np.uint8)
        self.action_space = MultiDiscrete([8] * num_envs)
        self.observation_space = Box(0, 255, self._all.shape, np.uint8)

    def step(self, actions: Sequence[int]) -> Steps:
        """Applies an input in each environment; returns arrays of observations, rewards, terminated, truncated, and info."""
        given = array_of("actions", actions, f"{self.num_envs} whole numbers", kinds="iu", shape=(self.num_envs,))
        bad = (given < 0) | (given > 7)
        if bad.any():
            raise InputError(f"an action is {given[bad][0]}, must be 0 to 7")
        return self._stepped(given.astype(np.uint8))

    def particle_locations(self, index: int) -> np.ndarray:
        """Row and column of each particle of an environment."""
        return self._core.particles(whole("index", index, self.num_envs - 1))
