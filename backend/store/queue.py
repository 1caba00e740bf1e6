"""The queue: a worker claims a run, keeps it by heartbeats, and says how the attempt ended."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import Connection, func, insert, or_, select, update

from backend.store.claims import Claim
from backend.store.database import Database, current_time
from backend.store.dependents import settle_dependents
from backend.store.errors import StaleFence
from backend.store.states import Event, RunState, change_state, try_change_state
from backend.store.tables import AnyRow, attempts, run_needs, runs
from sldr_core.config import config_from_dict
from sldr_core.errors import InvalidConfig

LEASE_S = 60.0
"""A run goes to another worker after this long without a heartbeat [s]."""
HEARTBEAT_S = 10.0
"""How often a worker renews its leases [s]."""
MAX_ATTEMPTS = 3
"""Attempts that may fail or get lost before the run fails; handed back and paused ones do not count."""
RETRY_BACKOFF_S = 2.0
"""Wait before the first retry, doubled for each further one [s]."""


@dataclass(frozen=True)
class HeartbeatReply:
    """Tell a worker how its attempt stands."""

    alive: bool
    """Whether the attempt still owns its run; if not, its process must end at once."""
    cancel: bool
    """Whether a person wants the run to end."""
    pause: bool
    """Whether a person wants the run to checkpoint and wait."""


@dataclass(frozen=True)
class Succeeded:
    """The training came to its end."""

    success_rate: float | None
    """Success of the last test; it decides whether dependents may start."""


@dataclass(frozen=True)
class Failed:
    """The attempt ended by an error."""

    reason: str
    """Why, in one sentence."""
    retry: bool
    """Whether another attempt could do better."""


@dataclass(frozen=True)
class Lost:
    """The attempt's process is out of reach for good: its machine, or what ran it there, is gone."""

    reason: str
    """Why, in one sentence."""


@dataclass(frozen=True)
class Cancelled:
    """The training ended because a person wished so."""


@dataclass(frozen=True)
class Paused:
    """The training is checkpointed and waits for a person."""


@dataclass(frozen=True)
class HandedBack:
    """The worker gives the run back unharmed; any worker may go on with it."""

    reason: str
    """Why, in one sentence."""
    delay_s: float = 0.0
    """How long no worker should take it [s]."""


Outcome = Succeeded | Failed | Lost | Cancelled | Paused | HandedBack
"""How an attempt ended."""


def claim(db: Database, worker_id: str, lease_s: float = LEASE_S) -> Claim | None:
    """Take the oldest queued run, or return None if there is nothing to do."""
    with db.write() as conn:
        while (row := _take_next(conn, worker_id, lease_s)) is not None:
            try:
                return _claim(conn, row)
            except InvalidConfig as err:
                reason = f"Its settings do not fit this version; launch it again ({err})."
                _end(conn, row, Event.FAILED, current_time(conn), reason)
    return None


def heartbeat(
    db: Database, claim: Claim, progress_at: datetime | None = None, lease_s: float = LEASE_S
) -> HeartbeatReply:
    """Renew the lease of an attempt and return what is wanted of it.

    Args:
        progress_at: when the trainer last showed progress, if the caller knows.
    """
    with db.write() as conn:
        changes: dict[str, Any] = {"lease_until": current_time(conn) + timedelta(seconds=lease_s)}
        if progress_at is not None:
            changes["progress_at"] = progress_at
        renew = update(runs).where(*_owned_by(claim)).values(changes)
        row = conn.execute(renew.returning(runs.c.cancel_requested, runs.c.pause_requested)).one_or_none()
    return _reply(row)


def read_requests(db: Database, claim: Claim) -> HeartbeatReply:
    """Return what is wanted of an attempt without renewing its lease."""
    with db.read() as conn:
        query = select(runs.c.cancel_requested, runs.c.pause_requested).where(*_owned_by(claim))
        return _reply(conn.execute(query).one_or_none())


def finish(db: Database, claim: Claim, outcome: Outcome, backoff_s: float = RETRY_BACKOFF_S) -> None:
    """Record how an attempt ended, and let follow what follows from it.

    Raises:
        StaleFence: the attempt is over already; nothing was changed.
    """
    with db.write() as conn:
        at = current_time(conn)
        row = conn.execute(select(runs).where(*_owned_by(claim)).with_for_update()).one_or_none()
        if row is None:
            raise StaleFence(claim.run_id, claim.fence)
        _finish(conn, row, outcome, at, backoff_s)


def reap_expired(db: Database, backoff_s: float = RETRY_BACKOFF_S) -> list[str]:
    """Take the runs whose lease has run out from their workers; return their ids."""
    with db.write() as conn:
        at = current_time(conn)
        query = select(runs).where(runs.c.state == RunState.RUNNING, runs.c.lease_until < at)
        expired = conn.execute(query.with_for_update(skip_locked=True)).all()
        for row in expired:
            reason = f"Its worker {row.worker_id} gave no sign of life."
            _retry(conn, row, Event.LOST, reason, at, backoff_s)
    return [row.id for row in expired]


