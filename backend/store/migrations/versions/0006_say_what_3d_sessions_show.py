"""Let a 3D session say what it shows, and where it is controlled."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("viewer_sessions", sa.Column("request", sa.JSON(), nullable=True))
    op.add_column("viewer_sessions", sa.Column("control_port", sa.Integer(), nullable=True))


def downgrade() -> None:
    op.drop_column("viewer_sessions", "control_port")
    op.drop_column("viewer_sessions", "request")
