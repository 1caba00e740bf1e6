"""A zoo of one model, made once."""

from __future__ import annotations

from pathlib import Path

import pytest
from zoo_cases import save_model

from sldr_core.zoo.adding import add_to_zoo, origin_here
from sldr_core.zoo.index import ZOO_VARIABLE, ZooModel


@pytest.fixture(scope="session")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return save_model(tmp_path_factory.mktemp("trained") / "locomotion.pt")


@pytest.fixture(scope="session")
def shipped(source: Path, tmp_path_factory: pytest.TempPathFactory) -> ZooModel:
    return add_to_zoo(source, tmp_path_factory.mktemp("zoo"), origin_here("smoke", 12.5, "a laptop"), episodes=2)


@pytest.fixture
def zoo(shipped: ZooModel, monkeypatch: pytest.MonkeyPatch) -> ZooModel:
    """Return a model of the zoo that this test's launches know."""
    monkeypatch.setenv(ZOO_VARIABLE, str(shipped.path.parent))
    return shipped
