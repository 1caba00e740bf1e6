"""How long runs take, measured on those that have succeeded here."""

from __future__ import annotations

from dataclasses import dataclass, field
from statistics import median

from sqlalchemy import Connection, select

from backend.store.runs import RunRow
from backend.store.states import RunState
from backend.store.tables import runs
from backend.store.training_time import read_training_times

MEASURED_AT_MOST = 500
"""So many of the newest succeeded runs are looked at."""

Like = tuple[str, ...]
"""What two runs must share to be expected to take equally long, from the nearest likeness to the farthest."""


@dataclass(frozen=True)
class Durations:
    """Hold the seconds that succeeded runs spent in training, by what they were [s]."""

    by_likeness: dict[Like, list[float]] = field(default_factory=dict[Like, "list[float]"])

    def seconds_left(self, run: RunRow) -> float | None:
        """Return how long a run will take from where it stands, or None if nothing like it has succeeded [s]."""
        done = run.progress.fraction if run.progress else 0.0
        for likeness in likenesses(run.task, run.phase, run.method, run.preset):
            if likeness in self.by_likeness:
                return (1.0 - done) * median(self.by_likeness[likeness])
        return None


def measure_durations(conn: Connection) -> Durations:
    """Measure the newest runs that have succeeded here: the time of their attempts, without the waits between."""
    newest = (
        select(runs.c.id, runs.c.task, runs.c.phase, runs.c.method, runs.c.preset)
        .where(runs.c.state == RunState.SUCCEEDED, runs.c.origin.is_(None))
        .order_by(runs.c.number.desc())
        .limit(MEASURED_AT_MOST)
    )
    found = conn.execute(newest).all()
    times = read_training_times(conn, [row.id for row in found])
    durations = Durations()
    for row in found:
        if row.id in times:
            for likeness in likenesses(row.task, row.phase, row.method, row.preset):
                durations.by_likeness.setdefault(likeness, []).append(times[row.id].ended_s)
    return durations


def likenesses(task: str, phase: str, method: str, preset: str) -> tuple[Like, ...]:
    """Return what a run can be likened by, from the nearest likeness to the farthest."""
    return (task, phase, method, preset), (phase, preset), (preset,)
