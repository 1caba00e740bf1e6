"""Words signed until a time; tokens made of them open one 3D session for some hours."""

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


class TimedSigner:
    """Sign a word until a time, for one purpose: what is signed for another does not read."""

    def __init__(self, secret: bytes, purpose: str) -> None:
        self._serializer = URLSafeSerializer(secret, salt=purpose)

    def sign(self, word: str, ends_at: datetime) -> str:
        """Return the word and its end, signed; the same for the same."""
        signed = self._serializer.dumps([word, int(ends_at.timestamp())])
        return signed.decode() if isinstance(signed, bytes) else signed

    def read(self, token: str, now: datetime) -> tuple[str, bool]:
        """Return the word, and whether its time is over.

        Raises:
            BadSignature: the token is not ours.
        """
        word, ends_at = self._serializer.loads(token)
        return word, now.timestamp() >= ends_at


class ViewerTokens:
    """Sign and read tokens. The same session always gets the same token, so that its url stays as it is."""

    def __init__(self, secret: bytes) -> None:
        self._signer = TimedSigner(secret, "viewer-session")

    def sign(self, session_id: str, created_at: datetime) -> str:
        """Return the token of a session."""
        return self._signer.sign(session_id, created_at + TOKEN_LIFETIME)

    def read(self, token: str) -> str:
        """Return the session that a token opens.

        Raises:
            BadToken: the token is not ours, or too old.
        """
        try:
            session_id, is_over = self._signer.read(token, datetime.now(UTC))
        except BadSignature as error:
            raise BadToken("This address of a 3D view is not valid; open the view from its run's page.") from error
        if is_over:
            raise BadToken("This address of a 3D view has expired; open the view again from its run's page.")
        return session_id


def load_secret(path: Path) -> bytes:
    """Return the signing secret of a data directory, made on first use and readable by its owner only."""
    return load_private(path, lambda: secrets.token_bytes(SECRET_BYTES))
