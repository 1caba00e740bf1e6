"""A 3D session follows the policy of a run that another machine trains."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from worker.file_keeper import FileKeeper
from worker.viewer.newest_policy import NewestPolicies


@pytest.fixture
def here(settings: Settings, tmp_path: Path) -> Settings:
    return replace(settings, files_url=f"file://{tmp_path}/shared")


@pytest.fixture
def held(db: Database) -> Claim:
    launch(db, LaunchOrder("FetchPush", "locomotion", "her", [0], "smoke"))
    held = claim(db, "worker-1")
    assert held is not None
    return held


def keep(db: Database, settings: Settings, held: Claim, content: bytes, name: str = "policy-newest.pt") -> None:
    path = settings.run_directory(held.run_id) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    FileKeeper(db, FileStorage(settings), held).keep(name, "policy", path)


def test_without_a_policy_there_is_nothing_to_follow(db: Database, here: Settings, held: Claim) -> None:
    assert NewestPolicies(db, here).find(held.run_id) is None


def test_the_policy_of_another_machine_is_renewed_in_place(
    db: Database, here: Settings, held: Claim, tmp_path: Path
) -> None:
    there = replace(here, home=tmp_path / "there")
    keep(db, there, held, b"first")
    policies = NewestPolicies(db, here)
    path = policies.find(held.run_id)
    assert path is not None
    assert path.read_bytes() == b"first"

    keep(db, there, held, b"second")
    policies.renew(held.run_id, path)

    assert path.read_bytes() == b"second"


def test_the_policy_that_this_machine_trains_is_followed_itself(db: Database, here: Settings, held: Claim) -> None:
    keep(db, here, held, b"first")

    assert NewestPolicies(db, here).find(held.run_id) == here.run_directory(held.run_id) / "policy-newest.pt"
