"""What the runs table says of each metric of a run: kept while points arrive, so that no table has to read curves.

A summary counts the points that count: what a later attempt has superseded is left out. It is written in the
transaction that stores the points, so the two never differ.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from sqlalchemy import Connection, bindparam, delete, func, insert, select, update

from backend.store.database import Database
from backend.store.superseded import not_superseded
from backend.store.tables import metric_steps, metric_summaries, metric_values, runs

TAIL_LENGTH = 20
"""Newest values that a summary keeps: the most that a mean of the last ones can be taken over."""


@dataclass(frozen=True)
class MetricSummary:
    """Sum up one metric of one run."""

    points: int
    """Values that count."""
    last_step: int
    """Cycle of the newest value."""
    last: float
    lowest: float
    highest: float
    tail: tuple[float, ...]
    """The newest values, the newest first, at most `TAIL_LENGTH`."""

    def followed_by(self, step: int, value: float) -> MetricSummary:
        """Return the summary with a value at a later step."""
        return MetricSummary(
            points=self.points + 1,
            last_step=step,
            last=value,
            lowest=min(self.lowest, value),
            highest=max(self.highest, value),
            tail=(value, *self.tail[: TAIL_LENGTH - 1]),
        )


LoggedValues = tuple[int, Mapping[str, float]]
"""A step [cycles] and what was logged there, by metric."""


def read_summaries(conn: Connection, run_id: str) -> dict[str, MetricSummary]:
    """Return a run's summaries by metric."""
    return {
        row.name: MetricSummary(row.points, row.last_step, row.last, row.lowest, row.highest, tuple(row.tail))
        for row in conn.execute(_READ, {"of_run": run_id})
    }


def overtakes(conn: Connection, run_id: str, attempt: int, begin: int, known: Mapping[str, MetricSummary]) -> bool:
    """Tell whether points of a run's newest attempt, from step `begin` on, take the place of points that counted.

    Args:
        conn: a transaction that has not stored the points yet.
        run_id: the run.
        attempt: its newest attempt.
        begin: the first step of the points [cycles].
        known: the run's summaries.
    """
    if begin > max((summary.last_step for summary in known.values()), default=-1):
        return False
    query = select(func.min(metric_steps.c.step)).where(
        metric_steps.c.run_id == run_id, metric_steps.c.attempt == attempt
    )
    first = conn.execute(query).scalar_one()
    return first is None or begin < first


def add_to_summaries(
    conn: Connection, run_id: str, known: Mapping[str, MetricSummary], added: Sequence[LoggedValues]
) -> None:
    """Bring a run's summaries up to date after points were stored that overtook none; the caller holds the run.

    Args:
        conn: the transaction that has stored the points.
        run_id: the run.
        known: its summaries before.
        added: the points.
    """
    fresh = _folded(known, sorted(added, key=lambda point: point[0]))
    if fresh is None:
        rebuild_summaries(conn, run_id)
        return
    logged = {name for _, values in added for name in values}
    _update(conn, run_id, {name: fresh[name] for name in logged if name in known})
    _insert(conn, run_id, {name: fresh[name] for name in logged if name not in known})


def rebuild_summaries(conn: Connection, run_id: str) -> None:
    """Make a run's summaries again from the points that count."""
    query = (
        select(metric_values.c.name, metric_steps.c.step, metric_values.c.value)
        .join(metric_steps, metric_steps.c.id == metric_values.c.step_id)
        .where(metric_steps.c.run_id == run_id, *not_superseded(conn, run_id))
        .order_by(metric_steps.c.step)
    )
    points = ((row.step, {row.name: row.value}) for row in conn.execute(query))
    summaries = _folded({}, points)
    assert summaries is not None  # in the order of steps, nothing comes too late
    conn.execute(delete(metric_summaries).where(metric_summaries.c.run_id == run_id))
    _insert(conn, run_id, summaries)


def rebuild_all_summaries(db: Database) -> int:
    """Make the summaries of every run again, each in a transaction of its own; return how many runs there are."""
    with db.read() as conn:
        run_ids = conn.execute(select(runs.c.id)).scalars().all()
    for run_id in run_ids:
        with db.write() as conn:
            conn.execute(select(runs.c.id).where(runs.c.id == run_id).with_for_update())
            rebuild_summaries(conn, run_id)
    return len(run_ids)


def list_metric_names(db: Database) -> list[str]:
    """Return the name of every metric that a run has logged, in the order of the alphabet."""
    with db.read() as conn:
        return sorted(conn.execute(select(metric_summaries.c.name).distinct()).scalars())


def _folded(known: Mapping[str, MetricSummary], points: Iterable[LoggedValues]) -> dict[str, MetricSummary] | None:
    """Return the summaries with the points behind them, or None if one is not later than what is known."""
    summaries = dict(known)
    for step, values in points:
        for name, value in values.items():
            before = summaries.get(name)
            if before is None:
                summaries[name] = MetricSummary(1, step, value, value, value, (value,))
            elif step <= before.last_step:
                return None
            else:
                summaries[name] = before.followed_by(step, value)
    return summaries


def _insert(conn: Connection, run_id: str, summaries: Mapping[str, MetricSummary]) -> None:
    if summaries:
        rows = [{"run_id": run_id, "name": name, **vars(summary)} for name, summary in summaries.items()]
        conn.execute(insert(metric_summaries), rows)


def _update(conn: Connection, run_id: str, summaries: Mapping[str, MetricSummary]) -> None:
    if summaries:
        rows = [{"of_run": run_id, "of_name": name, **vars(summary)} for name, summary in summaries.items()]
        conn.execute(_UPDATE, rows)


# Made once: these are run for every cycle of every training.
_READ = select(metric_summaries).where(metric_summaries.c.run_id == bindparam("of_run"))
_UPDATE = update(metric_summaries).where(
    metric_summaries.c.run_id == bindparam("of_run"), metric_summaries.c.name == bindparam("of_name")
)
