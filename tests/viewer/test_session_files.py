"""A 3D session follows the policy of a run that another machine trains."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.outcomes import HandedBack
from backend.store.queue import claim, finish
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.store.viewer_sessions import request_session
from sldr_core.errors import UnknownName
from worker.file_keeper import FileKeeper
from worker.viewer.session_files import NothingToShow, RunFiles, find_session_files


@pytest.fixture
def here(settings: Settings, tmp_path: Path) -> Settings:
    return replace(settings, files_url=f"file://{tmp_path}/shared")


@pytest.fixture
def held(db: Database) -> Claim:
    launch(db, LaunchOrder("FetchPush", "locomotion", "her", [0], "smoke"))
    return claimed(db)


def claimed(db: Database) -> Claim:
    held = claim(db, "worker-1")
    assert held is not None
    return held


def keep(db: Database, settings: Settings, held: Claim, content: bytes, name: str = "policy-newest.pt") -> None:
    path = settings.run_directory(held.run_id) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    FileKeeper(db, FileStorage(settings), held).keep(name, "policy", path)


def run_files(db: Database, settings: Settings) -> RunFiles:
    return RunFiles(db, settings, FileStorage(settings))


def test_without_a_policy_there_is_nothing_to_follow(db: Database, here: Settings, held: Claim) -> None:
    with pytest.raises(NothingToShow, match="wait for its first test"):
        run_files(db, here).policy(held.run_id)


def test_the_policy_of_another_machine_is_renewed_in_place(
    db: Database, here: Settings, held: Claim, tmp_path: Path
) -> None:
    there = replace(here, home=tmp_path / "there")
    keep(db, there, held, b"first")
    session = request_session(db, held.run_id)
    [path] = find_session_files(run_files(db, here), session)["policy"]
    assert path.read_bytes() == b"first"

    keep(db, there, held, b"second")
    find_session_files(run_files(db, here), session)

    assert path.read_bytes() == b"second"


def test_a_policy_is_followed_from_machine_to_machine(
    db: Database, here: Settings, held: Claim, tmp_path: Path
) -> None:
    there = replace(here, home=tmp_path / "there")
    keep(db, here, held, b"first")
    session = request_session(db, held.run_id)
    [path] = find_session_files(run_files(db, here), session)["policy"]
    seen = [path.read_bytes()]

    for machine, content in ((there, b"second"), (here, b"third")):
        finish(db, held, HandedBack("Its worker was asked to end."))
        held = claimed(db)
        keep(db, machine, held, content)
        find_session_files(run_files(db, here), session)
        seen.append(path.read_bytes())

    assert seen == [b"first", b"second", b"third"]


def test_without_a_shared_place_the_policy_is_followed_where_it_is_written(
    db: Database, settings: Settings, held: Claim
) -> None:
    keep(db, settings, held, b"first")

    assert run_files(db, settings).policy(held.run_id) == settings.run_directory(held.run_id) / "policy-newest.pt"


def test_a_file_that_the_run_has_not_got_is_named(db: Database, here: Settings, held: Claim) -> None:
    with pytest.raises(NothingToShow, match=r"no file policy-epoch-0007\.pt"):
        run_files(db, here).policy(held.run_id, "policy-epoch-0007.pt")


def test_an_unknown_kind_of_view_is_named(db: Database, here: Settings, held: Claim) -> None:
    with pytest.raises(UnknownName, match="called 'hologram'"):
        find_session_files(run_files(db, here), request_session(db, held.run_id, {"kind": "hologram"}))
