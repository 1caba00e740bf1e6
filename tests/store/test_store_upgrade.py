"""A store that the first version left, with a run in progress, opens under this one and loses nothing.

`data/store-0001.sql` is what the first version wrote: a locomotion run that missed its gate and the run it blocks,
a run that trains, one that waits, and one that asks for a GPU.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

import pytest
from sqlalchemy import text
from store_cases import claim_next, step
from store_engines import SqliteStores

from backend.store.actions import Action, act_on
from backend.store.attempts import list_attempts
from backend.store.backups.make import make_backup
from backend.store.claims import Claim, claim_from_json, claim_to_json
from backend.store.database import Database, open_database
from backend.store.errors import Refused
from backend.store.files import list_files
from backend.store.inspection import inspect_store
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import HandedBack, Succeeded
from backend.store.queue import claim, finish, heartbeat
from backend.store.runs import RunFilter, RunRow, get_run, list_events, list_runs
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.tables import SCHEMA_REVISION
from sldr_core.config import config_from_dict

FIRST_STORE = Path(__file__).parent / "data" / "store-0001.sql"
OLD_WORKER = "f3d036893edd"


@pytest.fixture
def first_store(sqlite_stores: SqliteStores, tmp_path: Path) -> Iterator[Settings]:
    """Return the data directory that the first version left; that version knew SQLite alone."""
    with sqlite_stores.fresh(tmp_path, empty=True) as settings:
        with closing(sqlite3.connect(tmp_path / "sldr.db")) as connection:
            connection.executescript(FIRST_STORE.read_text())
        yield settings


@pytest.fixture
def db(first_store: Settings) -> Iterator[Database]:
    """Return its store, opened by this version."""
    with closing(open_database(first_store)) as database:
        yield database


def only(db: Database, state: RunState) -> RunRow:
    (row,) = list_runs(db, RunFilter(states=[state]), 10).rows
    return row


def old_claim(db: Database) -> Claim:
    """Return the claim that the first version's worker still holds."""
    run = only(db, RunState.RUNNING)
    return Claim(
        run_id=run.id,
        fence=1,
        attempt=1,
        worker_id=OLD_WORKER,
        config=config_from_dict(run.config),
        locomotion_run_ids=(),
        gate_waived=False,
        lease_until=datetime.now(UTC),
    )


def test_the_store_is_brought_to_the_newest_version(db: Database) -> None:
    with db.read() as conn:
        assert conn.execute(text("SELECT version_num FROM alembic_version")).scalar_one() == SCHEMA_REVISION


def test_no_backup_is_made_of_a_store_that_would_be_migrated_for_it(first_store: Settings, tmp_path: Path) -> None:
    with pytest.raises(Refused, match="make the backup with the version that has used the store so far"):
        make_backup(first_store, tmp_path / "backup", overwrite=False, tell=print)

    assert inspect_store(first_store).revision == "0001"
    assert not (tmp_path / "backup").exists()


def test_runs_keep_their_order_and_those_for_a_gpu_are_known(db: Database) -> None:
    queued = list_runs(db, RunFilter(states=[RunState.QUEUED]), 10).rows[::-1]

    assert [(run.method, run.seed, run.needs_gpu, run.priority) for run in queued] == [
        ("her", 1, False, 0),
        ("ddpg", 0, True, 0),
    ]
    assert claim(db, "no-gpu", with_gpu=False) is not None
    assert claim(db, "no-gpu", with_gpu=False) is None
    assert claim_next(db).run_id == queued[1].id


def test_the_run_in_progress_goes_on_under_its_old_worker(db: Database) -> None:
    held = old_claim(db)

    assert heartbeat(db, held).alive
    append_metrics(db, held, [MetricPoint(step(4), {"test/success_rate": 0.4})])
    finish(db, held, Succeeded(0.4))

    assert read_metrics(db, held.run_id).values == {"test/success_rate": [0.1, 0.2, 0.3, 0.4]}
    assert get_run(db, held.run_id).state is RunState.SUCCEEDED


def test_the_run_in_progress_can_be_handed_over(db: Database) -> None:
    held = old_claim(db)
    finish(db, held, HandedBack("Its worker was asked to end."))
    again = claim_next(db)
    append_metrics(db, again, [MetricPoint(step(3), {"test/success_rate": 0.35})])

    assert (again.run_id, again.attempt) == (held.run_id, 2)
    assert read_metrics(db, held.run_id).values == {"test/success_rate": [0.1, 0.2, 0.35]}
    assert [(row.attempt, row.host, row.first_cycle) for row in list_attempts(db, held.run_id)] == [
        (1, "here", 1),
        (2, None, 3),
    ]


def test_the_history_goes_on(db: Database) -> None:
    held = old_claim(db)
    act_on(db, Action.PAUSE, [held.run_id])

    assert [event.event for event in list_events(db, held.run_id)] == ["created", "claimed", "pause_requested"]


def test_the_run_below_its_gate_can_be_released(db: Database) -> None:
    blocked = only(db, RunState.BLOCKED)

    assert blocked.is_below_gate
    assert act_on(db, Action.RELEASE, [blocked.id])[0].done
    assert [row.name for row in list_files(db, blocked.needs[0])] == ["locomotion.pt"]


def test_a_claim_that_the_first_version_wrote_is_read(db: Database) -> None:
    held = old_claim(db)
    line = claim_to_json(held).replace('"gate_waived": false, ', "")

    assert "gate_waived" not in line
    assert claim_from_json(line) == held
