"""The token of a server on loopback: whoever can read it in the data directory may do everything."""

from __future__ import annotations

from backend.store.access.secret_tokens import new_secret_token
from backend.store.private_files import OWNER_ONLY, load_private
from backend.store.settings import Settings


def load_local_token(settings: Settings) -> str:
    """Return the token of a data directory, made on first use; it stays the same until its file is deleted."""
    path = settings.access_token_path
    token = load_private(path, lambda: f"{new_secret_token()}\n".encode()).decode().strip()
    if path.stat().st_mode & 0o077:
        path.chmod(OWNER_ONLY)
    return token
