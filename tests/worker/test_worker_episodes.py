"""A worker's recorder keeps episodes on the disk, at the shared place and in the store, and drops them in all three."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from recorded_tests import made_test

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.episodes import EpisodeFilter, list_episodes
from backend.store.errors import StaleFence
from backend.store.files import find_file, list_files
from backend.store.launches import LaunchOrder, launch
from backend.store.outcomes import HandedBack
from backend.store.queue import claim, finish
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from sldr_core.episodes import read_episodes
from worker.recorder import StoreRecorder


def next_claim(db: Database) -> Claim:
    claimed = claim(db, "worker-1")
    assert claimed is not None
    return claimed


@pytest.fixture
def held(db: Database) -> Claim:
    launch(db, LaunchOrder("FetchPush", "manipulation", "her", [0], "smoke"))
    return next_claim(db)


def recorder(db: Database, settings: Settings, held: Claim) -> StoreRecorder:
    return StoreRecorder(db, settings, held, lambda: None)


def names_in(directory: Path) -> list[str]:
    return sorted(path.name for path in directory.glob("*.npz"))


def test_a_test_s_episodes_are_a_file_and_rows_beside_it(db: Database, settings: Settings, held: Claim) -> None:
    test = made_test()
    with recorder(db, settings, held) as recording:
        recording.record_episodes(test, {12})

    row = find_file(db, held.run_id, "episodes-epoch-0012.npz")
    listed = list_episodes(db, held.run_id, EpisodeFilter(), "epoch", True, 10, 0).rows
    assert row.kind == "episodes"
    assert read_episodes(FileStorage(settings).bring(row)).summaries() == test.summaries()
    assert [episode.summary for episode in listed] == list(test.summaries())
    assert {(episode.file, episode.attempt) for episode in listed} == {(row.name, 1)}


@pytest.mark.parametrize("is_shared", [False, True])
def test_old_tests_leave_disk_shared_place_and_store(
    is_shared: bool, db: Database, settings: Settings, held: Claim, tmp_path: Path
) -> None:
    shared = tmp_path / "shared"
    if is_shared:
        settings = replace(settings, files_url=f"file://{shared}")
    with recorder(db, settings, held) as recording:
        for epoch, kept in ((1, {1}), (2, {1, 2}), (3, {1, 3})):
            recording.record_episodes(made_test(epoch=epoch), kept)

    left = ["episodes-epoch-0001.npz", "episodes-epoch-0003.npz"]
    assert names_in(settings.run_directory(held.run_id)) == left
    assert [row.name for row in list_files(db, held.run_id)] == left
    assert list_episodes(db, held.run_id, EpisodeFilter(), "epoch", True, 10, 0).epochs == [1, 3]
    assert len(list(shared.rglob("*.npz"))) == (2 if is_shared else 0)
    for row in list_files(db, held.run_id):
        assert len(read_episodes(FileStorage(settings).bring(row)).episodes) == 2


def test_an_attempt_that_is_over_records_nothing(db: Database, settings: Settings, held: Claim) -> None:
    late = recorder(db, settings, held)
    finish(db, held, HandedBack("Its worker was asked to end."))
    next_claim(db)

    with pytest.raises(StaleFence):
        late.record_episodes(made_test(), {12})
    assert list_episodes(db, held.run_id, EpisodeFilter(), "epoch", True, 10, 0).rows == []
    with pytest.raises(StaleFence):
        late.record_episodes(made_test(epoch=13), {13})
    late.__exit__()
