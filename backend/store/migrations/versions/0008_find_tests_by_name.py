"""Give the metrics of tests an index by name: curves over many runs are read from it."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"
branch_labels = None
depends_on = None

OF_TESTS = "name >= 'test/' AND name < 'test0'"


def upgrade() -> None:
    op.create_index(
        "ix_metric_values_tests",
        "metric_values",
        ["name", "step_id", "value"],
        unique=False,
        sqlite_where=sa.text(OF_TESTS),
        postgresql_where=sa.text(OF_TESTS),
    )


def downgrade() -> None:
    op.drop_index("ix_metric_values_tests", table_name="metric_values")
