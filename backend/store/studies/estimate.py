"""What launching a study will cost: time from speeds measured on this store, disk from the planned files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from backend.store.database import Database
from backend.store.run_plans import PlannedRun
from backend.store.speeds import Speeds, measure_speeds
from backend.store.studies.plan import StudyPlan
from backend.store.workers import select_workers
from sldr_core.presets.budget import replay_file_size


@dataclass(frozen=True)
class Estimate:
    """Say what the new runs of a study will cost."""

    training_s: float | None
    """Time that they train, added up; None if nobody knows [s]."""
    until_done_s: float | None
    """Time until the last has ended, if the workers that are alive train nothing else; None if nobody knows [s]."""
    unknown_runs: int
    """Runs of whose like none has succeeded here, so that nobody knows how long they take."""
    slots: int
    """Runs that the workers that are alive and take runs can train at once."""
    disk_bytes: int
    """What their replay files take; nearly all that they write [bytes]."""


def estimate_study(db: Database, plan: StudyPlan) -> Estimate:
    """Return what the new runs of a plan will cost."""
    with db.read() as conn:
        speeds = measure_speeds(conn)
        slots = sum(worker.slots for worker in select_workers(conn) if worker.alive and not worker.draining)
    return estimate(plan.new_runs, speeds, slots)


def estimate(new_runs: Sequence[PlannedRun], speeds: Speeds, slots: int) -> Estimate:
    """Return what new runs will cost on so many slots.

    They end at the earliest when every slot has been busy all the time, and never before the longest chain of a
    locomotion run and one that needs it; the greater of the two is told.
    """
    seconds = {run.config_hash: speeds.seconds_for(run) for run in new_runs}
    known = {digest: value for digest, value in seconds.items() if value is not None}
    is_known = len(known) == len(seconds)
    training_s = sum(known.values()) if is_known else None
    chain_s = max((_chain(run, known) for run in new_runs), default=0.0)
    return Estimate(
        training_s=training_s,
        until_done_s=max(training_s / slots, chain_s) if training_s is not None and slots else None,
        unknown_runs=len(seconds) - len(known),
        slots=slots,
        disk_bytes=sum(replay_file_size(run.config) for run in new_runs),
    )


def _chain(run: PlannedRun, seconds: Mapping[str, float]) -> float:
    """Return how long a run takes with the new locomotion runs that it waits for [s]."""
    waits = max((seconds.get(digest, 0.0) for digest in run.needs), default=0.0)
    return waits + seconds.get(run.config_hash, 0.0)
