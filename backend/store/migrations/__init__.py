"""The migrations, and the one way to apply them."""

from __future__ import annotations

import logging
from pathlib import Path

from sqlalchemy import Connection


def upgrade(conn: Connection) -> None:
    """Bring the tables up to date inside the caller's transaction."""
    # Alembic notes its own setting up, already while it is imported; nobody who serves wants to read that.
    logging.getLogger("alembic").setLevel(logging.WARNING)
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parent))
    config.set_main_option("path_separator", "os")
    config.attributes["connection"] = conn
    command.upgrade(config, "head")
