"""A supervisor brings runs to their end, whatever happens to their processes."""

from __future__ import annotations

import os
import signal
import threading
import time
from dataclasses import replace

import pytest
from other_processes import is_running, wait_until
from worker_cases import TIMING, queued_run, read_log, wait_for_state, wait_for_training, worker, worker_process

from backend.store.actions import request_cancel
from backend.store.database import Database
from backend.store.errors import StoreUnavailable
from backend.store.metrics import read_metrics
from backend.store.queue import reap_expired
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.workers import list_workers
from sldr_core.errors import InvalidConfig
from worker import __main__ as process
from worker import supervisor
from worker.executors.local import LocalExecutor
from worker.supervisor import Supervisor

CANCEL_WITHIN_S = 10.0


def test_a_queued_run_is_trained_to_its_end(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "counts"):
        run = wait_for_state(db, run_id, RunState.SUCCEEDED)

    assert run.success_rate == 0.5
    assert run.progress is not None
    assert (run.progress.success_rate, run.progress.env_steps_per_s) == (0.5, 10.0)
    assert read_metrics(db, run_id).step == [1, 2, 3, 4, 5]
    assert "Attempt 1 has ended: Succeeded" in read_log(settings, run_id)


def test_a_killed_child_is_tried_again_and_goes_on(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "lasts"):
        pid = wait_for_training(db, settings, run_id)
        wait_until(lambda: (settings.run_directory(run_id) / "cycle.txt").exists())
        os.kill(pid, signal.SIGKILL)
        wait_until(lambda: max(read_metrics(db, run_id).attempt, default=0) == 2)

    lost = next(event for event in list_events(db, run_id) if event.event == "lost")
    assert lost.state is RunState.QUEUED
    assert lost.detail == "Its process was killed by SIGKILL (the machine may be out of memory)."


def test_a_run_whose_child_died_finishes(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "dies-once"):
        run = wait_for_state(db, run_id, RunState.SUCCEEDED)

    assert run.attempt == 2


def test_an_attempt_removes_what_killed_processes_left_half_written_and_nothing_of_living_ones(
    db: Database, settings: Settings
) -> None:
    run_id = queued_run(db)
    directory = settings.run_directory(run_id)
    directory.mkdir(parents=True)
    dead, living = directory / ".checkpoint.pt.4194305.tmp", directory / f".episode-1-0.mp4.{os.getpid()}.tmp"
    for path in (dead, living):
        path.touch()

    with worker(db, settings, "counts"):
        wait_for_state(db, run_id, RunState.SUCCEEDED)

    assert (dead.exists(), living.exists()) == (False, True)


def test_cancel_stops_a_child_that_listens(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "lasts"):
        pid = wait_for_training(db, settings, run_id)
        request_cancel(db, run_id)
        wait_for_state(db, run_id, RunState.CANCELLED)
        wait_until(lambda: not is_running(pid))

    assert "Attempt 1 has ended: Cancelled" in read_log(settings, run_id)


