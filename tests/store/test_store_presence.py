"""Workers and viewer hosts are seen while they live; 3D sessions go from asked for to ended."""

from __future__ import annotations

from datetime import timedelta

import pytest
from sqlalchemy import update
from store_cases import claim_next, queued_run

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.tables import viewer_hosts, workers
from backend.store.viewer_sessions import (
    beat_host,
    end_sessions_of_other_hosts,
    get_session,
    is_host_alive,
    list_open,
    mark_ended,
    mark_ready,
    next_requested,
    request_session,
)
from backend.store.workers import ALIVE_S, beat, list_workers, register_worker, retire


def age(db: Database, table, seconds: float) -> None:
    with db.write() as conn:
        conn.execute(update(table).values(beat_at=current_time(conn) - timedelta(seconds=seconds)))


def test_a_worker_shows_how_busy_it_is(db: Database) -> None:
    worker_id = register_worker(db, "here", 123, slots=2)
    queued_run(db)
    claim_next(db, worker_id)

    (worker,) = list_workers(db)

    assert (worker.id, worker.host, worker.pid, worker.slots, worker.busy, worker.alive) == (
        worker_id,
        "here",
        123,
        2,
        1,
        True,
    )


def test_a_silent_worker_is_listed_as_dead_until_it_beats(db: Database) -> None:
    worker_id = register_worker(db, "here", 123, slots=1)
    age(db, workers, ALIVE_S + 1.0)
    assert [worker.alive for worker in list_workers(db)] == [False]

    beat(db, worker_id)

    assert [worker.alive for worker in list_workers(db)] == [True]


def test_a_retired_worker_is_not_listed(db: Database) -> None:
    retire(db, register_worker(db, "here", 123, slots=1))

    assert list_workers(db) == []


def test_an_unknown_worker_cannot_beat(db: Database) -> None:
    with pytest.raises(NotFound, match="no worker 'nobody'"):
        beat(db, "nobody")


def test_a_viewer_host_is_alive_while_it_beats(db: Database) -> None:
    assert not is_host_alive(db)
    beat_host(db, "host", 123)
    beat_host(db, "host", 123)
    assert is_host_alive(db)

    age(db, viewer_hosts, 60.0)

    assert not is_host_alive(db)


def test_a_session_is_taken_by_one_host(db: Database) -> None:
    asked = request_session(db, queued_run(db))

    taken = next_requested(db, "host")

    assert taken is not None
    assert (taken.id, taken.host_id, taken.state) == (asked.id, "host", "starting")
    assert next_requested(db, "other") is None


def test_a_session_becomes_ready_then_ends(db: Database) -> None:
    session_id = request_session(db, queued_run(db)).id
    next_requested(db, "host")

    assert mark_ready(db, session_id, 4321, "epoch 3")
    assert (get_session(db, session_id).state, get_session(db, session_id).port) == ("ready", 4321)
    assert mark_ended(db, session_id, message="Nobody looked.")
    assert get_session(db, session_id).state == "ended"
    assert list_open(db) == []


def test_an_ended_session_does_not_become_ready(db: Database) -> None:
    session_id = request_session(db, queued_run(db)).id
    mark_ended(db, session_id, failed=True, message="No policy yet.")

    assert not mark_ready(db, session_id, 4321)
    assert not mark_ended(db, session_id)
    assert get_session(db, session_id).state == "failed"


def test_a_new_host_ends_what_a_dead_one_left(db: Database) -> None:
    run_id = queued_run(db)
    left, fresh = request_session(db, run_id), request_session(db, run_id)
    next_requested(db, "dead")

    assert end_sessions_of_other_hosts(db, "new", "The viewer was restarted.") == 1
    assert get_session(db, left.id).state == "ended"
    assert get_session(db, fresh.id).state == "starting"


def test_a_session_needs_a_run(db: Database) -> None:
    with pytest.raises(NotFound, match="no run 'nobody'"):
        request_session(db, "nobody")
