"""The queue as a person sees it: in which order runs will start, what each waits for, and when, as far as one can say.

The forecast lets the workers that are alive take the runs as they would, each for as long as its like took before.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime

from backend.store.database import Database, current_time
from backend.store.durations import Durations, measure_durations
from backend.store.order import CLAIM_ORDER
from backend.store.planning import END_OF_TIME, Planned, plan_starts
from backend.store.runs import RunRow, run_rows
from backend.store.states import ENDED, RunState
from backend.store.tables import runs
from backend.store.workers import WorkerRow, select_workers


@dataclass(frozen=True)
class QueueEntry:
    """Say when a run that has not ended will start, and what it waits for."""

    run: RunRow
    position: int | None
    """Its place among the runs that wait for a worker, from 1; None for all others."""
    waits_for: str
    """What it waits for and why, or what it does, in one sentence."""
    starts_at: datetime | None
    """When it started or is expected to; None if one cannot say."""
    ends_at: datetime | None
    """When it is expected to end; None if one cannot say."""


def list_queue(db: Database) -> list[QueueEntry]:
    """Return the runs that have not ended, in the order in which they have started or will; paused ones come last."""
    with db.read() as conn:
        at = current_time(conn)
        there = (runs.c.state.not_in(ENDED), runs.c.deleted_at.is_(None))
        rows = run_rows(conn, there, CLAIM_ORDER)
        alive = [worker for worker in select_workers(conn) if worker.alive]
        durations = measure_durations(conn)
    by_id = {row.id: row for row in rows}
    seconds = {row.id: _seconds_left(row, durations) for row in rows}
    plan = plan_starts(rows, alive, seconds, at)
    ordered = sorted(rows, key=lambda row: _place(row, plan))
    behind = [row.id for row in ordered if row.state is RunState.QUEUED]
    positions = {run_id: place for place, run_id in enumerate(behind, start=1)}
    return [_entry(by_id[row.id], positions.get(row.id), plan.get(row.id), alive, at) for row in ordered]


def _seconds_left(run: RunRow, durations: Durations) -> float | None:
    reported = run.progress.seconds_left if run.progress else None
    return durations.seconds_left(run) if reported is None else reported


def _place(run: RunRow, plan: Mapping[str, Planned]) -> tuple[int, datetime]:
    """Return where a run stands: running ones first, then those that will start, then those that nobody can tell.

    Where that leaves runs side by side, they keep the order in which workers take them.
    """
    planned = plan.get(run.id)
    kinds = (RunState.RUNNING, None, RunState.QUEUED, RunState.BLOCKED, RunState.PAUSED)
    kind = None if planned and run.state is not RunState.RUNNING else run.state
    return kinds.index(kind), planned.start.at if planned else END_OF_TIME


def _entry(
    run: RunRow, position: int | None, planned: Planned | None, alive: Sequence[WorkerRow], at: datetime
) -> QueueEntry:
    return QueueEntry(
        run=run,
        position=position,
        waits_for=_waits_for(run, position, alive, at),
        starts_at=planned.start.told if planned else None,
        ends_at=planned.end.told if planned else None,
    )


def _waits_for(run: RunRow, position: int | None, alive: Sequence[WorkerRow], at: datetime) -> str:
    match run.state:
        case RunState.RUNNING:
            return _what_it_does(run, alive)
        case RunState.PAUSED:
            return "It is paused; resume it to let it go on."
        case RunState.BLOCKED:
            return run.reason or "It waits for another run."
        case _:
            return _why_it_is_queued(run, position or 1, alive, at)


def _what_it_does(run: RunRow, alive: Sequence[WorkerRow]) -> str:
    worker = next((worker for worker in alive if worker.id == run.worker_id), None)
    if worker is None:
        return f"Its worker {run.worker_id} gives no sign of life; another takes it over if that stays so."
    if run.cancel_requested:
        return f"It is being cancelled on {worker.host}."
    if run.pause_requested:
        return f"It pauses on {worker.host} at the end of its cycle."
    return f"It runs on {worker.host}."


def _why_it_is_queued(run: RunRow, position: int, alive: Sequence[WorkerRow], at: datetime) -> str:
    taking = [worker for worker in alive if not worker.draining]
    if not alive:
        return "No worker is alive; start one with `sldr worker`."
    if not taking:
        return "Every worker is draining; let one take runs again, or start another."
    if run.needs_gpu and not any(worker.gpu for worker in taking):
        return "It asks for a GPU, and no worker that takes runs has one."
    if run.not_before is not None and run.not_before > at:
        seconds = (run.not_before - at).total_seconds()
        return f"{run.reason or 'It was interrupted.'} It is tried again in {seconds:.0f} s."
    free = sum(worker.slots - worker.busy for worker in taking)
    if position <= free:
        return "A worker takes it within seconds."
    if position == 1:
        return "It is next, as soon as a slot is free."
    return f"It waits for a free slot, behind {position - 1} other {'run' if position == 2 else 'runs'}."
