"""Views of the runs table that were given a name, for everyone: the page's search string, to be opened again."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import delete, insert, select, update
from sqlalchemy.exc import IntegrityError

from backend.store.database import Database, current_time
from backend.store.errors import NotFound, Refused
from backend.store.tables import AnyRow, saved_views

VIEW_ID_LENGTH = 12
"""Hex digits of a view's id."""


@dataclass(frozen=True)
class SavedView:
    """Hold one view."""

    id: str
    name: str
    search: str
    """The page's search string, without the question mark."""
    created_at: datetime


def list_views(db: Database) -> list[SavedView]:
    """Return every view, by name."""
    with db.read() as conn:
        views = [_view(row) for row in conn.execute(select(saved_views))]
    return sorted(views, key=lambda view: (view.name.casefold(), view.name))


def save_view(db: Database, name: str, search: str) -> SavedView:
    """Keep a view under a name that no other has.

    Raises:
        Refused: there is a view of that name.
    """
    view_id = uuid.uuid4().hex[:VIEW_ID_LENGTH]
    try:
        with db.write() as conn:
            row = insert(saved_views).values(id=view_id, name=name, search=search, created_at=current_time(conn))
            return _view(conn.execute(row.returning(*saved_views.c)).one())
    except IntegrityError as err:
        raise _taken(name) from err


def change_view(db: Database, view_id: str, name: str | None = None, search: str | None = None) -> SavedView:
    """Give a view another name or another search string; what is None stays.

    Raises:
        NotFound: there is no such view.
        Refused: another view has that name.
    """
    this = saved_views.c.id == view_id
    values = {key: value for key, value in (("name", name), ("search", search)) if value is not None}
    try:
        with db.write() as conn:
            if values:
                conn.execute(update(saved_views).where(this).values(values))
            row = conn.execute(select(saved_views).where(this)).one_or_none()
    except IntegrityError as err:
        raise _taken(name or "") from err
    if row is None:
        raise NotFound("view", view_id)
    return _view(row)


def delete_view(db: Database, view_id: str) -> None:
    """Forget a view; the runs that it shows stay.

    Raises:
        NotFound: there is no such view.
    """
    with db.write() as conn:
        if conn.execute(delete(saved_views).where(saved_views.c.id == view_id)).rowcount == 0:
            raise NotFound("view", view_id)


def _view(row: AnyRow) -> SavedView:
    return SavedView(row.id, row.name, row.search, row.created_at)


def _taken(name: str) -> Refused:
    return Refused(f"There is a view called '{name}' already; choose another name, or delete that one first.")
