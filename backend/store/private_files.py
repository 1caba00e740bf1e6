"""Secrets of a data directory: small files that only their owner can read, made when they are first asked for."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable
from pathlib import Path

OWNER_ONLY = 0o600
"""Rights of a secret's file."""


def load_private(path: Path, make: Callable[[], bytes]) -> bytes:
    """Return the content of a secret's file, which is made if it is not there; safe when several processes ask at once.

    Args:
        path: the file.
        make: makes its content.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    candidate = path.with_name(f".{path.name}-{secrets.token_hex(4)}")
    if not path.exists():
        descriptor = os.open(candidate, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWNER_ONLY)
        with os.fdopen(descriptor, "wb") as file:
            file.write(make())
        try:
            os.link(candidate, path)  # Fails, rather than replaces, if another process was first.
        except FileExistsError:
            pass
        finally:
            candidate.unlink()
    return path.read_bytes()