def test_cancel_stops_a_child_that_does_not_listen_within_ten_seconds(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    in_service = replace(TIMING, poll_s=0.5, cancel_grace_s=5.0)
    with worker(db, settings, "is-deaf", in_service):
        pid = wait_for_training(db, settings, run_id)
        asked_at = time.monotonic()
        request_cancel(db, run_id)
        wait_for_state(db, run_id, RunState.CANCELLED)
        took_s = time.monotonic() - asked_at

    assert took_s < CANCEL_WITHIN_S
    assert not is_running(pid)


def test_an_error_that_would_repeat_is_not_retried(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "diverges"):
        run = wait_for_state(db, run_id, RunState.FAILED)

    assert (run.attempt, run.reason) == (1, "Metric critic/task/loss became nan; lower the learning rate.")


def test_an_unexpected_error_is_retried_and_its_traceback_logged(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "breaks"):
        run = wait_for_state(db, run_id, RunState.FAILED)

    assert run.attempt == 3
    assert run.reason == (
        "The training ended by an unexpected RuntimeError: the simulation exploded; the log says where. "
        "It was tried 3 times."
    )
    assert read_log(settings, run_id).count("Traceback") == 3


def test_sigterm_hands_the_run_back_after_its_checkpoint(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker_process(settings, "lasts") as process:
        wait_for_training(db, settings, run_id)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=30) == 0

    run = get_run(db, run_id)
    assert (run.state, run.reason) == (
        RunState.QUEUED,
        "Its worker was asked to end; it goes on from its checkpoint.",
    )
    assert list_workers(db) == []


def test_a_second_worker_goes_on_where_the_first_stopped(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "lasts") as first:
        wait_until(lambda: max(read_metrics(db, run_id).step, default=0) >= 5)
        first.ask_to_stop()
        wait_for_state(db, run_id, RunState.QUEUED)
    stopped_at = int((settings.run_directory(run_id) / "cycle.txt").read_text())

    with worker(db, settings, "lasts"):
        wait_until(lambda: max(read_metrics(db, run_id).step, default=0) > stopped_at)

    columns = read_metrics(db, run_id)
    assert columns.step == list(range(1, len(columns.step) + 1))
    assert columns.attempt[stopped_at - 1 : stopped_at + 1] == [1, 2]


def test_a_child_ends_with_its_supervisor(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker_process(settings, "is-deaf") as process:
        pid = wait_for_training(db, settings, run_id)
        process.send_signal(signal.SIGKILL)
        process.wait()
        wait_until(lambda: not is_running(pid))

    assert get_run(db, run_id).state is RunState.RUNNING


def test_the_run_of_a_dead_worker_is_taken_over(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "counts", replace(TIMING, lease_s=0.0, heartbeat_s=3600.0, reap_s=3600.0)):
        wait_until(lambda: get_run(db, run_id).state is not RunState.QUEUED)
        wait_until(lambda: reap_expired(db, backoff_s=0.0) == [run_id])
        run = wait_for_state(db, run_id, RunState.SUCCEEDED)

    assert run.attempt == 2
    assert "lost" in [event.event for event in list_events(db, run_id)]


def test_a_child_whose_run_went_to_another_worker_stops_itself(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "lasts", replace(TIMING, lease_s=1.0, heartbeat_s=3600.0, reap_s=3600.0)):
        pid = wait_for_training(db, settings, run_id)
        wait_until(lambda: reap_expired(db, backoff_s=3600.0) == [run_id])
        wait_until(lambda: not is_running(pid))

    assert "Attempt with fence 1 of run" in read_log(settings, run_id)


def test_a_lost_run_is_noticed_by_the_heartbeat_and_its_child_killed(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "is-deaf", replace(TIMING, lease_s=1.0, heartbeat_s=2.0, reap_s=3600.0)):
        pid = wait_for_training(db, settings, run_id)
        wait_until(lambda: reap_expired(db, backoff_s=3600.0) == [run_id])
        wait_until(lambda: not is_running(pid))

    assert get_run(db, run_id).state is RunState.QUEUED


def test_a_worker_without_slots_is_refused(db: Database, settings: Settings) -> None:
    with pytest.raises(InvalidConfig, match="slots: a worker needs at least 1, got 0"):
        Supervisor(db, LocalExecutor(settings), 0)


def test_a_worker_can_end_while_it_registers_at_a_store_that_is_locked(
    db: Database, settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    tried = threading.Event()

    def register(*_: object) -> str:
        tried.set()
        raise StoreUnavailable("The database is locked.")

    monkeypatch.setattr(supervisor, "register_worker", register)
    waiting = Supervisor(db, LocalExecutor(settings), 1, TIMING)
    thread = threading.Thread(target=waiting.run, daemon=True)
    thread.start()
    tried.wait()
    waiting.ask_to_stop()
    thread.join(timeout=30.0)

    assert not thread.is_alive()


def test_a_worker_that_is_interrupted_before_it_has_opened_the_store_shows_no_trace(
    settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(_: Settings) -> Database:
        raise KeyboardInterrupt

    monkeypatch.setattr("sys.argv", ["worker"])
    monkeypatch.setattr(process, "load_settings", lambda: settings)
    monkeypatch.setattr(process, "open_database", interrupt)

    assert process.main() == 0
