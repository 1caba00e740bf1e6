"""Signed tokens that open one 3D session for some hours."""

from __future__ import annotations

import secrets
from datetime import UTC, datetime, timedelta
from pathlib import Path

from itsdangerous import BadSignature, URLSafeSerializer

from backend.store.private_files import load_private

SECRET_BYTES = 32
"""Length of the signing secret [bytes]."""

TOKEN_LIFETIME = timedelta(hours=12)
"""How long after its creation a session can be opened."""


class BadToken(Exception):
    """Report a token that opens nothing: its text is one sentence for the user."""


class ViewerTokens:
    """Sign and read tokens. The same session always gets the same token, so that its url stays as it is."""

    def __init__(self, secret: bytes) -> None:
        self._serializer = URLSafeSerializer(secret, salt="viewer-session")

    def sign(self, session_id: str, created_at: datetime) -> str:
        """Return the token of a session."""
        ends_at = created_at + TOKEN_LIFETIME
        signed = self._serializer.dumps([session_id, int(ends_at.timestamp())])
        return signed.decode() if isinstance(signed, bytes) else signed

    def read(self, token: str) -> str:
        """Return the session that a token opens.

        Raises:
            BadToken: the token is not ours, or too old.
        """
        try:
            session_id, ends_at = self._serializer.loads(token)
        except BadSignature as error:
            raise BadToken("This address of a 3D view is not valid; open the view from its run's page.") from error
        if datetime.now(UTC).timestamp() >= ends_at:
            raise BadToken("This address of a 3D view has expired; open the view again from its run's page.")
        return session_id


def load_secret(path: Path) -> bytes:
    """Return the signing secret of a data directory, made on first use and readable by its owner only."""
    return load_private(path, lambda: secrets.token_bytes(SECRET_BYTES))
