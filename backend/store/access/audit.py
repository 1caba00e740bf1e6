"""The audit log: who asked for what, when, from where, and what came of it. Rows are added and, when old, forgotten."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Literal

from sqlalchemy import delete, insert, select

from backend.store.access.tables import audit_log
from backend.store.database import Database, current_time
from backend.store.schema import NAME_LENGTH

Outcome = Literal["done", "refused", "failed"]
"""What came of it: it was done, nobody allowed it, or it did not work."""

AUDIT_KEPT = timedelta(days=400)
"""How long an entry is kept."""

LONGEST_DETAIL = 1000
"""Characters of a detail that are kept."""


@dataclass(frozen=True)
class Deed:
    """Say what somebody asked for."""

    who: str
    """Name of the account, or what stands for one."""
    action: str
    address: str
    """Where it came from."""
    outcome: Outcome
    target: str | None = None
    detail: str | None = None


@dataclass(frozen=True)
class AuditEntry:
    """Describe one entry."""

    id: int
    at: datetime
    deed: Deed


def write_entry(db: Database, deed: Deed) -> None:
    """Add an entry."""
    with db.write() as conn:
        values = {
            "at": current_time(conn),
            "who": _short(deed.who),
            "action": _short(deed.action),
            "target": None if deed.target is None else _short(deed.target),
            "address": _short(deed.address),
            "outcome": deed.outcome,
            "detail": None if deed.detail is None else _short(deed.detail, LONGEST_DETAIL),
        }
        conn.execute(insert(audit_log).values(values))


def list_entries(
    db: Database, limit: int, before: int | None = None, who: str | None = None, outcome: Outcome | None = None
) -> list[AuditEntry]:
    """Return entries, the newest first.

    Args:
        limit: how many at most.
        before: id of an entry; only older ones are returned.
        who: only what this one did.
        outcome: only what ended so.
    """
    query = select(audit_log).order_by(audit_log.c.id.desc()).limit(limit)
    if before is not None:
        query = query.where(audit_log.c.id < before)
    if who is not None:
        query = query.where(audit_log.c.who == who)
    if outcome is not None:
        query = query.where(audit_log.c.outcome == outcome)
    with db.read() as conn:
        return [
            AuditEntry(row.id, row.at, Deed(row.who, row.action, row.address, row.outcome, row.target, row.detail))
            for row in conn.execute(query)
        ]


def forget_old_entries(db: Database, kept: timedelta = AUDIT_KEPT) -> int:
    """Delete what is older than it has to be kept; return how many entries that were."""
    with db.write() as conn:
        return conn.execute(delete(audit_log).where(audit_log.c.at < current_time(conn) - kept)).rowcount


def _short(text: str, longest: int = NAME_LENGTH) -> str:
    """Return a text that every store can hold: no longer than this, and without characters that none takes."""
    printable = text.encode(errors="backslashreplace").decode().replace("\x00", "\\x00")
    return printable if len(printable) <= longest else f"{printable[: longest - 3]}..."
