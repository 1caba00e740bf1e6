"""PostgreSQL goes away and comes back while runs are trained."""

from __future__ import annotations

import signal

import pytest
from other_processes import wait_until
from postgres_server import PostgresServer
from worker_cases import queued_run, read_log, wait_for_state, worker, worker_process

from backend.store.database import Database
from backend.store.metrics import read_metrics
from backend.store.queue import reap_expired
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.states import RunState

pytestmark = pytest.mark.parametrize("engine", ["postgresql"], scope="module")


@pytest.mark.parametrize("ends_while_away", [False, True], ids=["goes on", "ends"])
def test_a_run_outlives_a_crash_of_the_database(
    db: Database, settings: Settings, postgres_server: PostgresServer, ends_while_away: bool
) -> None:
    run_id = queued_run(db)
    wait_for_it = "Trying again and again" if ends_while_away else "Metrics wait for the store"
    with worker(db, settings, "counts-far"):
        wait_until(lambda: max(read_metrics(db, run_id).step, default=0) >= 5)
        postgres_server.stop(signal.SIGQUIT)
        wait_until(lambda: wait_for_it in read_log(settings, run_id))
        postgres_server.start()
        run = wait_for_state(db, run_id, RunState.SUCCEEDED)

    assert run.attempt == 1
    assert read_metrics(db, run_id).step == list(range(1, 101))


def test_a_worker_can_end_while_the_database_is_away(
    db: Database, settings: Settings, postgres_server: PostgresServer
) -> None:
    run_id = queued_run(db)
    with worker_process(settings, "lasts") as process:
        wait_until(lambda: max(read_metrics(db, run_id).step, default=0) >= 5)
        postgres_server.stop()
        try:
            process.send_signal(signal.SIGTERM)
            wait_until(lambda: "Trying again and again" in read_log(settings, run_id))
            process.send_signal(signal.SIGTERM)
            assert process.wait(timeout=30) == 0
        finally:
            postgres_server.start()

    assert get_run(db, run_id).state is RunState.RUNNING
    assert reap_expired(db) == []
