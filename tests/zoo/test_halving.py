"""Weights in half precision: rounded once, loaded as float32, and nothing else in the file is touched."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
from zoo_cases import save_model

from sldr_core.errors import BadFile
from sldr_core.presets import make_config
from sldr_core.training import load_policy
from sldr_core.training.build import build_training
from sldr_core.training.checkpoint import Counters
from sldr_core.training.halving import read_halved
from sldr_core.training.policy import write_policy


@pytest.fixture(scope="module")
def policy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the policy of a robot whose normaliser has seen something."""
    home = tmp_path_factory.mktemp("policy")
    as_large_as_usual = {"agent": {"hidden_sizes": [128, 128, 128]}}
    parts = build_training(make_config("FetchPush", "manipulation", "her", 0, "smoke", as_large_as_usual), home, ())
    drawn = torch.Generator().manual_seed(1)
    parts.agent.normalizer.update(torch.randn(100_000, parts.agent.normalizer.mean.numel(), generator=drawn))
    write_policy(home / "policy-best.pt", parts, Counters(cycle=2, test_success_rate=0.25))
    return home / "policy-best.pt"


def test_a_policy_takes_half_the_room_and_acts_nearly_alike(policy: Path, tmp_path: Path) -> None:
    (tmp_path / "half.pt").write_bytes(read_halved(policy))
    whole, half = load_policy(policy), load_policy(tmp_path / "half.pt")
    drawn = np.random.default_rng(0)
    obs, goal = drawn.normal(size=(200, 25)), drawn.normal(size=(200, 3))

    acted, acts_now = whole.act(obs, goal), half.act(obs, goal)

    assert (tmp_path / "half.pt").stat().st_size < 0.6 * policy.stat().st_size
    assert 0 < np.abs(acts_now - acted).max() < 0.01
    for name, value in whole.actor.state_dict().items():
        assert torch.equal(half.actor.state_dict()[name], value.half().float()), name
    for name, value in whole.normalizer.state_dict().items():
        assert torch.equal(half.normalizer.state_dict()[name], value), name
    assert (half.config, half.epoch, half.success_rate) == (whole.config, whole.epoch, whole.success_rate)


def test_what_is_halved_already_stays_as_it_is(policy: Path, tmp_path: Path) -> None:
    (tmp_path / "half.pt").write_bytes(read_halved(policy))

    assert read_halved(tmp_path / "half.pt") == (tmp_path / "half.pt").read_bytes()


def test_a_locomotion_model_is_halved_as_in_the_zoo(source: Path, shipped, tmp_path: Path) -> None:
    (tmp_path / "half.pt").write_bytes(read_halved(source))

    ours, in_zoo = (torch.load(path, weights_only=True)["nets"] for path in (tmp_path / "half.pt", shipped.path))
    assert ours.keys() == in_zoo.keys()
    for name, value in ours.items():
        assert value.dtype == in_zoo[name].dtype
        assert torch.equal(value, in_zoo[name]), name


def test_what_cannot_be_halved_is_named(tmp_path: Path) -> None:
    large = save_model(tmp_path / "large.pt", largest=1e6)
    (tmp_path / "notes.pt").write_bytes(b"no archive")

    with pytest.raises(BadFile, match=r"large\.pt cannot be kept in half precision: inverse\."):
        read_halved(large)
    with pytest.raises(BadFile, match=r"notes\.pt is corrupt or no file of ours"):
        read_halved(tmp_path / "notes.pt")
