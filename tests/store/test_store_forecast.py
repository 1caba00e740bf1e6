"""The queue page says in which order runs start, what each waits for, and when, from what was measured."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from sqlalchemy import update
from store_cases import claim_next, order, put_in_state

from backend.store.actions import Action, act_on
from backend.store.database import Database
from backend.store.forecast import QueueEntry, list_queue
from backend.store.launches import launch
from backend.store.metrics import append_metrics
from backend.store.order import set_priority
from backend.store.outcomes import Failed, Succeeded
from backend.store.progress import Progress
from backend.store.queue import claim, finish
from backend.store.speeds import Speeds, measure_speeds
from backend.store.states import RunState
from backend.store.tables import attempts, runs, workers
from backend.store.workers import Machine, register_worker, set_draining

START = datetime(2026, 1, 1, tzinfo=UTC)
GPU = {"compute": {"device": "cuda"}}


def measured_run(db: Database, seconds: float, **changes) -> None:
    """Let a run like those of `order(**changes)` have succeeded in so many seconds."""
    launch(db, order(**changes))
    claimed = claim_next(db)
    finish(db, claimed, Succeeded(1.0))
    with db.write() as conn:
        this = attempts.c.run_id == claimed.run_id
        conn.execute(update(attempts).where(this).values(started_at=START, ended_at=START + timedelta(seconds=seconds)))


def from_elsewhere(db: Database) -> None:
    """Let all runs that are there have come in a study file."""
    with db.write() as conn:
        conn.execute(update(runs).values(origin="0" * 64))


def in_minutes(entries: list[QueueEntry]) -> list[tuple[float | None, float | None]]:
    """Return start and end of each, counted from the first start."""
    starts = [entry.starts_at for entry in entries if entry.starts_at]
    first = min(starts, default=START)

    def minutes(at: datetime | None) -> float | None:
        return None if at is None else round((at - first).total_seconds() / 60.0, 2)

    return [(minutes(entry.starts_at), minutes(entry.ends_at)) for entry in entries]


def test_nothing_waits_in_an_empty_queue(db: Database) -> None:
    assert list_queue(db) == []


def test_runs_start_one_after_the_other_on_one_slot(db: Database) -> None:
    measured_run(db, 600.0)
    launched = launch(db, order(seeds=(1, 2, 3)))
    register_worker(db, "here", 1, slots=1)

    entries = list_queue(db)

    assert [entry.run.id for entry in entries] == launched
    assert [entry.position for entry in entries] == [1, 2, 3]
    assert in_minutes(entries) == [(0.0, 10.0), (10.0, 20.0), (20.0, 30.0)]


def test_runs_start_beside_each_other_on_two_workers(db: Database) -> None:
    measured_run(db, 600.0)
    launch(db, order(seeds=(1, 2, 3)))
    register_worker(db, "here", 1, slots=1)
    register_worker(db, "there", 1, slots=1)

    assert in_minutes(list_queue(db)) == [(0.0, 10.0), (0.0, 10.0), (10.0, 20.0)]


def test_a_higher_priority_is_expected_first(db: Database) -> None:
    a, b = launch(db, order(seeds=(1, 2)))
    set_priority(db, [b], 1)

    assert [entry.run.id for entry in list_queue(db)] == [b, a]


def test_a_run_is_expected_to_take_as_long_as_its_like(db: Database) -> None:
    measured_run(db, 600.0, method="her")
    measured_run(db, 60.0, method="ddpg")
    launch(db, order(method="ddpg", seeds=(1,)))
    register_worker(db, "here", 1, slots=1)

    assert in_minutes(list_queue(db)) == [(0.0, 1.0)]


def test_a_run_unlike_all_others_is_expected_to_take_as_long_as_those_of_its_preset(db: Database) -> None:
    measured_run(db, 600.0, task="FetchSlide")
    launch(db, order())
    register_worker(db, "here", 1, slots=1)

    assert in_minutes(list_queue(db)) == [(0.0, 10.0)]


def test_runs_of_another_installation_say_nothing_of_the_time_here(db: Database) -> None:
    measured_run(db, 600.0)
    from_elsewhere(db)
    launch(db, order(seeds=(1,)))
    register_worker(db, "here", 1, slots=1)

    (entry,) = list_queue(db)

    assert entry.ends_at is None


def test_runs_of_another_installation_say_nothing_of_what_a_study_will_cost(db: Database) -> None:
    measured_run(db, 600.0)
    from_elsewhere(db)

    with db.read() as conn:
        assert measure_speeds(conn) == Speeds()


def test_no_time_is_told_that_nobody_can_know(db: Database) -> None:
    launch(db, order(seeds=(1, 2)))
    register_worker(db, "here", 1, slots=1)

    first, second = list_queue(db)

    assert first.starts_at is not None
    assert (first.ends_at, second.starts_at, second.ends_at) == (None, None, None)


def test_a_running_run_ends_when_it_says(db: Database) -> None:
    measured_run(db, 600.0)
    launch(db, order(seeds=(1, 2)))
    worker_id = register_worker(db, "here", 1, slots=1)
    claimed = claim_next(db, worker_id)
    append_metrics(db, claimed, [], Progress(1, 2, 0, 0, 0, 0.5, None, None, None, None, 120.0))

    running, queued = list_queue(db)

    assert (running.run.id, running.position, queued.position) == (claimed.run_id, None, 1)
    assert running.waits_for == "It runs on here."
    assert running.ends_at is not None
    assert queued.starts_at == running.ends_at
    assert timedelta(seconds=110) < running.ends_at - datetime.now(UTC) <= timedelta(seconds=120)


def test_a_run_that_was_half_done_is_expected_to_take_half_as_long(db: Database) -> None:
    measured_run(db, 600.0)
    launch(db, order(seeds=(1,)))
    claimed = claim_next(db)
    append_metrics(db, claimed, [], Progress(1, 2, 0, 0, 0, 0.5, None, None, None, None, None))
    put_in_state(db, claimed.run_id, RunState.QUEUED)
    register_worker(db, "here", 1, slots=1)

    assert in_minutes(list_queue(db)) == [(0.0, 5.0)]


def test_a_blocked_run_starts_when_what_it_needs_has_ended(db: Database) -> None:
    measured_run(db, 600.0)
    locomotion, manipulation = launch(db, order(method="her-sldr", seeds=(0,)))
    (other,) = launch(db, order(seeds=(5,)))
    register_worker(db, "here", 1, slots=2)

    entries = list_queue(db)

    assert [entry.run.id for entry in entries] == [locomotion, other, manipulation]
    assert in_minutes(entries) == [(0.0, 10.0), (0.0, 10.0), (10.0, 20.0)]
    assert (entries[2].position, entries[2].waits_for) == (None, f"Waits for the locomotion run {locomotion}.")


def test_a_run_below_its_gate_has_no_time_and_says_why(db: Database) -> None:
    launch(db, order(method="her-sldr", overrides={"sldr": {"gate": 0.95}}))
    finish(db, claim_next(db), Succeeded(0.5))
    register_worker(db, "here", 1, slots=1)

    (entry,) = list_queue(db)

    assert (entry.position, entry.starts_at) == (None, None)
    assert "below the gate of 95.0%; release it anyway" in entry.waits_for


def test_paused_runs_come_last(db: Database) -> None:
    a, b = launch(db, order(seeds=(1, 2)))
    act_on(db, Action.PAUSE, [a])

    entries = list_queue(db)

    assert [entry.run.id for entry in entries] == [b, a]
    assert entries[1].waits_for == "It is paused; resume it to let it go on."


def test_a_run_for_a_gpu_waits_for_a_worker_that_has_one(db: Database) -> None:
    measured_run(db, 600.0)
    launch(db, order(seeds=(1,), overrides=GPU))
    (plain,) = launch(db, order(seeds=(2,)))
    register_worker(db, "here", 1, slots=1)

    first, second = list_queue(db)

    assert (first.run.id, first.starts_at is None) == (plain, False)
    assert second.waits_for == "It asks for a GPU, and no worker that takes runs has one."
    assert second.starts_at is None
    register_worker(db, "there", 1, 1, Machine(gpu="H200"))
    assert in_minutes(list_queue(db)) == [(0.0, 10.0), (0.0, 10.0)]


def test_a_worker_without_a_gpu_leaves_runs_that_ask_for_one(db: Database) -> None:
    launch(db, order(seeds=(1,), overrides=GPU))
    (plain,) = launch(db, order(seeds=(2,)))

    taken = claim(db, "worker-1", with_gpu=False)

    assert taken is not None
    assert taken.run_id == plain
    assert claim(db, "worker-1", with_gpu=False) is None
    assert claim_next(db).config.compute.device == "cuda"


@pytest.mark.parametrize(
    ("situation", "sentence"),
    [
        ("nobody", "No worker is alive; start one with `sldr worker`."),
        ("silent", "No worker is alive; start one with `sldr worker`."),
        ("draining", "Every worker is draining; let one take runs again, or start another."),
        ("free", "A worker takes it within seconds."),
        ("busy", "It is next, as soon as a slot is free."),
    ],
)
def test_a_queued_run_says_what_it_waits_for(db: Database, situation: str, sentence: str) -> None:
    launch(db, order(seeds=(1,)))
    if situation != "nobody":
        worker_id = register_worker(db, "here", 1, slots=1)
        if situation == "silent":
            with db.write() as conn:
                conn.execute(update(workers).values(beat_at=START))
        if situation == "draining":
            set_draining(db, worker_id, True)
        if situation == "busy":
            claim_next(db, worker_id)
            launch(db, order(seeds=(2,)))

    assert list_queue(db)[-1].waits_for == sentence


def test_the_runs_ahead_are_counted(db: Database) -> None:
    launch(db, order(seeds=(1, 2, 3)))
    register_worker(db, "here", 1, slots=1)

    assert [entry.waits_for for entry in list_queue(db)][1:] == [
        "It waits for a free slot, behind 1 other run.",
        "It waits for a free slot, behind 2 other runs.",
    ]


def test_a_run_that_waits_for_its_next_attempt_says_why(db: Database) -> None:
    launch(db, order(seeds=(1,)))
    finish(db, claim_next(db), Failed("It broke.", retry=True), backoff_s=60.0)
    register_worker(db, "here", 1, slots=1)

    (entry,) = list_queue(db)

    assert entry.waits_for.startswith("It broke. It is tried again in ")
    assert entry.starts_at == entry.run.not_before


def test_what_a_person_has_asked_of_a_running_run_is_said(db: Database) -> None:
    launch(db, order(seeds=(1,)))
    claimed = claim_next(db, register_worker(db, "here", 1, slots=1))
    act_on(db, Action.PAUSE, [claimed.run_id])
    assert list_queue(db)[0].waits_for == "It pauses on here at the end of its cycle."
    act_on(db, Action.CANCEL, [claimed.run_id])
    assert list_queue(db)[0].waits_for == "It is being cancelled on here."


def test_a_run_whose_worker_is_gone_says_so(db: Database) -> None:
    launch(db, order(seeds=(1,)))
    claim_next(db, "worker-1")

    assert "worker-1 gives no sign of life" in list_queue(db)[0].waits_for


def test_deleted_and_ended_runs_are_not_in_the_queue(db: Database) -> None:
    ended, deleted, kept = launch(db, order(seeds=(1, 2, 3)))
    finish(db, claim_next(db), Succeeded(1.0))
    act_on(db, Action.DELETE, [deleted])

    assert [entry.run.id for entry in list_queue(db)] == [kept]
    assert ended != kept
