"""Tickets: each opens one address to read, for some minutes, to a program in the page that sends no cookie.

Rerun's viewer is such a program: it fetches a recording by its address alone.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

from itsdangerous import BadSignature
from starlette.requests import HTTPConnection

from backend.api.tokens import TimedSigner

LIFETIME = timedelta(minutes=10)
"""Longer than a page needs from hearing of a file to fetching all of it."""

PARAMETER = "ticket"


class Tickets:
    """Sign and read tickets."""

    def __init__(self, secret: bytes) -> None:
        self._signer = TimedSigner(secret, "ticket")

    def sign(self, path: str, now: datetime) -> str:
        """Return what opens this path from now on."""
        return self._signer.sign(path, now + LIFETIME)

    def open(self, ticket: str, path: str, now: datetime) -> bool:
        """Tell whether a ticket opens this path."""
        try:
            signed_path, is_over = self._signer.read(ticket, now)
        except BadSignature:
            return False
        return signed_path == path and not is_over


def opens_by_ticket(tickets: Tickets, connection: HTTPConnection) -> bool:
    """Tell whether a request shows a ticket that opens what it reads."""
    shown = connection.query_params.get(PARAMETER)
    if shown is None or connection.scope.get("method") not in ("GET", "HEAD"):
        return False
    return tickets.open(shown, connection.scope["path"], datetime.now(UTC))
