# SPDX-License-Identifier: Apache-2.0
"""Environments for learning in the form of Gymnasium, which is used where it is installed.

    from microswarm import environments
    env = environments.make("CorridorAlgorithmicFixedPCFixedGoal-v0", maze="corridor.pgm")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

Many at once, stepped together on all cores, are `make_vec(id, num_envs)`. With Gymnasium the names are known
to gymnasium.make() too.
"""

import importlib.util

from .gathering import GatheringEnv, GatheringVectorEnv, free_cells, ids, make, make_vec, values_of
from .navigation import NavigationEnv, NavigationVectorEnv


def register() -> None:
    """Makes the names known to gymnasium.make(); done at import where Gymnasium is installed."""
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