def _take_next(conn: Connection, worker_id: str, lease_s: float) -> AnyRow | None:
    at = current_time(conn)
    oldest = (
        select(runs.c.id)
        .where(runs.c.state == RunState.QUEUED, or_(runs.c.not_before.is_(None), runs.c.not_before <= at))
        .order_by(runs.c.number)
        .limit(1)
        .with_for_update(skip_locked=True)
        .scalar_subquery()
    )
    changes = {
        "fence": runs.c.fence + 1,
        "attempt": runs.c.attempt + 1,
        "worker_id": worker_id,
        "lease_until": at + timedelta(seconds=lease_s),
        "not_before": None,
        "started_at": func.coalesce(runs.c.started_at, at),
    }
    row = try_change_state(conn, oldest, Event.CLAIMED, at=at, changes=changes)
    if row is not None:
        opened = {"run_id": row.id, "attempt": row.attempt, "fence": row.fence, "worker_id": worker_id}
        conn.execute(insert(attempts).values(**opened, started_at=at))
    return row


def _claim(conn: Connection, row: AnyRow) -> Claim:
    query = select(run_needs.c.needs_run_id).where(run_needs.c.run_id == row.id).order_by(run_needs.c.needs_run_id)
    return Claim(
        run_id=row.id,
        fence=row.fence,
        attempt=row.attempt,
        worker_id=row.worker_id,
        config=config_from_dict(row.config),
        locomotion_run_ids=tuple(conn.execute(query).scalars()),
        lease_until=row.lease_until,
    )


def _finish(conn: Connection, row: AnyRow, outcome: Outcome, at: datetime, backoff_s: float) -> None:
    match outcome:
        case Succeeded(success_rate):
            _end(conn, row, Event.SUCCEEDED, at, None, {"success_rate": success_rate})
        case Cancelled():
            _end(conn, row, Event.CANCELLED, at, "Cancelled while it ran.")
        case Failed(reason, retry=False):
            _end(conn, row, Event.FAILED, at, reason)
        case Failed(reason):
            _retry(conn, row, Event.RETRIED, reason, at, backoff_s)
        case Lost(reason):
            _retry(conn, row, Event.LOST, reason, at, backoff_s)
        case Paused():
            _leave(conn, row, Event.PAUSED, at, None, {})
        case HandedBack(reason, delay_s):
            _leave(conn, row, Event.HANDED_BACK, at, reason, {"not_before": at + timedelta(seconds=delay_s)})


def _retry(conn: Connection, row: AnyRow, event: Event, reason: str, at: datetime, backoff_s: float) -> None:
    failures = row.failures + 1
    if failures >= MAX_ATTEMPTS:
        _end(conn, row, Event.FAILED, at, f"{reason} It was tried {failures} times.", {"failures": failures})
        return
    not_before = at + timedelta(seconds=backoff_s * 2 ** (failures - 1))
    _leave(conn, row, event, at, reason, {"failures": failures, "not_before": not_before})


def _leave(
    conn: Connection, row: AnyRow, event: Event, at: datetime, reason: str | None, changes: dict[str, Any]
) -> None:
    """End the attempt but not the run, unless a person wanted the run to end meanwhile."""
    if row.cancel_requested:
        _end(conn, row, Event.CANCELLED, at, "Cancelled while it ran.")
        return
    change_state(conn, row.id, event, at=at, reason=reason, fence=row.fence, changes=changes)
    _close_attempt(conn, row, event, reason, at)


def _end(
    conn: Connection,
    row: AnyRow,
    event: Event,
    at: datetime,
    reason: str | None,
    changes: dict[str, Any] | None = None,
) -> None:
    """End attempt and run, and let the runs that need it know."""
    change_state(conn, row.id, event, at=at, reason=reason, fence=row.fence, changes=changes)
    _close_attempt(conn, row, event, reason, at)
    settle_dependents(conn, row.id, at)


def _close_attempt(conn: Connection, row: AnyRow, outcome: Event, reason: str | None, at: datetime) -> None:
    this = (attempts.c.run_id == row.id, attempts.c.attempt == row.attempt)
    conn.execute(update(attempts).where(*this).values(ended_at=at, outcome=outcome, reason=reason))


def _owned_by(claim: Claim) -> tuple[Any, ...]:
    return runs.c.id == claim.run_id, runs.c.fence == claim.fence, runs.c.state == RunState.RUNNING


def _reply(row: AnyRow | None) -> HeartbeatReply:
    if row is None:
        return HeartbeatReply(alive=False, cancel=False, pause=False)
    return HeartbeatReply(alive=True, cancel=row.cancel_requested, pause=row.pause_requested)
