"""Telling whether two machines see the same data directory, or each one of its own under the same path."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

MARK_FILE = "home-id"


def mark_home(home: Path) -> str:
    """Return what a data directory is known by, made on first use."""
    home.mkdir(parents=True, exist_ok=True)
    path = home / MARK_FILE
    candidate = home / f".{MARK_FILE}-{secrets.token_hex(4)}"
    if not path.exists():
        candidate.write_text(secrets.token_hex(16))
        try:
            os.link(candidate, path)  # Fails, rather than replaces, if another process was first.
        except FileExistsError:
            pass
        finally:
            candidate.unlink()
    return path.read_text()


def is_same_home(home: Path, mark: str) -> bool:
    """Tell whether the data directory that this machine sees is the one that was marked."""
    try:
        return (home / MARK_FILE).read_text() == mark
    except OSError:
        return False
