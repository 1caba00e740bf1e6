"""Telling in one sentence what the person at the terminal can put right."""

from __future__ import annotations

import sqlite3
import sys

from backend.store.errors import StoreUnavailable
from sldr_core.errors import SldrError

BAD_INPUT = 2
"""Exit code for whatever the user can put right."""


def tell(error: Exception, speaker: str = "") -> int:
    """Print what to say of an error and return the exit code; a mistake of ours is raised again."""
    sentence = sentence_of(error)
    if sentence is None:
        raise error
    print(f"{speaker}{sentence}", file=sys.stderr)
    return BAD_INPUT


def sentence_of(error: Exception) -> str | None:
    """Return what to say of an error, or None if it is a mistake of ours, whose trace is wanted."""
    if isinstance(error, SldrError | StoreUnavailable):
        return str(error)
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}."
    # SQLAlchemy passes on what SQLite says; other faults than a damaged file have types of their own.
    said = getattr(error, "orig", error)
    if type(said) is sqlite3.DatabaseError:
        return f"The store is damaged ({said}); move its file away, or bring back a backup into a new SLDR_HOME."
    return None


def unreadable(error: OSError) -> str:
    """Return what to say where a file of a run cannot be read."""
    return f"A file of the run cannot be read ({error}); let this machine's viewer read it."
