"""Which points of a run count: a later attempt supersedes earlier ones from its first step on."""

from __future__ import annotations

from sqlalchemy import ColumnElement, Connection, and_, func, or_, select

from backend.store.tables import metric_steps


def not_superseded(conn: Connection, run_id: str) -> list[ColumnElement[bool]]:
    """Return conditions on `metric_steps` that leave out the points of attempts that a later one has overtaken."""
    firsts = conn.execute(
        select(metric_steps.c.attempt, func.min(metric_steps.c.step).label("first"))
        .where(metric_steps.c.run_id == run_id)
        .group_by(metric_steps.c.attempt)
    ).all()
    return [
        or_(metric_steps.c.attempt >= row.attempt, and_(metric_steps.c.step < row.first))
        for row in firsts
        if row.attempt > min(other.attempt for other in firsts)
    ]
