"""A backup that is made while a run is trained brings back a run that goes on without a gap."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from other_processes import wait_until
from store_engines import PostgresStores, SqliteStores
from worker_cases import queued_run, worker

from backend.store.backups.make import make_backup
from backend.store.backups.restore import restore_backup
from backend.store.database import Database, open_database
from backend.store.files import REPLAY_FILE, REPLAY_LIST, list_files
from backend.store.metrics import read_metrics
from backend.store.queue import claim
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.states import RunState
from worker.claimed_files import bring_claimed_run


def silent(sentence: str) -> None:
    """Tell nobody."""


@pytest.fixture
def elsewhere(postgres_stores: PostgresStores, tmp_path: Path) -> Iterator[Settings]:
    """Return an empty data directory whose store is on PostgreSQL."""
    (tmp_path / "elsewhere").mkdir()
    with postgres_stores.fresh(tmp_path / "elsewhere", empty=True) as settings:
        yield settings


def last_step(db: Database, run_id: str) -> int:
    return max(read_metrics(db, run_id).step, default=0)


def test_a_run_goes_on_from_a_backup_made_while_it_was_trained(
    db: Database, settings: Settings, elsewhere: Settings, tmp_path: Path
) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "saves"):
        wait_until(lambda: last_step(db, run_id) >= 20)
        known_before = last_step(db, run_id)
        report = make_backup(settings, tmp_path / "kept.tar", False, silent)
        wait_until(lambda: last_step(db, run_id) >= known_before + 20)

    restored = restore_backup(elsewhere, tmp_path / "kept.tar", False, silent)

    assert (report.left_out, restored.queued_again) == ((), 1)
    copy = open_database(elsewhere)
    known, checkpoint = last_step(copy, run_id), read_checkpoint(elsewhere, run_id)
    assert known_before <= known < last_step(db, run_id)
    assert 0 < checkpoint <= known
    with worker(copy, elsewhere, "saves"):
        wait_until(lambda: last_step(copy, run_id) > known)
    columns = read_metrics(copy, run_id)
    assert columns.step == list(range(1, len(columns.step) + 1))
    assert columns.attempt[checkpoint - 1 : checkpoint + 1] == [1, 2]
    copy.close()


def read_checkpoint(settings: Settings, run_id: str) -> int:
    """Return the cycle of a checkpoint, which must go with its replay file."""
    directory = settings.run_directory(run_id)
    cycle = int((directory / "checkpoint.pt").read_text())
    assert (directory / REPLAY_FILE).stat().st_size >= cycle
    return cycle


@pytest.mark.parametrize("shared_first", [False, True], ids=["to a shared place", "from a shared place"])
def test_files_change_their_kind_of_place(
    db: Database, settings: Settings, sqlite_stores: SqliteStores, tmp_path: Path, shared_first: bool
) -> None:
    run_id = queued_run(db)
    (tmp_path / "target").mkdir()
    with sqlite_stores.fresh(tmp_path / "target", empty=True) as target:
        url = f"file://{tmp_path}/shared"
        source = replace(settings, files_url=url) if shared_first else settings
        target = target if shared_first else replace(target, files_url=url)
        with worker(db, source, "saves"):
            wait_until(lambda: any(row.name == "checkpoint.pt" for row in list_files(db, run_id)))
        make_backup(source, tmp_path / "kept", False, silent)

        restore_backup(target, tmp_path / "kept", False, silent)

        copy = open_database(target)
        again = claim(copy, "worker-2")
        assert again is not None
        bring_claimed_run(copy, target, again)
        assert read_checkpoint(target, run_id) > 0
        assert (REPLAY_LIST in {row.name for row in list_files(copy, run_id)}) is not shared_first
        assert get_run(copy, run_id).state is RunState.RUNNING
        copy.close()
