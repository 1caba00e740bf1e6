"""Runs in the situations that the tests of the store begin with."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

from sqlalchemy import update

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Succeeded
from backend.store.queue import claim, finish
from backend.store.states import RunState
from backend.store.tables import runs
from sldr_core.records import Step

WORKER = "worker-1"


def order(method: str = "her", seeds: tuple[int, ...] = (0,), **changes) -> LaunchOrder:
    """Ask for small manipulation runs of FetchPush."""
    values = {"task": "FetchPush", "phase": "manipulation", "preset": "smoke", **changes}
    return LaunchOrder(method=method, seeds=seeds, **values)


def queued_run(db: Database) -> str:
    """Queue a run that needs no other."""
    return launch(db, order())[0]


def claimed_run(db: Database) -> Claim:
    """Queue such a run and claim it."""
    queued_run(db)
    return claim_next(db)


def claim_next(db: Database, worker_id: str = WORKER, lease_s: float = 60.0) -> Claim:
    """Claim what is next, which must be something."""
    claimed = claim(db, worker_id, lease_s)
    assert claimed is not None
    return claimed


def put_in_state(db: Database, run_id: str, state: RunState) -> None:
    """Put a run in a state without asking the state machine."""
    with db.write() as conn:
        conn.execute(update(runs).where(runs.c.id == run_id).values(state=state))


def step(cycle: int) -> Step:
    """Return a step whose numbers all follow from the cycle."""
    return Step(
        cycle=cycle, epoch=1, env_steps=200 * cycle, episodes=4 * cycle, updates=4 * cycle, wall_seconds=0.5 * cycle
    )


def run_on_two_models(db: Database) -> list[str]:
    """Launch runs that differ in nothing but their locomotion model; return the ids of the models, then of the runs."""
    models = [launch(db, order(phase="locomotion", seeds=(seed,)))[0] for seed in (1, 2)]
    for _ in models:
        finish(db, claim_next(db), Succeeded(1.0))
    robots = [launch(db, order(method="her-sldr", locomotion=model))[0] for model in models]
    for _ in robots:
        append_metrics(db, claim_next(db), [MetricPoint(step(1), {"test/success_rate": 0.5})])
    return [*models, *robots]


def at_once(*calls: Callable[[], object]) -> list[object]:
    """Make calls in threads that begin together; return what they returned."""
    barrier = Barrier(len(calls))

    def begin(call: Callable[[], object]) -> object:
        barrier.wait()
        return call()

    with ThreadPoolExecutor(len(calls)) as threads:
        return [future.result() for future in [threads.submit(begin, call) for call in calls]]
