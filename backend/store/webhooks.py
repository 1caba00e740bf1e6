"""Addresses that are told of notices, and what is on its way to them.

A delivery is made for each notice once: its key is the webhook, the event, its subject and the occasion. Whoever sends
takes it for a while; if they die, it is sent again later. So an address may hear a thing twice, and never not at all.
"""

from __future__ import annotations

import json
import secrets
import uuid
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any, Literal

from sqlalchemy import Connection, delete, func, insert, select, update

from backend.store.database import Database, current_time
from backend.store.errors import NotFound, Refused
from backend.store.notices import Notice, select_notices
from backend.store.tables import AnyRow, webhook_deliveries, webhooks

DeliveryEvent = Literal["study_ended", "run_failed", "test"]
DeliveryState = Literal["waiting", "sent", "failed"]

MOST_WEBHOOKS = 20
"""Addresses that may be told."""
SENDING_S = 60.0
"""Whoever has taken a delivery may take so long to send it; then another may try [s]."""
BACKOFFS_S = (10.0, 60.0, 300.0, 1800.0, 7200.0)
"""Pauses before a delivery that failed is tried again; after the last it is given up [s]."""
KEPT_S = 30 * 86_400.0
"""Deliveries that have ended are listed for so long [s]."""
LISTED_AT_MOST = 20
"""Deliveries listed of each webhook, the newest first."""


@dataclass(frozen=True)
class Delivery:
    """Describe one message to one address."""

    id: str
    webhook_id: str
    event: DeliveryEvent
    body: str
    """What is sent, as JSON."""
    state: DeliveryState
    tries: int
    problem: str | None
    """Why the newest try failed, in one sentence."""
    created_at: datetime
    ended_at: datetime | None
    not_before: datetime
    """When it is tried next, if it waits."""


@dataclass(frozen=True)
class Webhook:
    """Describe one address."""

    id: str
    url: str
    secret: str
    """What messages to it are signed with."""
    events: tuple[str, ...]
    created_at: datetime
    deliveries: tuple[Delivery, ...] = ()
    """The newest, newest first."""


@dataclass(frozen=True)
class Taken:
    """Hold a delivery that is to be sent now, and where to."""

    delivery: Delivery
    url: str
    secret: str


def add_webhook(db: Database, url: str, events: Sequence[str]) -> Webhook:
    """Let an address be told from now on.

    Raises:
        Refused: there are too many.
    """
    with db.write() as conn:
        if conn.execute(select(func.count()).select_from(webhooks)).scalar_one() >= MOST_WEBHOOKS:
            raise Refused(f"There are {MOST_WEBHOOKS} webhooks already; remove one first.")
        at = current_time(conn)
        added = Webhook(_new_id(), url, secrets.token_hex(32), tuple(events), at)
        values = {"id": added.id, "url": url, "secret": added.secret, "events": list(events), "created_at": at}
        conn.execute(insert(webhooks).values(**values))
    return added


def list_webhooks(db: Database) -> list[Webhook]:
    """Return every address, oldest first, with what was sent to it lately."""
    newest = select(webhook_deliveries).order_by(webhook_deliveries.c.created_at.desc(), webhook_deliveries.c.id)
    with db.read() as conn:
        rows = conn.execute(select(webhooks).order_by(webhooks.c.created_at)).all()
        of_each = {
            row.id: conn.execute(newest.where(webhook_deliveries.c.webhook_id == row.id).limit(LISTED_AT_MOST)).all()
            for row in rows
        }
    return [_webhook(row, of_each[row.id]) for row in rows]


def remove_webhook(db: Database, webhook_id: str) -> None:
    """Forget an address and what was on its way to it.

    Raises:
        NotFound: there is no such webhook.
    """
    with db.write() as conn:
        conn.execute(delete(webhook_deliveries).where(webhook_deliveries.c.webhook_id == webhook_id))
        if conn.execute(delete(webhooks).where(webhooks.c.id == webhook_id)).rowcount == 0:
            raise NotFound("webhook", webhook_id)


def add_test(db: Database, webhook_id: str, body: dict[str, Any]) -> Delivery:
    """Put a test message on its way.

    Raises:
        NotFound: there is no such webhook.
    """
    with db.write() as conn:
        if conn.execute(select(webhooks.c.id).where(webhooks.c.id == webhook_id)).one_or_none() is None:
            raise NotFound("webhook", webhook_id)
        return _delivery(_insert(conn, webhook_id, "test", webhook_id, _new_id(), json.dumps(body), current_time(conn)))


