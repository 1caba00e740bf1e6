"""Let runs carry tags and notes, save views of their table, and sum up what each has logged."""

from __future__ import annotations

import hashlib
import json
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None

TAIL_LENGTH = 20


def upgrade() -> None:
    op.add_column("runs", sa.Column("settings_hash", sa.String(length=32), nullable=True))
    op.add_column("runs", sa.Column("notes", sa.Text(), nullable=True))
    op.create_table(
        "run_tags",
        sa.Column("run_id", sa.String(length=32), nullable=False),
        sa.Column("tag", sa.String(length=200), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name=op.f("fk_run_tags_run_id")),
        sa.PrimaryKeyConstraint("run_id", "tag", name=op.f("pk_run_tags")),
    )
    op.create_index(op.f("ix_run_tags_tag"), "run_tags", ["tag"], unique=False)
    op.create_table(
        "saved_views",
        sa.Column("id", sa.String(length=32), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("search", sa.Text(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_saved_views")),
        sa.UniqueConstraint("name", name=op.f("uq_saved_views_name")),
    )
    op.create_table(
        "metric_summaries",
        sa.Column("run_id", sa.String(length=32), nullable=False),
        sa.Column("name", sa.String(length=200), nullable=False),
        sa.Column("points", sa.Integer(), nullable=False),
        sa.Column("last_step", sa.Integer(), nullable=False),
        sa.Column("last", sa.Float(), nullable=False),
        sa.Column("lowest", sa.Float(), nullable=False),
        sa.Column("highest", sa.Float(), nullable=False),
        sa.Column("tail", sa.JSON(), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name=op.f("fk_metric_summaries_run_id")),
        sa.PrimaryKeyConstraint("run_id", "name", name=op.f("pk_metric_summaries")),
    )
    op.create_index(op.f("ix_metric_summaries_name"), "metric_summaries", ["name"], unique=False)
    _fill()


RUNS = sa.table("runs", sa.column("id"), sa.column("config", sa.JSON()), sa.column("settings_hash"))
STEPS = sa.table("metric_steps", sa.column("id"), sa.column("run_id"), sa.column("attempt"), sa.column("step"))
VALUES = sa.table("metric_values", sa.column("step_id"), sa.column("name"), sa.column("value", sa.Float()))
SUMMARIES = sa.table(
    "metric_summaries",
    *(sa.column(name, sa.String()) for name in ("run_id", "name")),
    *(sa.column(name, sa.Integer()) for name in ("points", "last_step")),
    *(sa.column(name, sa.Float()) for name in ("last", "lowest", "highest")),
    sa.column("tail", sa.JSON()),
)


def _fill() -> None:
    """Hash the settings of the runs that are there, and sum up what they have logged, one run after the other."""
    conn = op.get_bind()
    for run_id in conn.execute(sa.select(RUNS.c.id)).scalars().all():
        config = conn.execute(sa.select(RUNS.c.config).where(RUNS.c.id == run_id)).scalar_one()
        conn.execute(RUNS.update().where(RUNS.c.id == run_id).values(settings_hash=_settings_hash(config)))
        summaries = _summaries(conn, run_id)
        if summaries:
            conn.execute(sa.insert(SUMMARIES), summaries)


def _settings_hash(config: dict[str, Any]) -> str:
    settings = {name: value for name, value in config.items() if name != "seed"}
    canonical = json.dumps(settings, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()[:16]


def _summaries(conn: sa.Connection, run_id: str) -> list[dict[str, Any]]:
    """Return a run's summaries without the points that a later attempt has superseded."""
    query = (
        sa.select(STEPS.c.attempt, STEPS.c.step, VALUES.c.name, VALUES.c.value)
        .select_from(STEPS.outerjoin(VALUES, VALUES.c.step_id == STEPS.c.id))
        .where(STEPS.c.run_id == run_id)
        .order_by(STEPS.c.step)
    )
    rows = conn.execute(query).all()
    firsts: dict[int, int] = {}
    for row in rows:
        firsts.setdefault(row.attempt, row.step)
    series: dict[str, list[tuple[int, float]]] = {}
    for row in rows:
        is_superseded = any(attempt > row.attempt and first <= row.step for attempt, first in firsts.items())
        if row.name is not None and not is_superseded:
            series.setdefault(row.name, []).append((row.step, row.value))
    return [_summary(run_id, name, points) for name, points in series.items()]


def _summary(run_id: str, name: str, points: list[tuple[int, float]]) -> dict[str, Any]:
    values = [value for _, value in points]
    return {
        "run_id": run_id,
        "name": name,
        "points": len(points),
        "last_step": points[-1][0],
        "last": values[-1],
        "lowest": min(values),
        "highest": max(values),
        "tail": values[: -TAIL_LENGTH - 1 : -1],
    }


def downgrade() -> None:
    op.drop_index(op.f("ix_metric_summaries_name"), table_name="metric_summaries")
    op.drop_table("metric_summaries")
    op.drop_table("saved_views")
    op.drop_index(op.f("ix_run_tags_tag"), table_name="run_tags")
    op.drop_table("run_tags")
    op.drop_column("runs", "notes")
    op.drop_column("runs", "settings_hash")
