"""The queue: a worker claims a run, keeps it by heartbeats, and says how the attempt ended."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import Connection, exists, func, insert, or_, select, update

from backend.store.claims import Claim
from backend.store.database import Database, current_time
from backend.store.errors import StaleFence
from backend.store.order import CLAIM_ORDER
from backend.store.outcomes import RETRY_BACKOFF_S, Failed, Outcome, end_attempt, lose_attempt
from backend.store.states import Event, RunState, try_change_state
from backend.store.tables import AnyRow, attempts, run_needs, runs, workers
from sldr_core.config import config_from_dict
from sldr_core.errors import InvalidConfig

LEASE_S = 60.0
"""A run goes to another worker after this long without a heartbeat [s]."""
HEARTBEAT_S = 10.0
"""How often a worker renews its leases [s]."""


@dataclass(frozen=True)
class HeartbeatReply:
    """Tell a worker how its attempt stands."""

    alive: bool
    """Whether the attempt still owns its run; if not, its process must end at once."""
    cancel: bool
    """Whether a person wants the run to end."""
    pause: bool
    """Whether a person wants the run to checkpoint and wait."""
    idle_s: float = 0.0
    """How long its trainer has shown no progress [s]."""


def claim(db: Database, worker_id: str, lease_s: float = LEASE_S, with_gpu: bool = True) -> Claim | None:
    """Take the first queued run, or return None if there is nothing to do, or if the worker is draining.

    Args:
        with_gpu: whether runs that ask for a GPU may be taken as well.
    """
    with db.write() as conn:
        while (row := _take_next(conn, worker_id, lease_s, with_gpu)) is not None:
            try:
                return _claim(conn, row)
            except InvalidConfig as err:
                reason = f"Its settings do not fit this version; launch it again ({err})."
                end_attempt(conn, row, Failed(reason, retry=False), current_time(conn), RETRY_BACKOFF_S)
    return None


def heartbeat(db: Database, claim: Claim, lease_s: float = LEASE_S) -> HeartbeatReply:
    """Renew the lease of an attempt and return what is wanted of it."""
    with db.write() as conn:
        at = current_time(conn)
        renew = update(runs).where(*_owned_by(claim)).values(lease_until=at + timedelta(seconds=lease_s))
        row = conn.execute(renew.returning(*_ANSWER)).one_or_none()
    return _reply(row, at)


def read_requests(db: Database, claim: Claim) -> HeartbeatReply:
    """Return what is wanted of an attempt without renewing its lease."""
    with db.read() as conn:
        row = conn.execute(select(*_ANSWER).where(*_owned_by(claim))).one_or_none()
        return _reply(row, current_time(conn))


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
        end_attempt(conn, row, outcome, at, backoff_s)


def reap_expired(db: Database, backoff_s: float = RETRY_BACKOFF_S) -> list[str]:
    """Take the runs whose lease has run out from their workers; return their ids."""
    with db.write() as conn:
        at = current_time(conn)
        query = select(runs).where(runs.c.state == RunState.RUNNING, runs.c.lease_until < at)
        expired = conn.execute(query.with_for_update(skip_locked=True)).all()
        for row in expired:
            lose_attempt(conn, row, at, backoff_s)
    return [row.id for row in expired]


def _take_next(conn: Connection, worker_id: str, lease_s: float, with_gpu: bool) -> AnyRow | None:
    at = current_time(conn)
    draining = exists().where(workers.c.id == worker_id, workers.c.draining)
    due = [runs.c.state == RunState.QUEUED, runs.c.deleted_at.is_(None), ~draining]
    due.append(or_(runs.c.not_before.is_(None), runs.c.not_before <= at))
    if not with_gpu:
        due.append(~runs.c.needs_gpu)
    first = (
        select(runs.c.id)
        .where(*due)
        .order_by(*CLAIM_ORDER)
        .limit(1)
        .with_for_update(skip_locked=True, of=runs)
        .scalar_subquery()
    )
    changes = {
        "fence": runs.c.fence + 1,
        "attempt": runs.c.attempt + 1,
        "worker_id": worker_id,
        "lease_until": at + timedelta(seconds=lease_s),
        "not_before": None,
        "progress_at": at,
        "started_at": func.coalesce(runs.c.started_at, at),
    }
    row = try_change_state(conn, first, Event.CLAIMED, at=at, changes=changes)
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
        gate_waived=row.gate_waived,
        lease_until=row.lease_until,
    )


def _owned_by(claim: Claim) -> tuple[Any, ...]:
    return runs.c.id == claim.run_id, runs.c.fence == claim.fence, runs.c.state == RunState.RUNNING


def _reply(row: AnyRow | None, at: datetime) -> HeartbeatReply:
    if row is None:
        return HeartbeatReply(alive=False, cancel=False, pause=False)
    idle_s = (at - row.progress_at).total_seconds() if row.progress_at else 0.0
    return HeartbeatReply(alive=True, cancel=row.cancel_requested, pause=row.pause_requested, idle_s=idle_s)


_ANSWER = (runs.c.cancel_requested, runs.c.pause_requested, runs.c.progress_at)
"""What a heartbeat is answered from."""
