"""A run outlives the node that it runs on, and its worker; nothing of it outlives the worker."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import pytest
from cluster_cases import Cluster, process_of, queue_run
from other_processes import is_running, wait_until

from backend.store.database import Database
from backend.store.files import list_files
from backend.store.metrics import read_metrics
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from backend.store.states import ENDED, RunState

pytestmark = pytest.mark.cluster

WORKER = Path(__file__).with_name("cluster_worker.py")
LAST_CYCLE = 200
"""Of a child that strolls."""
REAL_EPOCHS = 12
"""Long enough to be killed in the middle."""
REAL_PATIENCE_S = 240.0


def fake_worker(cluster: Cluster, behaviour: str) -> list[str]:
    return [sys.executable, str(WORKER), cluster.address, str(cluster.home), behaviour]


@contextmanager
def running(command: list[str], settings: Settings) -> Generator[subprocess.Popen[bytes]]:
    """Run a supervisor in a process of its own."""
    process = subprocess.Popen(command, env={**os.environ, **settings.as_environment()})
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def wait_for_cycle(db: Database, run_id: str, cycle: int) -> None:
    wait_until(lambda: max(read_metrics(db, run_id).step, default=0) >= cycle)


def test_a_run_goes_on_elsewhere_when_its_node_is_killed(db: Database, settings: Settings, cluster: Cluster) -> None:
    cluster.complete()
    run_id = queue_run(db)
    with running(fake_worker(cluster, "strolls"), settings):
        wait_for_cycle(db, run_id, 20)
        lost_node = cluster.node_of(process_of(settings, run_id)).pid
        cluster.kill_node_of(process_of(settings, run_id))
        wait_until(lambda: max(read_metrics(db, run_id).attempt) == 2)
        new_node = cluster.node_of(process_of(settings, run_id)).pid
        wait_until(lambda: get_run(db, run_id).state in ENDED)

    run, columns = get_run(db, run_id), read_metrics(db, run_id)
    assert (run.state, run.attempt) == (RunState.SUCCEEDED, 2)
    assert columns.step == sorted(set(columns.step))
    assert columns.step[-1] == LAST_CYCLE
    assert columns.step[columns.attempt.index(2)] > 20, "it began anew"
    assert new_node != lost_node
    lost = [event for event in list_events(db, run_id) if event.event == "lost"]
    assert [event.detail for event in lost] == [f"The cluster lost its node on {socket.gethostname()}."]


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["postgresql"], indirect=True)
def test_a_real_run_goes_on_from_its_checkpoint_elsewhere(db: Database, settings: Settings, cluster: Cluster) -> None:
    cluster.complete()
    run_id = queue_run(db, {"loop": {"epochs": REAL_EPOCHS}})
    command = [sys.executable, "-m", "worker", "--executor", "ray", "--address", cluster.address, "--cores", "1"]
    with running(command, settings):
        wait_until(lambda: "checkpoint.pt" in [file.name for file in list_files(db, run_id)], REAL_PATIENCE_S)
        cluster.kill_node_of(process_of(settings, run_id))
        wait_until(lambda: get_run(db, run_id).state in ENDED, REAL_PATIENCE_S)

    run, columns = get_run(db, run_id), read_metrics(db, run_id)
    assert (run.state, run.attempt) == (RunState.SUCCEEDED, 2), run.reason
    assert columns.step == list(range(1, columns.step[-1] + 1))
    assert columns.epoch[-1] == REAL_EPOCHS
    assert 0 < columns.attempt.index(2) < len(columns.step)


@pytest.mark.slow
def test_nothing_outlives_a_worker_that_is_killed(db: Database, settings: Settings, cluster: Cluster) -> None:
    run_id = queue_run(db)
    with running(fake_worker(cluster, "lasts"), settings) as process:
        wait_for_cycle(db, run_id, 1)
        process.kill()
        process.wait()
        wait_until(lambda: not is_running(process_of(settings, run_id)))

    assert get_run(db, run_id).state is RunState.RUNNING


@pytest.mark.slow
def test_sigterm_hands_the_run_back_after_its_checkpoint(db: Database, settings: Settings, cluster: Cluster) -> None:
    run_id = queue_run(db)
    with running(fake_worker(cluster, "lasts"), settings) as process:
        wait_for_cycle(db, run_id, 1)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=60) == 0

    run = get_run(db, run_id)
    assert (run.state, run.reason) == (RunState.QUEUED, "Its worker was asked to end; it goes on from its checkpoint.")
