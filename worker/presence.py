"""Knowing when this worker was away, so that it does not take its own absence for that of others."""

from __future__ import annotations

import time

AWAY_AFTER_S = 10.0
"""A supervisor looks around several times a second; after a gap this long it was stopped, asleep or starved [s]."""


class Presence:
    """Tell whether this worker has been awake, and the store within reach, for long enough to judge others.

    A machine that slept finds every lease expired and every trainer without progress; so does one whose store was away.
    All of them get as long as a lease lasts to show that they live, before anything is taken from them.
    """

    def __init__(self, patience_s: float, away_after_s: float = AWAY_AFTER_S) -> None:
        self._patience_s = patience_s
        self._away_after_s = away_after_s
        # The wall clock goes on while the machine sleeps; the monotonic clock does not.
        self._seen_at = time.time()
        self._steady_at = 0.0

    def note_turn(self) -> None:
        """Note that the worker is awake, and whether it was away since the last time."""
        now = time.time()
        if not 0.0 <= now - self._seen_at <= self._away_after_s:
            self._steady_at = now + self._patience_s
        self._seen_at = now

    def note_outage(self) -> None:
        """Note that the store could not be used."""
        self._steady_at = time.time() + self._patience_s

    @property
    def is_steady(self) -> bool:
        """Whether silence of others now means something."""
        return time.time() >= self._steady_at
