# SPDX-License-Identifier: Apache-2.0
"""The rules of an environment, as Gymnasium's checker of the same name asks for them."""

import inspect
import warnings

import numpy as np

from ..core import Env
from ..spaces import Box, Space


def check_env(env, skip_render_check=False):
    if not isinstance(env, Env):
        raise TypeError(f"{type(env)} is no Env")
    check_spaces(env)
    check_reset(env)
    check_step(env)
    if not skip_render_check:
        check_render(env)
    new = env.spec.make()
    new.close(), new.close()


def check_spaces(env):
    assert isinstance(env.action_space, Space) and isinstance(env.observation_space, Space)
    for kind, space in (("action", env.action_space), ("observation", env.observation_space)):
        if isinstance(space, Box) and not (np.isfinite(space.low).all() and np.isfinite(space.high).all()):
            warnings.warn(f"the {kind} space is not bounded", stacklevel=2)
    space = env.action_space
    if isinstance(space, Box) and ((space.low < -1).any() or (space.high > 1).any() or ((space.low != 0) & (-space.low != space.high)).any()):
        warnings.warn("the action space is not normalised", stacklevel=2)


def check_reset(env):
    given = inspect.signature(env.reset).parameters
    assert given["seed"].default is None and "options" in given and "return_info" not in given
    assert not callable(getattr(env, "seed", None))

    def begun(**values):
        made = env.reset(**values)
        assert isinstance(made, tuple) and len(made) == 2 and isinstance(made[1], dict)
        assert isinstance(made[0], np.ndarray) and made[0].dtype == env.observation_space.dtype and made[0] in env.observation_space
        return made[0]

    begun(), begun(options={})
    first, state = begun(seed=123), state_of(env)
    second = begun()
    assert np.array_equal(begun(seed=123), first), "a seed must give the same observation"
    assert state_of(env) == state, "reset must call super().reset(seed=seed)"
    assert np.array_equal(begun(), second), "a seed must give the same episodes"
    begun(seed=456)
    assert state_of(env) != state, "another seed must give another np_random"


def state_of(env):
    generator = env.unwrapped._np_random
    assert generator is not None, "reset must call super().reset(seed=seed)"
    return generator.bit_generator.state


def check_step(env):
    env.action_space.seed(123)
    action = env.action_space.sample()
    made = []
    for _ in range(2):
        env.reset(seed=123)
        seen, reward, terminated, truncated, info = env.step(action)
        assert seen.dtype == env.observation_space.dtype and seen in env.observation_space
        assert isinstance(reward, (float, np.floating)) and np.isfinite(reward)
        assert type(terminated) is bool and truncated is False and isinstance(info, dict)
        made.append((seen.tolist(), reward, terminated, info))
    assert made[0] == made[1], "a seed must give the same step"


def check_render(env):
    assert env.metadata["render_modes"] and env.metadata["render_fps"] > 0
    assert env.render_mode in (None, *env.metadata["render_modes"])
    for mode in env.metadata["render_modes"]:
        new = env.spec.make(render_mode=mode)
        new.reset()
        picture = new.render()
        assert mode == "rgb_array" and picture.dtype == np.uint8 and picture.ndim == 3 and picture.shape[2] == 3
        new.close()
