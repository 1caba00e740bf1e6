"""A worker that was stopped past its lease gives way, and does not take its own absence for that of others."""

from __future__ import annotations

import os
import signal
import sqlite3
import time
from contextlib import closing
from dataclasses import replace

import pytest
from fake_trainings import TIMING
from other_processes import is_running, wait_until
from worker_cases import queued_run, wait_for_training, worker, worker_process

from backend.store.attempts import list_attempts
from backend.store.database import Database
from backend.store.metrics import read_metrics
from backend.store.queue import claim
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from worker import presence
from worker.presence import Presence

SHORT_LEASE_S = 3.0


def stop(settings: Settings, *pids: int) -> None:
    """Stop processes, at a moment when none of them keeps all others from writing to SQLite."""
    while True:
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
        if not is_locked(settings):
            return
        for pid in pids:
            os.kill(pid, signal.SIGCONT)
        time.sleep(0.05)


def is_locked(settings: Settings) -> bool:
    """Tell whether somebody holds the lock for writing, and does not let go of it."""
    if not settings.database_url.startswith("sqlite"):
        return False
    with closing(sqlite3.connect(settings.home / "sldr.db", timeout=1.0, isolation_level=None)) as connection:
        try:
            connection.execute("BEGIN IMMEDIATE")
        except sqlite3.OperationalError:
            return True
        connection.execute("ROLLBACK")
    return False


def points(db: Database, run_id: str, attempt: int) -> list[int]:
    columns = read_metrics(db, run_id, superseded=True)
    return [cycle for cycle, by in zip(columns.step, columns.attempt, strict=True) if by == attempt]


def test_a_worker_stopped_past_its_lease_ends_its_child_and_none_of_its_late_writes_is_taken(
    db: Database, settings: Settings
) -> None:
    run_id = queued_run(db)
    with worker_process(settings, "lasts", SHORT_LEASE_S) as stopped:
        child = wait_for_training(db, settings, run_id)
        stop(settings, stopped.pid, child)
        try:
            with worker_process(settings, "lasts", SHORT_LEASE_S):
                wait_until(lambda: len(list_attempts(db, run_id)) == 2)
                before = points(db, run_id, attempt=1)
                os.kill(stopped.pid, signal.SIGCONT)
                os.kill(child, signal.SIGCONT)
                wait_until(lambda: not is_running(child))
                wait_until(lambda: len(points(db, run_id, attempt=2)) > 3)
                assert stopped.poll() is None
        finally:
            os.kill(stopped.pid, signal.SIGCONT)

    assert points(db, run_id, attempt=1) == before
    assert get_run(db, run_id).attempt == 2
    assert "gave no sign of life" in (list_attempts(db, run_id)[0].reason or "")


def test_a_worker_that_wakes_up_kills_a_child_that_does_not_notice(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker_process(settings, "is-deaf", SHORT_LEASE_S) as stopped:
        child = wait_for_training(db, settings, run_id)
        stop(settings, stopped.pid)
        try:
            with worker_process(settings, "counts", SHORT_LEASE_S):
                wait_until(lambda: "lost" in [event.event for event in list_events(db, run_id)])
                assert is_running(child)
                os.kill(stopped.pid, signal.SIGCONT)
                wait_until(lambda: not is_running(child))
        finally:
            os.kill(stopped.pid, signal.SIGCONT)


def test_a_worker_that_begins_does_not_judge_others_before_they_had_time_to_be_heard(
    db: Database, settings: Settings
) -> None:
    run_id = queued_run(db)
    # As when the store was away for longer than a lease, and this worker is the first that reaches it again.
    lost = claim(db, "another", lease_s=0.01)
    assert lost is not None
    begun = time.monotonic()
    with worker(db, settings, "counts", replace(TIMING, lease_s=SHORT_LEASE_S)):
        wait_until(lambda: "lost" in [event.event for event in list_events(db, run_id)])
    # Nobody but this machine uses a file of SQLite, so there was no such time.
    assert db.engine_name == "sqlite" or time.monotonic() - begun >= SHORT_LEASE_S


class Clock:
    """Stand in for the wall clock."""

    def __init__(self) -> None:
        self.now = 1000.0

    def time(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(presence, "time", clock)
    return clock


def test_a_worker_that_looks_around_all_the_time_may_judge_others(clock: Clock) -> None:
    watched = Presence(patience_s=60.0)
    for _ in range(100):
        clock.now += 0.5
        watched.note_turn()
        assert watched.is_steady


@pytest.mark.parametrize("jump_s", [3600.0, -3600.0])
def test_a_worker_that_slept_waits_for_a_lease_before_it_judges_others(clock: Clock, jump_s: float) -> None:
    watched = Presence(patience_s=60.0)
    clock.now += jump_s
    watched.note_turn()
    assert not watched.is_steady
    for _ in range(12):
        clock.now += 5.0
        watched.note_turn()

    assert watched.is_steady


def test_a_worker_whose_store_was_away_waits_for_a_lease_as_well(clock: Clock) -> None:
    watched = Presence(patience_s=60.0)
    watched.note_outage()
    assert not watched.is_steady
    clock.now += 60.0

    assert watched.is_steady
