"""Secrets that are shown once: made here, and kept as a hash that tells nothing about them."""

from __future__ import annotations

import hashlib
import secrets

TOKEN_BYTES = 32
"""Randomness of a secret [bytes]: too much to be guessed, so that a quick hash is enough."""

MARK = "sldr_"
"""How every secret begins, so that programs that look for leaked ones know it."""


def new_secret_token() -> str:
    """Return a new secret."""
    return MARK + secrets.token_urlsafe(TOKEN_BYTES)


def hash_token(token: str) -> str:
    """Return what is stored of a secret: its SHA-256 as hex digits."""
    return hashlib.sha256(token.encode(errors="surrogatepass")).hexdigest()
