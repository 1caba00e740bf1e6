"""Metrics: written in batches by an attempt, read as columns with a cursor. Nothing is ever dropped.

Points are keyed (run, attempt, step). A later attempt supersedes earlier ones from its first step on: the older
points stay stored, and are read only when asked for.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import Connection, bindparam, insert, select

from backend.store.claims import Claim, hold_fence
from backend.store.database import Database
from backend.store.metric_summaries import (
    LoggedValues,
    add_to_summaries,
    overtakes,
    read_summaries,
    rebuild_summaries,
)
from backend.store.progress import Progress, store_progress
from backend.store.superseded import not_superseded
from backend.store.tables import metric_steps, metric_values
from sldr_core.records import Step

READ_LIMIT = 5000
"""Points handed out by one read; the cursor leads to the rest."""


@dataclass(frozen=True)
class MetricPoint:
    """Hold what was logged at one step."""

    step: Step
    """How far the training was."""
    values: Mapping[str, float]
    """Finite numbers by `group/name`."""


@dataclass(frozen=True)
class MetricColumns:
    """Hold the points of a run in columns of equal length."""

    cursor: int
    """Pass as `after` to get what comes next."""
    attempt: list[int] = field(default_factory=list[int])
    """The attempt that logged each point; its points replace those of earlier attempts from its first step on."""
    step: list[int] = field(default_factory=list[int])
    """Cycles since the start of the training."""
    epoch: list[int] = field(default_factory=list[int])
    env_steps: list[int] = field(default_factory=list[int])
    episodes: list[int] = field(default_factory=list[int])
    updates: list[int] = field(default_factory=list[int])
    wall_seconds: list[float] = field(default_factory=list[float])
    values: dict[str, list[float | None]] = field(default_factory=dict[str, "list[float | None]"])
    """A column a metric; None where it was not logged."""


def append_metrics(db: Database, claim: Claim, points: Sequence[MetricPoint], progress: Progress | None = None) -> None:
    """Store points in one transaction, and note that the attempt goes on; without points, only that.

    With `progress`, the same transaction replaces that of the run.

    A number that is stored already under its attempt, step and name is left alone. So a batch can be sent again when
    nobody knows whether it arrived.

    Raises:
        StaleFence: the attempt is over; nothing was stored.
    """
    for point in points:
        _check_finite(point)
    with db.write() as conn:
        hold_fence(conn, claim)
        store_points(conn, claim.run_id, claim.attempt, points)
        if progress is not None:
            store_progress(conn, claim.run_id, progress)


def store_points(conn: Connection, run_id: str, attempt: int, points: Sequence[MetricPoint]) -> None:
    """Store the points of an attempt whose run the caller holds, and sum them up."""
    if not points:
        return
    known = read_summaries(conn, run_id)
    is_overtaking = overtakes(conn, run_id, attempt, min(point.step.cycle for point in points), known)
    added = _insert_points(conn, run_id, attempt, points)
    if is_overtaking:
        rebuild_summaries(conn, run_id)
    else:
        add_to_summaries(conn, run_id, known, added)


def read_metrics(
    db: Database, run_id: str, after: int = 0, names: Sequence[str] | None = None, superseded: bool = False
) -> MetricColumns:
    """Return the points logged since the cursor `after`, oldest first, at most `READ_LIMIT` of them.

    Args:
        names: the metrics wanted; all if None.
        superseded: whether to return also the points that a later attempt has replaced; a point is one of them if
            a later attempt has logged its step or an earlier one.
    """
    with db.read() as conn:
        there = [metric_steps.c.run_id == run_id]
        if not superseded:
            there += not_superseded(conn, run_id)
        query = select(metric_steps).where(*there, metric_steps.c.id > after).order_by(metric_steps.c.id)
        steps = conn.execute(query.limit(READ_LIMIT)).all()
        if not steps:
            return MetricColumns(cursor=after)
        # Between the first and the last of these steps there may be some that are superseded.
        wanted = [*there, metric_steps.c.id >= steps[0].id, metric_steps.c.id <= steps[-1].id]
        if names is not None:
            wanted.append(metric_values.c.name.in_(names))
        values = conn.execute(
            select(metric_values).join(metric_steps, metric_steps.c.id == metric_values.c.step_id).where(*wanted)
        ).all()
    return _columns(steps, values)


def _check_finite(point: MetricPoint) -> None:
    for name, value in point.values.items():
        if not math.isfinite(value):
            raise ValueError(f"metric {name} is {value} at cycle {point.step.cycle}; only finite numbers are stored")


def _stored_names(
    conn: Connection, run_id: str, attempt: int, points: Sequence[MetricPoint]
) -> dict[int, tuple[int, set[str]]]:
    """Return, for each step that the attempt has logged already, its id and the names under which it did."""
    begin = min(point.step.cycle for point in points)
    stored: dict[int, tuple[int, set[str]]] = {}
    for row in conn.execute(_STORED, {"of_run": run_id, "of_attempt": attempt, "begin": begin}):
        stored.setdefault(row.step, (row.id, set()))[1].add(row.name)
    return stored


def _insert_points(conn: Connection, run_id: str, attempt: int, points: Sequence[MetricPoint]) -> list[LoggedValues]:
    """Store what is not there yet of some points; return that."""
    stored = _stored_names(conn, run_id, attempt, points)
    missing = {point.step.cycle: point.step for point in points if point.step.cycle not in stored}
    stored |= {cycle: (step_id, set()) for cycle, step_id in _insert_steps(conn, run_id, attempt, missing.values())}
    added: list[LoggedValues] = []
    for point in points:
        names = stored[point.step.cycle][1]
        values = {name: float(value) for name, value in point.values.items() if name not in names}
        names.update(values)
        added.append((point.step.cycle, values))
    rows = [
        {"step_id": stored[cycle][0], "name": name, "value": value}
        for cycle, values in added
        for name, value in values.items()
    ]
    if rows:
        conn.execute(insert(metric_values), rows)
    return added


def _insert_steps(conn: Connection, run_id: str, attempt: int, steps: Iterable[Step]) -> list[tuple[int, int]]:
    """Store steps in their order, which cursors follow; return the id of each beside its cycle."""
    rows = [
        {
            "run_id": run_id,
            "attempt": attempt,
            "step": step.cycle,
            "epoch": step.epoch,
            "env_steps": step.env_steps,
            "episodes": step.episodes,
            "updates": step.updates,
            "wall_seconds": step.wall_seconds,
        }
        for step in steps
    ]
    if not rows:
        return []
    query = insert(metric_steps).returning(metric_steps.c.step, metric_steps.c.id, sort_by_parameter_order=True)
    return [(row.step, row.id) for row in conn.execute(query, rows)]


def _columns(steps: Sequence[Any], values: Sequence[Any]) -> MetricColumns:
    position = {row.id: index for index, row in enumerate(steps)}
    columns: dict[str, list[float | None]] = {name: [None] * len(steps) for name in sorted({v.name for v in values})}
    for value in values:
        if value.step_id in position:
            columns[value.name][position[value.step_id]] = value.value
    return MetricColumns(
        cursor=steps[-1].id,
        attempt=[row.attempt for row in steps],
        step=[row.step for row in steps],
        epoch=[row.epoch for row in steps],
        env_steps=[row.env_steps for row in steps],
        episodes=[row.episodes for row in steps],
        updates=[row.updates for row in steps],
        wall_seconds=[row.wall_seconds for row in steps],
        values=columns,
    )


# Made once: it is run for every cycle of every training.
_STORED = (
    select(metric_steps.c.step, metric_steps.c.id, metric_values.c.name)
    .outerjoin(metric_values, metric_values.c.step_id == metric_steps.c.id)
    .where(
        metric_steps.c.run_id == bindparam("of_run"),
        metric_steps.c.attempt == bindparam("of_attempt"),
        metric_steps.c.step >= bindparam("begin"),
    )
)
