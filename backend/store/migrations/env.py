"""What Alembic runs: migrate on the connection it was given, or on the store of the environment."""

from __future__ import annotations

from alembic import context
from sqlalchemy import Connection, create_engine

from backend.store.settings import load_settings
from backend.store.tables import metadata


def migrate(conn: Connection) -> None:
    """Run the migrations on one connection, in one transaction."""
    context.configure(connection=conn, target_metadata=metadata, transactional_ddl=True)
    with context.begin_transaction():
        context.run_migrations()


given = context.config.attributes.get("connection")
if given is not None:
    migrate(given)
else:
    with create_engine(load_settings().database_url).connect() as opened:
        migrate(opened)
