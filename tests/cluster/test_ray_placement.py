"""Runs go to nodes that have what they need free, wait for them, and are handed back where there are none."""

from __future__ import annotations

import socket
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NoReturn

import psutil
import pytest
from cluster_cases import Cluster, begin, process_of, wait_for_cycles, wait_for_end
from fake_attempts import fake_command
from other_processes import is_running, wait_until

from backend.store.database import Database
from backend.store.outcomes import HandedBack, Lost
from backend.store.settings import Settings
from worker.executors import Child

if TYPE_CHECKING:
    from worker.executors.ray import RayExecutor

pytestmark = pytest.mark.cluster

COUNT = "import os; print('sees', len(os.sched_getaffinity(0)), 'core for', os.environ['OMP_NUM_THREADS'], 'thread')"
COUNT_CORES = [sys.executable, "-c", COUNT]


@pytest.fixture
def complete(cluster: Cluster, connected: None) -> None:
    """Make sure that both nodes are there."""
    cluster.complete()


def ray_executor(settings: Settings, command: Sequence[str]) -> RayExecutor:
    from worker.executors.ray import RayExecutor  # Reads its environment when imported.

    return RayExecutor(settings, 1, command)


def end(child: Child) -> None:
    child.kill()
    wait_for_end(child)


def test_a_cluster_has_as_many_slots_as_runs_fit(settings: Settings, complete: None) -> None:
    assert ray_executor(settings, fake_command("counts")).count_slots() == 2


def test_an_attempt_ends_with_what_holds_it_on_its_node(db: Database, settings: Settings, complete: None) -> None:
    executor = ray_executor(settings, fake_command("lasts"))
    wait_until(executor.has_room)
    claimed, child = begin(db, executor)
    wait_for_cycles(db, claimed.run_id, child)
    pid = process_of(settings, claimed.run_id)

    psutil.Process(psutil.Process(pid).ppid()).kill()

    wait_until(lambda: not is_running(pid))
    wait_for_end(child)
    assert child.outcome() == Lost(f"The cluster lost what held its process on {socket.gethostname()}.")


def test_an_attempt_does_not_make_way_for_others(db: Database, settings: Settings, complete: None) -> None:
    claimed, child = begin(db, ray_executor(settings, fake_command("lasts")))
    wait_for_cycles(db, claimed.run_id, child)
    niceness = psutil.Process(process_of(settings, claimed.run_id)).nice()
    end(child)

    assert niceness == psutil.Process().nice()


def test_a_start_that_gets_lost_on_the_way_is_given_up(connected: None, monkeypatch: pytest.MonkeyPatch) -> None:
    from worker.executors import ray_child

    def get_lost(_: object) -> NoReturn:
        raise ray_child.ActorUnavailableError("the connection was reset", None)

    monkeypatch.setattr(ray_child, "_is_ready", lambda _: True)
    monkeypatch.setattr(ray_child.ray, "get", get_lost)
    monkeypatch.setattr(ray_child.ray, "kill", lambda host, no_restart: None)
    starting: Any = object()
    child = ray_child.RayChild(object(), starting, ray_child.Needs(2, 0), "4ad5e0")

    assert child.poll() == ray_child.EXIT_LOST
    assert child.outcome() == Lost("The cluster lost what held its process before it was placed.")
    assert child.is_settled()


@pytest.mark.slow
def test_a_third_attempt_waits_for_a_node(db: Database, settings: Settings, complete: None) -> None:
    executor = ray_executor(settings, fake_command("lasts"))
    wait_until(executor.has_room)
    (claimed, first), (_, second), (last, third) = begin(db, executor), begin(db, executor), begin(db, executor)
    wait_for_cycles(db, claimed.run_id, first)
    waits = not (settings.run_directory(last.run_id) / "log.txt").exists()
    has_room = executor.has_room()
    end(first)
    wait_for_cycles(db, last.run_id, third)
    end(second)
    end(third)

    assert waits
    assert not has_room


@pytest.mark.slow
def test_an_attempt_that_finds_no_node_is_handed_back(
    db: Database, settings: Settings, complete: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    from worker.executors import ray_child

    executor = ray_executor(settings, fake_command("lasts"))
    wait_until(executor.has_room)
    placed = [begin(db, executor) for _ in range(2)]
    for claimed, child in placed:
        wait_for_cycles(db, claimed.run_id, child)
    monkeypatch.setattr(ray_child, "PLACEMENT_S", 0.5)
    _, child = begin(db, executor)
    wait_for_end(child)
    for _, other in placed:
        end(other)

    assert child.outcome() == HandedBack(
        "For 0 s no node of the cluster had 1 core free, or none could start it.", ray_child.PLACE_AGAIN_S
    )


def test_a_run_that_no_node_can_hold_is_handed_back_at_once(db: Database, settings: Settings, complete: None) -> None:
    from worker.executors.ray_child import EXIT_UNPLACED, PLACE_AGAIN_S

    claimed, child = begin(db, ray_executor(settings, fake_command("counts")), {"compute": {"threads": 3}})

    assert child.poll() == EXIT_UNPLACED
    assert child.outcome() == HandedBack(
        "It needs 3 cores, and no node of the cluster has as much; add one, or cancel it.", PLACE_AGAIN_S
    )
    assert not settings.run_directory(claimed.run_id).exists()


def test_a_node_that_sees_another_data_directory_gives_the_run_back(
    db: Database, settings: Settings, complete: None
) -> None:
    executor = ray_executor(settings, fake_command("counts"))
    (settings.home / "home-id").write_text("another")
    _, child = begin(db, executor)
    wait_for_end(child)

    outcome = child.outcome()
    assert isinstance(outcome, HandedBack)
    assert f"does not see the data directory {settings.home} of its worker" in outcome.reason


def test_a_run_that_takes_every_core_sees_only_its_own(db: Database, settings: Settings, complete: None) -> None:
    executor = ray_executor(settings, COUNT_CORES)
    claimed, child = begin(db, executor, {"compute": {"threads": 0}})

    assert wait_for_end(child) == 0
    assert (settings.run_directory(claimed.run_id) / "log.txt").read_text() == "sees 1 core for 1 thread\n"
