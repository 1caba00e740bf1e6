"""The store opens from nothing, for several processes at once, and stays light."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
import threading
import time
from datetime import datetime
from pathlib import Path

import psycopg
import pytest
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from postgres_server import OURS
from sqlalchemy import Connection, select, text
from sqlalchemy.exc import IntegrityError, StatementError
from store_cases import claimed_run, queued_run
from store_engines import Stores

from backend.store import engines, migrations
from backend.store.claims import hold_fence
from backend.store.database import Database, open_database
from backend.store.errors import StoreTooNew, StoreUnavailable, Unstorable
from backend.store.metrics import append_metrics
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.tables import SCHEMA_REVISION, metadata, run_needs, runs

DRIVER_ERRORS = (sqlite3.ProgrammingError, psycopg.OperationalError)
OPEN = "from backend.store.database import open_database; from backend.store.settings import load_settings; "


def python(code: str, settings: Settings) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", OPEN + code],
        env={**os.environ, **settings.as_environment()},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_migrations_make_exactly_the_tables(db: Database) -> None:
    with db.read() as conn:
        context = MigrationContext.configure(conn, opts={"compare_type": True, "compare_server_default": True})
        assert compare_metadata(context, metadata) == []


def test_the_tables_name_the_newest_migration() -> None:
    config = Config()
    config.set_main_option("script_location", str(migrations.__path__[0]))
    config.set_main_option("path_separator", "os")

    assert ScriptDirectory.from_config(config).get_current_head() == SCHEMA_REVISION


def test_making_the_tables_is_not_worth_a_word(settings: Settings) -> None:
    opening = python(
        "import logging; logging.basicConfig(level=logging.INFO); open_database(load_settings())", settings
    )

    assert opening.communicate() == ("", "")


def test_opening_again_keeps_what_is_there(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    again = open_database(settings)

    assert get_run(again, run_id).id == run_id
    again.close()


def test_several_processes_can_open_a_fresh_store_at_once(stores: Stores, tmp_path: Path) -> None:
    with stores.fresh(tmp_path, empty=True) as settings:
        _open_at_once(settings)


def _open_at_once(settings: Settings) -> None:
    opened = [python("open_database(load_settings())", settings) for _ in range(4)]

    assert [process.communicate(timeout=60)[1] for process in opened] == [""] * 4
    assert [process.returncode for process in opened] == [0] * 4


def test_a_reader_sees_one_state_while_a_writer_goes_on(db: Database) -> None:
    with db.read() as conn:
        before = conn.execute(select(runs.c.id)).scalars().all()
        queued_run(db)
        assert conn.execute(select(runs.c.id)).scalars().all() == before == []


def test_rows_cannot_point_to_what_does_not_exist(db: Database) -> None:
    with pytest.raises(IntegrityError), db.write() as conn:
        conn.execute(run_needs.insert().values(run_id="nobody", needs_run_id="nothing"))


def test_writers_of_one_run_wait_for_each_other(db: Database) -> None:
    claim = claimed_run(db)
    order: list[str] = []
    entered = threading.Event()

    def hold() -> None:
        with db.write() as conn:
            hold_fence(conn, claim)
            entered.set()
            time.sleep(0.1)
            order.append("first")

    thread = threading.Thread(target=hold)
    thread.start()
    entered.wait()
    with db.write() as conn:
        hold_fence(conn, claim)
        order.append("second")
    thread.join()

    assert order == ["first", "second"]


def _write_half(conn: Connection) -> None:
    conn.execute(runs.update().values(reason="half done"))
    raise RuntimeError


def test_a_connection_that_is_given_back_after_the_end_is_closed(settings: Settings) -> None:
    db = open_database(settings)
    with db.read() as conn:
        db.close()
        driver_connection = conn.connection.driver_connection
    assert driver_connection is not None

    with pytest.raises(DRIVER_ERRORS, match="closed"):
        driver_connection.execute("SELECT 1")


def test_a_failed_transaction_leaves_nothing(db: Database) -> None:
    run_id = queued_run(db)

    with pytest.raises(RuntimeError), db.write() as conn:
        _write_half(conn)

    assert get_run(db, run_id).reason is None


def test_a_writer_that_waits_too_long_says_so(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "BUSY_TIMEOUT_S", 0.05)
    db = open_database(settings)
    claim = claimed_run(db)

    with db.write() as conn:
        hold_fence(conn, claim)
        with pytest.raises(StoreUnavailable, match="lock"):
            append_metrics(db, claim, [])
    db.close()


@pytest.mark.parametrize("engine", ["postgresql"], scope="module")
def test_a_value_that_postgresql_cannot_hold_is_told_in_words(db: Database) -> None:
    with pytest.raises(Unstorable, match=r"cannot hold or compare a value: .*NUL"):
        get_run(db, "a\x00b")


def test_a_store_of_a_later_version_is_left_alone(db: Database, settings: Settings) -> None:
    with db.write() as conn:
        conn.execute(text("UPDATE alembic_version SET version_num = '9999'"))

    with pytest.raises(StoreTooNew, match="of revision 9999, which this version does not know"):
        open_database(settings)


@pytest.mark.parametrize("engine", ["postgresql"], scope="module")
def test_a_store_that_cannot_be_opened_is_let_go(db: Database, settings: Settings) -> None:
    with db.write() as conn:
        conn.execute(text("UPDATE alembic_version SET version_num = '9999'"))

    with pytest.raises(StoreTooNew) as refusal:
        open_database(settings)

    connected = text(
        "SELECT count(*) FROM pg_stat_activity WHERE datname = current_database() AND application_name <> :ours"
    )
    with db.read() as conn:
        assert conn.execute(connected, {"ours": OURS}).scalar_one() == 1, refusal


def test_times_without_a_zone_are_refused(db: Database) -> None:
    with pytest.raises(StatementError, match="has no zone"), db.write() as conn:
        conn.execute(runs.update().values(ended_at=datetime(2026, 1, 1)))


def test_the_store_loads_neither_torch_nor_mujoco(settings: Settings) -> None:
    modules = "launches, queue, runs, metrics, progress, files, workers, viewer_sessions"
    code = f"from backend.store import {modules}; open_database(load_settings()); "
    process = python(code + "import sys; print([m for m in ('torch', 'mujoco') if m in sys.modules])", settings)

    assert process.communicate(timeout=60) == ("[]\n", "")
