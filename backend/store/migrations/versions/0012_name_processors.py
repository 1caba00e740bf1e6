"""Let a worker say which processor it trains on: how fast it is, and its numbers to the last bit, depend on it."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0012"
down_revision = "0011"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("workers", sa.Column("processor", sa.String(length=200), nullable=True))


def downgrade() -> None:
    op.drop_column("workers", "processor")
