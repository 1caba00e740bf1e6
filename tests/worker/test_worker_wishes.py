"""What a person asks of a run or a worker happens soon, and a training that hangs is tried again."""

from __future__ import annotations

from datetime import timedelta

from fake_trainings import fake_command
from other_processes import is_running, wait_until
from sqlalchemy import update
from worker_cases import queued_run, wait_for_state, wait_for_training, worker

from backend.store.actions import Action, act_on
from backend.store.attempts import list_attempts
from backend.store.database import Database, current_time
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.tables import runs
from backend.store.workers import list_workers, set_draining
from worker.executors.local import LocalExecutor
from worker.supervisor import HANG_S


class GrowingExecutor(LocalExecutor):
    """Get a GPU while it works, as a cluster does."""

    gpu_has_joined = False

    def has_gpu(self) -> bool:
        return self.gpu_has_joined


def cycles(db: Database, run_id: str) -> list[int]:
    return read_metrics(db, run_id).step


def age_progress(db: Database, run_id: str, seconds: float) -> None:
    """Make the trainer's newest sign of progress so old."""
    with db.write() as conn:
        then = current_time(conn) - timedelta(seconds=seconds)
        conn.execute(update(runs).where(runs.c.id == run_id).values(progress_at=then))


def test_a_pause_ends_the_cycle_checkpoints_and_frees_the_slot(db: Database, settings: Settings) -> None:
    first, second = queued_run(db, 0), queued_run(db, 1)
    with worker(db, settings, "lasts"):
        pid = wait_for_training(db, settings, first)
        asked_at_cycle = cycles(db, first)[-1]
        act_on(db, Action.PAUSE, [first])
        wait_for_state(db, first, RunState.PAUSED)
        wait_until(lambda: not is_running(pid))
        wait_for_training(db, settings, second)

    stopped_at = int((settings.run_directory(first) / "cycle.txt").read_text())
    assert stopped_at >= asked_at_cycle
    assert cycles(db, first) == list(range(1, stopped_at + 1))
    assert get_run(db, first).state is RunState.PAUSED


def test_a_resumed_run_goes_on_from_its_checkpoint(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "lasts"):
        wait_for_training(db, settings, run_id)
        act_on(db, Action.PAUSE, [run_id])
        wait_for_state(db, run_id, RunState.PAUSED)
        stopped_at = int((settings.run_directory(run_id) / "cycle.txt").read_text())
        act_on(db, Action.RESUME, [run_id])
        wait_until(lambda: cycles(db, run_id)[-1] > stopped_at)

    assert [row.first_cycle for row in list_attempts(db, run_id)] == [1, stopped_at + 1]
    assert [event.event for event in list_events(db, run_id)][:6] == [
        "created",
        "claimed",
        "pause_requested",
        "paused",
        "resumed",
        "claimed",
    ]


def test_a_training_that_hangs_is_ended_and_tried_again(db: Database, settings: Settings) -> None:
    run_id = queued_run(db)
    with worker(db, settings, "hangs-once"):
        pid = wait_for_training(db, settings, run_id)
        age_progress(db, run_id, HANG_S + 60.0)
        run = wait_for_state(db, run_id, RunState.SUCCEEDED)

    first, second = list_attempts(db, run_id)
    assert not is_running(pid)
    assert run.attempt == 2
    assert (first.outcome, first.reason) == (
        "retried",
        "It showed no progress for 11 minutes and was ended; it goes on from its checkpoint.",
    )
    assert second.outcome == "succeeded"


def test_a_draining_worker_keeps_what_it_runs_and_takes_nothing_else(db: Database, settings: Settings) -> None:
    first, second = queued_run(db, 0), queued_run(db, 1)
    with worker(db, settings, "lasts"):
        wait_for_training(db, settings, first)
        worker_id = list_workers(db)[0].id
        set_draining(db, worker_id, True)
        act_on(db, Action.PAUSE, [first])
        wait_for_state(db, first, RunState.PAUSED)
        wait_until(lambda: list_workers(db)[0].busy == 0)
        beat_at = list_workers(db)[0].beat_at
        wait_until(lambda: list_workers(db)[0].beat_at > beat_at)
        assert get_run(db, second).state is RunState.QUEUED
        set_draining(db, worker_id, False)
        wait_for_state(db, second, RunState.RUNNING)


def test_a_run_that_asks_for_a_gpu_waits_until_there_is_one(db: Database, settings: Settings) -> None:
    order = LaunchOrder("FetchPush", "manipulation", "her", [0], "smoke", {"compute": {"device": "cuda"}})
    (wants_gpu,) = launch(db, order)
    plain = queued_run(db, 1)
    executor = GrowingExecutor(settings, fake_command("counts"))
    with worker(db, settings, "counts", executor=executor):
        wait_for_state(db, plain, RunState.SUCCEEDED)
        assert get_run(db, wants_gpu).state is RunState.QUEUED
        executor.gpu_has_joined = True
        wait_for_state(db, wants_gpu, RunState.SUCCEEDED)


def test_a_worker_says_what_its_machine_has(db: Database, settings: Settings) -> None:
    with worker(db, settings, "counts"):
        wait_until(lambda: any(row.memory_used for row in list_workers(db)))
        (row,) = list_workers(db)

    assert row.cores >= 1
    assert 0 < row.memory_used < row.memory_total
    assert (row.executor, row.draining) == ("local", False)
