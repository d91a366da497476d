# SPDX-License-Identifier: Apache-2.0
"""Environments for learning in Gymnasium's form; Gymnasium itself is used if it is installed.

    from microswarm import environments
    env = environments.make("microswarm/Navigation-v0", scenario="scenarios/first_flight.yaml")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

`make_vec(id, num_envs)` makes many environments that are stepped together on all cores. With Gymnasium installed, gymnasium.make()
and gymnasium.make_vec() know the names too.
"""

import importlib.util
from typing import Any

from .bases import AutoresetMode
from .gathering import GatheringEnv, GatheringVectorEnv, free_cells, ids, values_of
from .navigation import NavigationEnv, NavigationVectorEnv

NAVIGATION = "microswarm/Navigation-v0"


def make(id: str, **values: Any) -> Any:
    """An environment by its name: one of ids(), or "microswarm/Navigation-v0". `values` override those of the name."""
    return NavigationEnv(**values) if id == NAVIGATION else GatheringEnv(**values_of(id) | values)


def make_vec(id: str, num_envs: int, **values: Any) -> Any:
    """`num_envs` environments by their name, stepped together."""
    if id == NAVIGATION:
        return NavigationVectorEnv(num_envs, **values)
    return GatheringVectorEnv(num_envs, **values_of(id) | values)


def register() -> None:
    """Registers the names with Gymnasium; done at import if Gymnasium is installed."""
    from gymnasium.envs.registration import register as add
    from gymnasium.envs.registration import registry

    for name in (*ids(), NAVIGATION):
        kind, values = ("Navigation", {}) if name == NAVIGATION else ("Gathering", values_of(name))
        if name not in registry:
            add(name, entry_point=f"{__name__}:{kind}Env", vector_entry_point=f"{__name__}:{kind}VectorEnv", kwargs=values)


if importlib.util.find_spec("gymnasium"):
    register()

__all__ = [
    "AutoresetMode",
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
