"""The API's records of notices and webhooks: what has happened, and who is told."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, get_args

from pydantic import Field

from backend.api.schemas import Strict
from backend.store.notices import NoticeEvent
from backend.store.webhooks import DeliveryEvent, DeliveryState
from backend.webhooks.targets import LONGEST_URL


class Notice(Strict):
    """Something that has happened to a run or study."""

    event: NoticeEvent
    subject: str = Field(description="Id of the run or study.")
    occasion: str = Field(description="Tells it apart from the same event at another time.")
    at: datetime
    message: str = Field(description="What has happened, in one sentence.")
    path: str = Field(description="Where the page shows it.")


class Notices(Strict):
    """What has happened, oldest first."""

    notices: list[Notice]
    now: datetime = Field(
        description="The service's time. Ask next for what has happened since a minute before it: it may be written "
        "down a little later. `event`, `subject` and `occasion` tell what is known already."
    )


class NewWebhook(Strict):
    """An address that shall be told."""

    url: Annotated[str, Field(min_length=1, max_length=LONGEST_URL)]
    events: Annotated[list[NoticeEvent], Field(min_length=1, max_length=len(get_args(NoticeEvent)))]


class Delivery(Strict):
    """One message to one address."""

    id: str
    event: DeliveryEvent
    state: DeliveryState
    tries: int
    problem: str | None = Field(description="Why the newest try failed, in one sentence.")
    created_at: datetime
    ended_at: datetime | None
    next_try_at: datetime | None = Field(description="Null once it was sent or given up.")


class Webhook(Strict):
    """An address that is told."""

    id: str
    url: str
    events: list[str]
    created_at: datetime
    deliveries: list[Delivery] = Field(description="The newest, newest first.")


class AddedWebhook(Webhook):
    """An address that was just added, with what its messages are signed with; it is not shown again."""

    secret: str


class Webhooks(Strict):
    """Every address that is told."""

    webhooks: list[Webhook]
