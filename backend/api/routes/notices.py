"""What has happened, for a page that is open; and webhooks, for services that listen."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Any

from fastapi import APIRouter, Query
from pydantic import AwareDatetime, BeforeValidator

from backend.api.access.declarations import needs
from backend.api.dependencies import ServiceParts, Store
from backend.api.errors import ApiError, problem_responses
from backend.api.notice_schemas import AddedWebhook, Delivery, NewWebhook, Notice, Notices, Webhook, Webhooks
from backend.store import notices, webhooks
from backend.webhooks.messages import trial_body
from backend.webhooks.targets import check_url


def refuse_number(text: str) -> str:
    """Return a text that is no number: those would be taken for seconds, which the schema does not offer.

    Raises:
        ValueError: it is one.
    """
    if text.strip().replace(".", "", 1).lstrip("+-").isdigit():
        raise ValueError("a time is written as in 2026-01-31T12:00:00Z")
    return text


MOST_NOTICES = 100
"""Notices in one answer at most, the newest."""

Moment = Annotated[AwareDatetime, BeforeValidator(refuse_number)]
"""A time with its zone, as RFC 3339 writes it."""

router = APIRouter(prefix="/api", tags=["notices"])


@router.get("/notices", responses=problem_responses(422))
@needs("viewer", shared=True)
def list_notices(
    store: Store, since: Annotated[Moment, Query(description="Only what has happened after it.")]
) -> Notices:
    """List the newest studies that have ended and runs that have failed, the oldest of them first."""
    now = datetime.now(UTC)
    try:
        after = since.astimezone(UTC)
    except OverflowError:
        raise ApiError(422, "There is no such time in UTC; name one between the years 1 and 9999.", "since") from None
    found = notices.list_notices(store, after)[-MOST_NOTICES:]
    return Notices(
        notices=[
            Notice(
                event=notice.event,
                subject=notice.subject,
                occasion=notice.occasion,
                at=notice.at,
                message=notice.message,
                path=notice.path,
            )
            for notice in found
        ],
        now=now,
    )


@router.get("/webhooks", responses=problem_responses())
@needs("operator")
def list_webhooks(store: Store) -> Webhooks:
    """List the addresses that are told, with their newest messages."""
    return Webhooks(webhooks=[Webhook(**_fields(webhook)) for webhook in webhooks.list_webhooks(store)])


@router.post("/webhooks", status_code=201, responses=problem_responses(400, 403, 409, 422))
@needs("admin")
def add_webhook(wish: NewWebhook, store: Store) -> AddedWebhook:
    """Tell an address from now on; the secret of its signatures is in this answer alone."""
    check_url(wish.url)
    added = webhooks.add_webhook(store, wish.url, list(dict.fromkeys(wish.events)))
    return AddedWebhook(**_fields(added), secret=added.secret)


@router.delete("/webhooks/{webhook_id}", status_code=204, responses=problem_responses(403, 404, 422))
@needs("admin")
def remove_webhook(webhook_id: str, store: Store) -> None:
    """Tell an address no more."""
    webhooks.remove_webhook(store, webhook_id)


@router.post("/webhooks/{webhook_id}/test", status_code=202, responses=problem_responses(403, 404, 422))
@needs("admin")
def test_webhook(webhook_id: str, service: ServiceParts) -> Delivery:
    """Put a test message on its way; the list says what became of it."""
    added = webhooks.add_test(service.database, webhook_id, trial_body())
    service.sender.wake()
    return _delivery(added)


def _fields(webhook: webhooks.Webhook) -> dict[str, Any]:
    return {
        "id": webhook.id,
        "url": webhook.url,
        "events": list(webhook.events),
        "created_at": webhook.created_at,
        "deliveries": [_delivery(delivery) for delivery in webhook.deliveries],
    }


def _delivery(delivery: webhooks.Delivery) -> Delivery:
    return Delivery(
        id=delivery.id,
        event=delivery.event,
        state=delivery.state,
        tries=delivery.tries,
        problem=delivery.problem,
        created_at=delivery.created_at,
        ended_at=delivery.ended_at,
        next_try_at=delivery.not_before if delivery.state == "waiting" else None,
    )
