"""The migrations, and the one way to apply them."""

from __future__ import annotations

import logging
from pathlib import Path

from alembic import command
from alembic.config import Config
from sqlalchemy import Connection


def upgrade(conn: Connection) -> None:
    """Bring the tables up to date inside the caller's transaction."""
    logging.getLogger("alembic").setLevel(logging.WARNING)  # Its notes on setting up are for nobody who serves.
    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parent))
    config.set_main_option("path_separator", "os")
    config.attributes["connection"] = conn
    command.upgrade(config, "head")
