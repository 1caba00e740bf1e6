"""What one look has found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from worker.sentences import sentence_of

Standing = Literal["ok", "poor", "wrong"]
"""`poor` works, but not as well as it could; `wrong` keeps something from working."""


@dataclass(frozen=True)
class Finding:
    """Say how one thing stands."""

    name: str
    """What was looked at, in a word or two."""
    standing: Standing
    told: str
    """What was found, in one sentence."""
    mend: str = ""
    """What to do; empty if there is nothing to do."""


Look = Callable[[], Finding]


def guard(name: str, look: Look) -> Finding:
    """Return what a look has found; one that breaks down has found something that is wrong."""
    try:
        return look()
    except Exception as err:
        told = sentence_of(err) or f"Looking at it ended with {type(err).__name__}: {err}."
        return wrong(name, told, "see what the other lines say, and mend that first.")


def ok(name: str, told: str) -> Finding:
    """Return that all is well."""
    return Finding(name, "ok", told)


def poor(name: str, told: str, mend: str) -> Finding:
    """Return what works, but not as well as it could."""
    return Finding(name, "poor", told, mend)


def wrong(name: str, told: str, mend: str) -> Finding:
    """Return what keeps something from working."""
    return Finding(name, "wrong", told, mend)
