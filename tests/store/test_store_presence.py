"""Workers and viewer hosts are seen while they live; 3D sessions go from asked for to ended."""

from __future__ import annotations

from datetime import timedelta

import pytest
from sqlalchemy import update
from store_cases import claim_next, queued_run

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.queue import claim
from backend.store.tables import viewer_hosts, workers
from backend.store.viewer_sessions import (
    beat_host,
    end_orphaned_sessions,
    get_session,
    is_host_alive,
    list_open,
    mark_ended,
    mark_ready,
    next_requested,
    request_session,
)
from backend.store.workers import ALIVE_S, Machine, beat, list_workers, register_worker, retire, set_draining


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


def taken_by(db: Database, host_id: str) -> str:
    asked = request_session(db, queued_run(db))
    next_requested(db, host_id)
    return asked.id


def orphans_end(db: Database, running: set[int]) -> None:
    end_orphaned_sessions(db, "mine", "here", running.__contains__, "The viewer was restarted.")


def test_the_sessions_of_a_viewer_host_whose_process_is_gone_end(db: Database) -> None:
    beat_host(db, "mine", 10, "here")
    beat_host(db, "dead", 11, "here")
    left = taken_by(db, "dead")
    fresh = request_session(db, queued_run(db)).id

    orphans_end(db, running=set())

    assert get_session(db, left).state == "ended"
    assert get_session(db, left).message == "The viewer was restarted."
    assert get_session(db, fresh).state == "starting"


def test_the_sessions_of_living_viewer_hosts_stay(db: Database) -> None:
    beat_host(db, "mine", 10, "here")
    beat_host(db, "neighbour", 11, "here")
    beat_host(db, "elsewhere", 12, "there")
    sessions = [taken_by(db, host_id) for host_id in ("mine", "neighbour", "elsewhere")]

    orphans_end(db, running={11})

    assert [get_session(db, session).state for session in sessions] == ["starting"] * 3


def test_the_sessions_of_a_viewer_host_that_fell_silent_elsewhere_end(db: Database) -> None:
    beat_host(db, "elsewhere", 12, "there")
    age(db, viewer_hosts, 60.0)
    beat_host(db, "mine", 10, "here")
    left = taken_by(db, "elsewhere")

    orphans_end(db, running={12})

    assert get_session(db, left).state == "ended"


def test_a_session_needs_a_run(db: Database) -> None:
    with pytest.raises(NotFound, match="no run 'nobody'"):
        request_session(db, "nobody")


def test_a_worker_shows_what_it_has_and_what_it_runs(db: Database) -> None:
    machine = Machine(cores=16, processor="EPYC", gpu="H200", memory_total=128, executor="ray")
    worker_id = register_worker(db, "here", 123, 4, machine)
    claims = [(queued_run(db), claim_next(db, worker_id))[1] for _ in range(2)]
    beat(db, worker_id, memory_used=64)

    (worker,) = list_workers(db)

    assert (worker.cores, worker.processor, worker.gpu, worker.executor) == (16, "EPYC", "H200", "ray")
    assert (worker.memory_total, worker.memory_used) == (128, 64)
    assert worker.running == tuple(claim.run_id for claim in claims)
    assert worker.busy == 2


def test_a_draining_worker_takes_nothing_until_it_is_let(db: Database) -> None:
    draining, other = (register_worker(db, "here", pid, 1) for pid in (1, 2))
    set_draining(db, draining, True)
    first, second = queued_run(db), queued_run(db)

    assert claim(db, draining) is None
    assert claim_next(db, other).run_id == first
    assert [worker.draining for worker in list_workers(db)] == [True, False]
    set_draining(db, draining, False)
    assert claim_next(db, draining).run_id == second


def test_a_worker_that_has_ended_cannot_drain(db: Database) -> None:
    worker_id = register_worker(db, "here", 1, 1)
    retire(db, worker_id)

    with pytest.raises(NotFound, match=f"no worker '{worker_id}'"):
        set_draining(db, worker_id, True)
