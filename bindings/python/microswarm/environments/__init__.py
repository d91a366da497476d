# SPDX-License-Identifier: Apache-2.0
"""Environments for learning in Gymnasium's form; Gymnasium itself is used if it is installed.

    from microswarm import environments
    env = environments.make("CorridorAlgorithmicFixedPCFixedGoal-v0", maze="corridor.pgm")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

`make_vec(id, num_envs)` makes many environments that are stepped together on all cores. With Gymnasium installed, gymnasium.make()
knows the names too.
"""

import importlib.util

from .gathering import GatheringEnv, GatheringVectorEnv, free_cells, ids, make, make_vec, values_of
from .navigation import NavigationEnv, NavigationVectorEnv


def register() -> None:
    """Registers the names with gymnasium.make(); done at import if Gymnasium is installed."""
    from gymnasium.envs.registration import register as add
    from gymnasium.envs.registration import registry

    for name in ids():
        if name not in registry:
            add(name, entry_point="microswarm.environments:GatheringEnv", kwargs=values_of(name))


if importlib.util.find_spec("gymnasium"):
    register()

__all__ = [
    "GatheringEnv",
    "GatheringVectorEnv",
    "NavigationEnv",
    "NavigationVectorEnv",
    "free_cells",
    "ids",
    "make",
    "make_vec",
    "register",
]
