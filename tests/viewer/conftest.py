"""A real policy file, made in a second."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from sldr_core.config import Phase
from sldr_core.presets import make_config
from sldr_core.training.build import build_training
from sldr_core.training.checkpoint import Counters
from sldr_core.training.policy import write_policy

WritePolicy = Callable[..., None]


def _write_policy(path: Path, phase: Phase = "locomotion", cycle: int = 2) -> None:
    config = make_config("FetchPush", phase=phase, method="her", seed=0, preset="smoke")
    counters = Counters(cycle=cycle, test_success_rate=0.25)
    write_policy(path, build_training(config, path.parent, ()), counters)


@pytest.fixture(scope="session")
def policy_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("policy") / "policy-newest.pt"
    _write_policy(path)
    return path


@pytest.fixture(scope="session")
def write_policy_file() -> WritePolicy:
    return _write_policy
