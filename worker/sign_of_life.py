"""Showing that an attempt goes on while it moves large files, which may take longer than a hang is allowed to."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Generator
from contextlib import contextmanager

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.metrics import append_metrics

SIGN_S = 10.0
"""Between two signs of life [s]."""
LONGEST_MOVE_S = 3600.0
"""Moving files for longer than this counts as a hang again, for a connection can stall for ever [s]."""

log = logging.getLogger(__name__)


@contextmanager
def showing_life(
    db: Database, claim: Claim, every_s: float = SIGN_S, longest_s: float = LONGEST_MOVE_S
) -> Generator[None]:
    """Tell the store that the attempt goes on for as long as the block lasts."""
    is_over = threading.Event()
    give_up_at = time.monotonic() + longest_s

    def show() -> None:
        while not is_over.wait(every_s) and time.monotonic() < give_up_at:
            try:
                append_metrics(db, claim, [])
            except StoreUnavailable as err:
                log.warning("No sign of life this time, the next one tries again: %s", err)
            except StaleFence:
                return  # Whoever writes next hears of it, and ends the attempt.

    thread = threading.Thread(target=show, name="sign-of-life", daemon=True)
    thread.start()
    try:
        yield
    finally:
        is_over.set()
        thread.join()
