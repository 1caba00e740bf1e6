"""How fast runs train, measured on those that have succeeded here, and what that says of runs that are only planned."""

from __future__ import annotations

from dataclasses import dataclass, field
from statistics import median

from sqlalchemy import Connection, select

from backend.store.durations import MEASURED_AT_MOST, Like, likenesses
from backend.store.run_plans import PlannedRun
from backend.store.states import RunState
from backend.store.tables import run_progress, runs
from backend.store.training_time import read_training_times
from sldr_core.config import settings_hash
from sldr_core.presets.budget import control_steps, gradient_updates

STARTING_S = 6.0
"""Taken for what a training does before its first cycle: mostly loading PyTorch [s]."""


@dataclass(frozen=True)
class Speed:
    """Say how fast a run simulated and learnt."""

    env_steps_per_s: float
    """Control steps [1/s]."""
    updates_per_s: float
    """Gradient updates [1/s]."""


@dataclass(frozen=True)
class Speeds:
    """Hold what was measured on succeeded runs."""

    seconds_of: dict[str, list[float]] = field(default_factory=dict[str, "list[float]"])
    """Time that runs took [s], by the hash of all their settings but the seed."""
    by_likeness: dict[Like, list[Speed]] = field(default_factory=dict[Like, "list[Speed]"])
    """Speeds by what the runs were."""

    def seconds_for(self, planned: PlannedRun) -> float | None:
        """Return how long a run will take, or None if nothing like it has succeeded [s].

        Runs that differ by nothing but the seed say it best. Without them it is the planned control steps and updates
        at the speeds of the nearest runs; a training that may end early then takes that at most.
        """
        equal = self.seconds_of.get(settings_hash(planned.config))
        if equal:
            return median(equal)
        for likeness in likenesses(planned.task, planned.phase, planned.method, planned.preset):
            if likeness in self.by_likeness:
                near = self.by_likeness[likeness]
                simulating = control_steps(planned.config) / median(speed.env_steps_per_s for speed in near)
                learning = gradient_updates(planned.config) / median(speed.updates_per_s for speed in near)
                return STARTING_S + simulating + learning
        return None


def measure_speeds(conn: Connection) -> Speeds:
    """Measure the newest runs that have succeeded here."""
    newest = (
        select(runs.c.id, runs.c.task, runs.c.phase, runs.c.method, runs.c.preset, runs.c.settings_hash)
        .where(runs.c.state == RunState.SUCCEEDED, runs.c.origin.is_(None))
        .order_by(runs.c.number.desc())
        .limit(MEASURED_AT_MOST)
    )
    found = conn.execute(newest).all()
    ids = [row.id for row in found]
    times = read_training_times(conn, ids)
    progress = {row.run_id: row for row in conn.execute(select(run_progress).where(run_progress.c.run_id.in_(ids)))}
    speeds = Speeds()
    for row in found:
        if row.id in times:
            speeds.seconds_of.setdefault(row.settings_hash, []).append(times[row.id].ended_s)
        measured = progress.get(row.id)
        if measured and measured.env_steps_per_s and measured.updates_per_s:
            speed = Speed(measured.env_steps_per_s, measured.updates_per_s)
            for likeness in likenesses(row.task, row.phase, row.method, row.preset):
                speeds.by_likeness.setdefault(likeness, []).append(speed)
    return speeds
