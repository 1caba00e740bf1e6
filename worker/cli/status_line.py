"""One line on the terminal that says how far something is."""

from __future__ import annotations

import sys
import time

INTERVAL_S = 0.1
"""Between two changes of the line [s]."""
CLEAR = "\r\x1b[K"
"""Begin the line anew."""


class StatusLine:
    """Show the newest sentence where people look on; elsewhere stay silent."""

    def __init__(self) -> None:
        self._shown_at = 0.0
        self._is_seen = sys.stderr.isatty()

    def __enter__(self) -> StatusLine:
        """Begin."""
        return self

    def __exit__(self, *error: object) -> None:
        """Leave an empty line."""
        if self._is_seen:
            print(CLEAR, end="", file=sys.stderr, flush=True)

    def show(self, sentence: str) -> None:
        """Show a sentence, unless the one before was shown just now."""
        now = time.monotonic()
        if self._is_seen and now - self._shown_at >= INTERVAL_S:
            self._shown_at = now
            print(f"{CLEAR}{sentence}", end="", file=sys.stderr, flush=True)
