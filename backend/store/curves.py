"""One metric of many runs, read fast: the points of each, without those that a later attempt has superseded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import Connection, and_, func, literal_column, select

from backend.store.compared_runs import ComparedRun
from backend.store.database import Database
from backend.store.tables import TEST_METRIC_INDEX_CONDITION, attempts, metric_steps, metric_values

POINTS_AT_MOST = 100_000
"""Points that one reading takes from the store; of a metric with more, every k-th cycle is read."""

TEST_METRICS = "test/"
"""How the metrics of tests begin. They are few and have an index of their own, so all of them are read."""

_AXES = ("step", "epoch", "env_steps", "episodes", "updates", "wall_seconds")


@dataclass(frozen=True)
class Points:
    """Hold one metric of one run as it was logged, oldest first; `P` points."""

    attempt: NDArray[np.float64]
    """The attempt that logged each point `[P]`."""
    axes: Mapping[str, NDArray[np.float64]]
    """Cycle (`step`), epoch, env steps, episodes, updates and wall seconds [s] of each point, each `[P]`."""
    value: NDArray[np.float64]
    """The metric `[P]`."""

    def __len__(self) -> int:
        return len(self.value)

    def followed_by(self, later: Points) -> Points:
        """Return these points and later ones."""
        return Points(
            attempt=np.concatenate([self.attempt, later.attempt]),
            axes={name: np.concatenate([column, later.axes[name]]) for name, column in self.axes.items()},
            value=np.concatenate([self.value, later.value]),
        )

    def where(self, kept: NDArray[np.bool_]) -> Points:
        """Return the points marked in `kept` `[P]`."""
        return Points(self.attempt[kept], {name: column[kept] for name, column in self.axes.items()}, self.value[kept])


@dataclass(frozen=True)
class CurvePage:
    """Hold what one reading found."""

    points: dict[str, Points]
    """Of each run that was asked for, by its id; superseded points among them."""
    firsts: dict[str, dict[int, int]]
    """The first cycle that each attempt of a run has logged, for runs with more than one attempt that logged."""
    every: int
    """1 if all cycles were read, k if only every k-th."""


NO_POINTS = Points(np.empty(0), {name: np.empty(0) for name in _AXES}, np.empty(0))


def read_points(db: Database, runs: Sequence[ComparedRun], metric: str, after: Mapping[str, int]) -> CurvePage:
    """Read one metric of many runs, each as far as it had come when it was found.

    Args:
        metric: its name, `group/name`.
        after: for runs whose first points are known already, the id of the newest step that was read.
    """
    if not runs:
        return CurvePage({}, {}, 1)
    with db.read() as conn:
        every = 1 if metric.startswith(TEST_METRICS) else _thinning(conn, runs)
        rows = _read_rows(conn, runs, metric, after, every)
        resumed = [run.id for run in runs if run.attempt > 1]
        firsts = _read_firsts(conn, resumed) if resumed else {}
    return CurvePage(_points_by_run(runs, rows, after), firsts, every)


def without_superseded(points: Points, firsts: Mapping[int, int]) -> Points:
    """Leave out each point whose cycle, or an earlier one, a later attempt has logged.

    Args:
        firsts: the first cycle that each attempt has logged.
    """
    if len(firsts) < 2 or not len(points):
        return points
    kept = np.ones(len(points), dtype=bool)
    for attempt, first in firsts.items():
        kept &= (points.attempt >= attempt) | (points.axes["step"] < first)
    return points.where(kept)


def list_metric_names(db: Database, runs: Sequence[ComparedRun]) -> list[str]:
    """Return the names of what runs have logged, sorted, as their newest point and their newest test tell."""
    newest = [run.newest_step_id for run in runs if run.newest_step_id]
    if not newest:
        return []
    tested = (
        select(func.max(metric_values.c.step_id))
        .join(metric_steps, metric_steps.c.id == metric_values.c.step_id)
        .where(
            metric_steps.c.run_id.in_([run.id for run in runs]),
            metric_values.c.name == TEST_METRICS + "success_rate",
            literal_column(TEST_METRIC_INDEX_CONDITION),
        )
        .group_by(metric_steps.c.run_id)
    )
    with db.read() as conn:
        steps = [*newest, *conn.execute(tested).scalars()]
        names = select(metric_values.c.name).where(metric_values.c.step_id.in_(steps)).distinct()
        return sorted(conn.execute(names).scalars())


def _thinning(conn: Connection, runs: Sequence[ComparedRun]) -> int:
    """Return k so that every k-th cycle of all runs together is no more than `POINTS_AT_MOST`."""
    query = select(func.count()).where(metric_steps.c.run_id.in_([run.id for run in runs]))
    return -(-conn.execute(query).scalar_one() // POINTS_AT_MOST) or 1


def _read_rows(
    conn: Connection, runs: Sequence[ComparedRun], metric: str, after: Mapping[str, int], every: int
) -> Sequence[Any]:
    first = min(after.get(run.id, 0) for run in runs)
    conditions = [
        metric_steps.c.run_id.in_([run.id for run in runs]),
        metric_values.c.name == metric,
        # The range is that of the runs asked for, so that a small study in a large store reads a small part of it.
        metric_values.c.step_id > first,
        metric_values.c.step_id <= max(run.newest_step_id for run in runs),
    ]
    if metric.startswith(TEST_METRICS):
        conditions.append(literal_column(TEST_METRIC_INDEX_CONDITION))
    if every > 1:
        conditions.append(metric_steps.c.step % every == 0)
    columns = [metric_steps.c[name] for name in ("run_id", "id", "attempt", *_AXES)]
    joined = and_(metric_values.c.step_id == metric_steps.c.id)
    query = select(*columns, metric_values.c.value).join(metric_values, joined).where(*conditions)
    return conn.execute(query.order_by(metric_values.c.step_id)).all()


def _read_firsts(conn: Connection, run_ids: Sequence[str]) -> dict[str, dict[int, int]]:
    first = (
        select(func.min(metric_steps.c.step))
        .where(metric_steps.c.run_id == attempts.c.run_id, metric_steps.c.attempt == attempts.c.attempt)
        .correlate(attempts)
        .scalar_subquery()
    )
    query = select(attempts.c.run_id, attempts.c.attempt, first).where(attempts.c.run_id.in_(run_ids))
    firsts: dict[str, dict[int, int]] = {}
    for run_id, attempt, step in conn.execute(query):
        if step is not None:
            firsts.setdefault(run_id, {})[attempt] = step
    return firsts


def _points_by_run(runs: Sequence[ComparedRun], rows: Sequence[Any], after: Mapping[str, int]) -> dict[str, Points]:
    by_run: dict[str, list[Any]] = {run.id: [] for run in runs}
    newest = {run.id: run.newest_step_id for run in runs}
    for run_id, step_id, *numbers in rows:
        # What a run has logged since the look at it is read next time; whoever asks knows no more than `newest`.
        if after.get(run_id, 0) < step_id <= newest[run_id]:
            by_run[run_id].append(numbers)
    return {run_id: _points(numbers) for run_id, numbers in by_run.items()}


def _points(numbers: list[Any]) -> Points:
    if not numbers:
        return NO_POINTS
    columns = np.array(numbers, dtype=np.float64).T
    return Points(columns[0], dict(zip(_AXES, columns[1:-1], strict=True)), columns[-1])
