"""3D sessions: asked for by the API, opened by a viewer host, ended by either."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any, Literal

from sqlalchemy import RowMapping, func, insert, select, update

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.tables import runs, viewer_hosts, viewer_sessions

HOST_ALIVE_S = 15.0
"""A viewer host counts as alive this long after its last sign of life [s]."""

SessionState = Literal["starting", "ready", "ended", "failed"]
"""Where a session stands."""

OPEN: tuple[SessionState, ...] = ("starting", "ready")
"""The states of sessions that are not over."""


@dataclass(frozen=True)
class Session:
    """Describe one 3D session."""

    id: str
    run_id: str
    request: Mapping[str, Any]
    """What it is to show: its `kind`, and what that kind can choose from."""
    state: SessionState
    host_id: str | None
    """The viewer host that serves it."""
    port: int | None
    """Where the host serves it on 127.0.0.1."""
    control_port: int | None
    """Where the host takes commands for it and tells its state, on 127.0.0.1."""
    message: str | None
    """What it shows, or why it ended or failed."""
    created_at: datetime
    touched_at: datetime
    """When somebody last looked at it."""
    ended_at: datetime | None


LIVE: Mapping[str, Any] = {"kind": "live"}
"""A request for the newest policy of a run."""


def request_session(db: Database, run_id: str, request: Mapping[str, Any] = LIVE) -> Session:
    """Ask the viewer host for a session on a run.

    Args:
        run_id: the run.
        request: what to show of it.

    Raises:
        NotFound: there is no such run.
    """
    session_id = uuid.uuid4().hex
    with db.write() as conn:
        at = current_time(conn)
        if conn.execute(select(runs.c.id).where(runs.c.id == run_id)).one_or_none() is None:
            raise NotFound("run", run_id)
        values = {"id": session_id, "run_id": run_id, "request": dict(request), "state": "starting"}
        values |= {"created_at": at, "touched_at": at}
        conn.execute(insert(viewer_sessions).values(values))
    return get_session(db, session_id)


def next_requested(db: Database, host_id: str) -> Session | None:
    """Let a viewer host take the oldest session that no host has, or return None."""
    oldest = (
        select(viewer_sessions.c.id)
        .where(viewer_sessions.c.state == "starting", viewer_sessions.c.host_id.is_(None))
        .order_by(viewer_sessions.c.created_at)
        .limit(1)
        .with_for_update(skip_locked=True)
        .scalar_subquery()
    )
    take = update(viewer_sessions).where(viewer_sessions.c.id == oldest).values(host_id=host_id)
    with db.write() as conn:
        row = conn.execute(take.returning(*viewer_sessions.c)).mappings().one_or_none()
    return None if row is None else _session(row)


def mark_ready(
    db: Database, session_id: str, port: int, message: str | None = None, control_port: int | None = None
) -> bool:
    """Record that a session can be opened; False if somebody ended it meanwhile."""
    changes = {"state": "ready", "port": port, "control_port": control_port, "message": message}
    return _change(db, session_id, ("starting",), changes)


def mark_ended(db: Database, session_id: str, failed: bool = False, message: str | None = None) -> bool:
    """Record that a session is over; False if it was already."""
    with db.read() as conn:
        at = current_time(conn)
    changes = {"state": "failed" if failed else "ended", "message": message, "ended_at": at}
    return _change(db, session_id, OPEN, changes)


def end_orphaned_sessions(
    db: Database, host_id: str, machine: str, is_running: Callable[[int], bool], message: str
) -> int:
    """End what viewer hosts that are no more have left open; return how many that were.

    A host is no more if it gave no sign of life lately, or if its process on this machine is gone.

    Args:
        host_id: the viewer host that asks; what is its own stays open.
        machine: name of this machine.
        is_running: tells whether a process of this machine is another living viewer host, by its id.
        message: why they ended, in one sentence.
    """
    with db.write() as conn:
        at = current_time(conn)
        silent_before = at - timedelta(seconds=HOST_ALIVE_S)
        living = [
            host.id
            for host in conn.execute(select(viewer_hosts).where(viewer_hosts.c.beat_at > silent_before)).all()
            if host.id == host_id or host.name != machine or is_running(host.pid)
        ]
        orphaned = (
            viewer_sessions.c.state.in_(OPEN),
            viewer_sessions.c.host_id.is_not(None),
            viewer_sessions.c.host_id.not_in(living),
        )
        changes = {"state": "ended", "message": message, "ended_at": at}
        return conn.execute(update(viewer_sessions).where(*orphaned).values(changes)).rowcount


def touch(db: Database, session_id: str) -> None:
    """Record that somebody looks at a session."""
    with db.write(is_news=False) as conn:
        this = viewer_sessions.c.id == session_id
        conn.execute(update(viewer_sessions).where(this).values(touched_at=current_time(conn)))


def get_session(db: Database, session_id: str) -> Session:
    """Return one session.

    Raises:
        NotFound: there is no such session.
    """
    with db.read() as conn:
        row = conn.execute(select(viewer_sessions).where(viewer_sessions.c.id == session_id)).mappings().one_or_none()
    if row is None:
        raise NotFound("viewer session", session_id)
    return _session(row)


def list_open(db: Database) -> list[Session]:
    """Return the sessions that are not over, oldest first."""
    query = select(viewer_sessions).where(viewer_sessions.c.state.in_(OPEN)).order_by(viewer_sessions.c.created_at)
    with db.read() as conn:
        return [_session(row) for row in conn.execute(query).mappings()]


def beat_host(db: Database, host_id: str, pid: int, machine: str | None = None) -> None:
    """Show that a viewer host is alive; the first call makes it known.

    Args:
        pid: its process.
        machine: name of the machine on which that runs, if known.
    """
    with db.write() as conn:
        values = {"beat_at": current_time(conn), "pid": pid, "name": machine}
        change = update(viewer_hosts).where(viewer_hosts.c.id == host_id).values(values)
        if conn.execute(change).rowcount == 0:
            conn.execute(insert(viewer_hosts).values(id=host_id, **values))


def is_host_alive(db: Database) -> bool:
    """Tell whether any viewer host has shown a sign of life lately."""
    with db.read() as conn:
        alive_since = current_time(conn) - timedelta(seconds=HOST_ALIVE_S)
        query = select(func.count()).select_from(viewer_hosts).where(viewer_hosts.c.beat_at > alive_since)
        return conn.execute(query).scalar_one() > 0


def _session(row: RowMapping) -> Session:
    """Return a row as a record; rows that are older than requests asked for the newest policy."""
    values: dict[str, Any] = {str(name): value for name, value in row.items()}
    values["request"] = values["request"] or LIVE
    return Session(**values)


def _change(db: Database, session_id: str, allowed: tuple[SessionState, ...], changes: dict[str, Any]) -> bool:
    this = (viewer_sessions.c.id == session_id, viewer_sessions.c.state.in_(allowed))
    with db.write() as conn:
        return conn.execute(update(viewer_sessions).where(*this).values(changes)).rowcount > 0