def plan_deliveries(db: Database, body_of: Callable[[Notice], Mapping[str, Any]]) -> int:
    """Make the deliveries that notices ask for and that are not there yet; return how many.

    Args:
        body_of: returns what is sent of a notice, to be written as JSON.
    """
    # A store whose tables rest is only read: writers on SQLite take turns with those that train.
    with db.read() as conn:
        if not _untold(conn, current_time(conn)):
            return 0
    with db.write() as conn:
        at = current_time(conn)
        conn.execute(select(webhooks.c.id).with_for_update()).all()
        untold = _untold(conn, at)
        for webhook_id, notice in untold:
            body = json.dumps(body_of(notice))
            _insert(conn, webhook_id, notice.event, notice.subject, notice.occasion, body, at)
        forgotten = webhook_deliveries.c.ended_at < at - timedelta(seconds=KEPT_S)
        conn.execute(delete(webhook_deliveries).where(forgotten))
    return len(untold)


def take_delivery(db: Database) -> Taken | None:
    """Take the delivery that is due the longest, for a while; None if none is."""
    with db.read() as conn:
        due = (webhook_deliveries.c.state == "waiting", webhook_deliveries.c.not_before <= current_time(conn))
        if conn.execute(select(webhook_deliveries.c.id).where(*due).limit(1)).one_or_none() is None:
            return None
    with db.write() as conn:
        at = current_time(conn)
        first = (
            select(webhook_deliveries.c.id)
            .where(*due)
            .order_by(webhook_deliveries.c.not_before)
            .limit(1)
            .with_for_update(skip_locked=True)
            .scalar_subquery()
        )
        change = (
            update(webhook_deliveries)
            .where(webhook_deliveries.c.id == first)
            .values(tries=webhook_deliveries.c.tries + 1, not_before=at + timedelta(seconds=SENDING_S))
            .returning(*webhook_deliveries.c)
        )
        row = conn.execute(change).one_or_none()
        if row is None:
            return None
        target = conn.execute(select(webhooks).where(webhooks.c.id == row.webhook_id)).one()
    return Taken(_delivery(row), target.url, target.secret)


def note_sent(db: Database, taken: Taken, problem: str | None) -> None:
    """Record what became of a try; one that failed is tried again later, until it is given up.

    Args:
        problem: why it failed, in one sentence; None if it arrived.
    """
    with db.write() as conn:
        at = current_time(conn)
        tries = taken.delivery.tries
        if problem is None or tries > len(BACKOFFS_S):
            values = {"state": "sent" if problem is None else "failed", "ended_at": at, "problem": problem}
        else:
            values = {"not_before": at + timedelta(seconds=BACKOFFS_S[tries - 1]), "problem": problem}
        this = (webhook_deliveries.c.id == taken.delivery.id, webhook_deliveries.c.tries == tries)
        conn.execute(update(webhook_deliveries).where(*this).values(**values))


def _untold(conn: Connection, at: datetime) -> list[tuple[str, Notice]]:
    """Return the notices that each address is to be told and for which there is no delivery, with the address's id."""
    found: list[tuple[str, Notice]] = []
    told = select(webhook_deliveries.c.event, webhook_deliveries.c.subject, webhook_deliveries.c.occasion)
    for row in conn.execute(select(webhooks)).all():
        lately = select_notices(conn, max(row.created_at, at - timedelta(seconds=KEPT_S)))
        wanted = [notice for notice in lately if notice.event in row.events]
        if wanted:
            there: dict[tuple[str, str], list[str]] = {}
            for event, subject, occasion in conn.execute(told.where(webhook_deliveries.c.webhook_id == row.id)):
                there.setdefault((event, subject), []).append(occasion)
            found += [(row.id, new) for new in wanted if not _is_told(new, there.get((new.event, new.subject), ()))]
    return found


def _is_told(notice: Notice, occasions: Collection[str]) -> bool:
    """Tell whether an address has heard of something, by the occasions of that event that it was told of."""
    if notice.event == "study_ended":
        # A study that loses the run that ended last has ended earlier than was told; that is no news.
        return any(datetime.fromisoformat(occasion) >= notice.at for occasion in occasions)
    return notice.occasion in occasions


def _insert(
    conn: Connection, webhook_id: str, event: str, subject: str, occasion: str, body: str, at: datetime
) -> AnyRow:
    values = {"id": _new_id(), "webhook_id": webhook_id, "event": event, "subject": subject, "occasion": occasion}
    waiting = {"body": body, "state": "waiting", "not_before": at, "created_at": at}
    return conn.execute(insert(webhook_deliveries).values(**values, **waiting).returning(*webhook_deliveries.c)).one()


def _webhook(row: AnyRow, deliveries: Sequence[AnyRow]) -> Webhook:
    told = tuple(_delivery(delivery) for delivery in deliveries)
    return Webhook(row.id, row.url, row.secret, tuple(row.events), row.created_at, told)


def _delivery(row: AnyRow) -> Delivery:
    return Delivery(
        id=row.id,
        webhook_id=row.webhook_id,
        event=row.event,
        body=row.body,
        state=row.state,
        tries=row.tries,
        problem=row.problem,
        created_at=row.created_at,
        ended_at=row.ended_at,
        not_before=row.not_before,
    )


def _new_id() -> str:
    return uuid.uuid4().hex[:12]
