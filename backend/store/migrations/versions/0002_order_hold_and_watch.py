"""Let runs be ordered, deleted, released and counted when they die; say where attempts run and what workers have."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("runs", sa.Column("deaths", sa.Integer(), server_default="0", nullable=False))
    op.add_column("runs", sa.Column("gate_waived", sa.Boolean(), server_default=sa.false(), nullable=False))
    op.add_column("runs", sa.Column("needs_gpu", sa.Boolean(), server_default=sa.false(), nullable=False))
    op.add_column("runs", sa.Column("rank", sa.Integer(), server_default="0", nullable=False))
    op.add_column("runs", sa.Column("queue_position", sa.Float(), server_default="0", nullable=False))
    op.add_column("runs", sa.Column("deleted_at", sa.DateTime(timezone=True), nullable=True))
    op.create_index(
        op.f("ix_runs_state_rank_queue_position_number"),
        "runs",
        ["state", "rank", "queue_position", "number"],
        unique=False,
    )
    op.create_index(op.f("ix_runs_queue_position"), "runs", ["queue_position"], unique=False)
    _fill_runs()
    op.add_column("attempts", sa.Column("host", sa.String(length=200), nullable=True))
    op.add_column("workers", sa.Column("executor", sa.String(length=32), server_default="local", nullable=False))
    op.add_column("workers", sa.Column("cores", sa.Integer(), server_default="0", nullable=False))
    op.add_column("workers", sa.Column("gpu", sa.String(length=200), nullable=True))
    op.add_column("workers", sa.Column("memory_total", sa.BigInteger(), server_default="0", nullable=False))
    op.add_column("workers", sa.Column("memory_used", sa.BigInteger(), server_default="0", nullable=False))
    op.add_column("workers", sa.Column("draining", sa.Boolean(), server_default=sa.false(), nullable=False))
    op.add_column("viewer_hosts", sa.Column("name", sa.String(length=200), nullable=True))


def _fill_runs() -> None:
    """Keep the runs in the order of their launch, and find those that ask for a GPU."""
    runs = sa.table(
        "runs",
        sa.column("number", sa.Integer()),
        sa.column("queue_position", sa.Float()),
        sa.column("config", sa.JSON()),
        sa.column("needs_gpu", sa.Boolean()),
    )
    op.execute(runs.update().values(queue_position=runs.c.number))
    device = runs.c.config["compute"]["device"].as_string()
    op.execute(runs.update().where(device == "cuda").values(needs_gpu=sa.true()))


def downgrade() -> None:
    op.drop_column("viewer_hosts", "name")
    for name in ("draining", "memory_used", "memory_total", "gpu", "cores", "executor"):
        op.drop_column("workers", name)
    op.drop_column("attempts", "host")
    op.drop_index(op.f("ix_runs_queue_position"), table_name="runs")
    op.drop_index(op.f("ix_runs_state_rank_queue_position_number"), table_name="runs")
    for name in ("deleted_at", "queue_position", "rank", "needs_gpu", "gate_waived", "deaths"):
        op.drop_column("runs", name)
