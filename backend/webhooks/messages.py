"""What is sent: JSON that a program can use and a chat can show, signed so that the other side knows whose it is."""

from __future__ import annotations

import hashlib
import hmac
from typing import Any

from backend.store.notices import Notice

SIGNATURE_HEADER = "X-SLDR-Signature"
TIMESTAMP_HEADER = "X-SLDR-Timestamp"
DELIVERY_HEADER = "X-SLDR-Delivery"
EVENT_HEADER = "X-SLDR-Event"
TEST_TEXT = "This is a test from SLDR: messages about studies and runs will arrive here."


def body_of(notice: Notice) -> dict[str, Any]:
    """Return what is sent of a notice; `text` is what Slack, Mattermost and their like show."""
    return {
        "event": notice.event,
        "id": notice.subject,
        "at": notice.at.isoformat(),
        "text": notice.message,
        "path": notice.path,
    }


def trial_body() -> dict[str, Any]:
    """Return what is sent as a test."""
    return {"event": "test", "text": TEST_TEXT, "path": "/settings"}


def sign(secret: str, timestamp: int, body: bytes) -> str:
    """Return the signature of a message: HMAC-SHA256 over its time [s since 1970], a dot, and its body.

    The other side computes the same, compares in constant time, and refuses what is older than some minutes.
    """
    digest = hmac.new(secret.encode(), f"{timestamp}.".encode() + body, hashlib.sha256)
    return f"sha256={digest.hexdigest()}"
