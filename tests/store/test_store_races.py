"""What two processes decide in the same moment fits together."""

from __future__ import annotations

from functools import partial

from store_cases import at_once, claim_next, order

from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.order import set_priority
from backend.store.outcomes import Succeeded
from backend.store.queue import finish
from backend.store.runs import RunFilter, get_run, list_runs
from backend.store.states import RunState

ROUNDS = 5
"""Often enough that the two meet."""


def with_sldr(task: str, seed: int, threads: int) -> LaunchOrder:
    """Ask for a run whose locomotion runs no order with other threads shares."""
    return order(method="her-sldr", task=task, seeds=(seed,), overrides={"compute": {"threads": threads}})


def test_two_launches_at_once_share_one_locomotion_run(db: Database) -> None:
    for threads in range(1, ROUNDS + 1):
        at_once(*[partial(launch, db, with_sldr("FetchPush", seed, threads)) for seed in range(2)])

    assert list_runs(db, RunFilter(phases=["manipulation"]), 1).total == 2 * ROUNDS
    assert list_runs(db, RunFilter(phases=["locomotion"]), 1).total == ROUNDS


def test_a_run_starts_when_both_that_it_needs_end_at_once(db: Database) -> None:
    for threads in range(1, ROUNDS + 1):
        manipulation = launch(db, with_sldr("HandEggFull", 0, threads))[-1]
        claims = [claim_next(db) for _ in get_run(db, manipulation).needs]
        at_once(*[partial(finish, db, claim, Succeeded(1.0)) for claim in claims])

        assert get_run(db, manipulation).state is RunState.QUEUED
        finish(db, claim_next(db), Succeeded(1.0))


def test_two_that_give_the_same_runs_a_priority_do_not_wait_for_each_other(db: Database) -> None:
    run_ids = launch(db, order(seeds=tuple(range(60))))
    for _ in range(ROUNDS):
        at_once(partial(set_priority, db, run_ids, 1), partial(set_priority, db, run_ids[::-1], 2))

    assert len({run.priority for run in list_runs(db, RunFilter(), 100).rows}) == 1
