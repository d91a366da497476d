# SPDX-License-Identifier: Apache-2.0
"""Environments by their names."""

import copy
import dataclasses
import importlib
from typing import Any, Optional

from ..core import Env
from ..vector import AutoresetMode, SyncVectorEnv, VectorEnv

registry: dict[str, "EnvSpec"] = {}


@dataclasses.dataclass
class EnvSpec:
    id: str
    entry_point: str
    vector_entry_point: Optional[str] = None
    kwargs: dict[str, Any] = dataclasses.field(default_factory=dict)

    def make(self, **values):
        return make(self, **values)


def register(id, entry_point, vector_entry_point=None, kwargs=None):
    registry[id] = EnvSpec(id, entry_point, vector_entry_point, kwargs or {})


def class_of(entry_point):
    module, name = entry_point.split(":")
    return getattr(importlib.import_module(module), name)


def spec_with(id, values):
    spec = copy.deepcopy(id if isinstance(id, EnvSpec) else registry[id])
    spec.kwargs = copy.deepcopy(spec.kwargs) | values
    return spec


def make(id, **values):
    spec = spec_with(id, values)
    env = class_of(spec.entry_point)(**copy.deepcopy(spec.kwargs))
    assert isinstance(env, Env) and env.unwrapped is env
    env.spec = spec
    return env


def make_vec(id, num_envs=1, vectorization_mode=None, **values):
    spec = spec_with(id, values)
    if vectorization_mode == "sync" or not spec.vector_entry_point:
        return SyncVectorEnv([lambda: make(spec)] * num_envs)
    envs = class_of(spec.vector_entry_point)(num_envs=num_envs, **spec.kwargs)
    assert isinstance(envs, VectorEnv) and isinstance(envs.metadata["autoreset_mode"], AutoresetMode)
    envs.unwrapped.spec = spec
    return envs
