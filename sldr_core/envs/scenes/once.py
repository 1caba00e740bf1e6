"""Scenes that were compiled before in this process: training, testing and replaying each ask for the same one."""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import lru_cache, wraps
from typing import ParamSpec

import mujoco

KEPT = 8
"""Scenes that are kept, about 10 MB each; a training asks for one or two."""

Asked = ParamSpec("Asked")


def compiled_once(build: Callable[Asked, mujoco.MjModel]) -> Callable[Asked, mujoco.MjModel]:
    """Let a function that builds a scene compile it once, and give everybody a copy that is free to be changed."""
    kept = lru_cache(maxsize=KEPT)(build)

    @wraps(build)
    def build_or_copy(*args: Asked.args, **kwargs: Asked.kwargs) -> mujoco.MjModel:
        return copy.copy(kept(*args, **kwargs))

    return build_or_copy
