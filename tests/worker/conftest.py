"""Two machines that share their files, and a run that one of them has claimed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from two_machines import next_claim

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.settings import Settings


@pytest.fixture
def here(settings: Settings, tmp_path: Path) -> Settings:
    """Return a machine that shares its files."""
    return replace(settings, files_url=f"file://{tmp_path}/shared")


@pytest.fixture
def there(here: Settings, tmp_path: Path) -> Settings:
    """Return another one."""
    return replace(here, home=tmp_path / "there")


@pytest.fixture
def first(db: Database) -> Claim:
    """Return a claimed locomotion run that another one waits for."""
    launch(db, LaunchOrder("FetchPush", "manipulation", "her-sldr", [0], "smoke"))
    return next_claim(db)
