"""Locomotion models that have learnt nothing: what they do is arbitrary, but always the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache

import pytest
import torch

from sldr_core.demonstrations import BLOCK, Fan, FanCollection, Inspected
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import make_config


@pytest.fixture(scope="module", autouse=True)
def one_thread() -> Iterator[None]:
    """Keep the networks, which are tiny here, off the other cores."""
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


Inspect = Callable[[str], Inspected]


@cache
def inspect_untrained(task: str) -> Inspected:
    config = make_config(task, "locomotion", "her", 0, "smoke")
    nets = LocomotionNets(config, torch.Generator().manual_seed(1))
    for normalizer in (nets.normalizer, nets.transition_normalizer):
        normalizer.scale.fill_(1.0)
    return Inspected(LocomotionModel(nets.requires_grad_(False).eval(), config, Measured(0.0, 1)))


@pytest.fixture(scope="session")
def inspect() -> Inspect:
    return inspect_untrained


@pytest.fixture(scope="session")
def push() -> Inspected:
    return inspect_untrained("FetchPush")


@pytest.fixture(scope="session")
def push_fan(push: Inspected) -> Fan:
    """Return two blocks of demonstrations of FetchPush, seed 3."""
    envs = push.make_envs(BLOCK)
    collection = FanCollection(envs, push.act, push.starts("FetchPush", envs), seed=3, count=2 * BLOCK)
    while collection.advance():
        pass
    return collection.fan()
