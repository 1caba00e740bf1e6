"""Waiting for a store that cannot be used just now, such as a database server that is being restarted."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import TypeVar

from backend.store.errors import StoreUnavailable

STORE_PATIENCE_S = 600.0
"""How long a training waits for the store before it gives up; meanwhile nobody else can take its run [s]."""
PAUSE_S = 0.5
"""Between two tries [s]."""

T = TypeVar("T")

log = logging.getLogger(__name__)


def when_possible(act: Callable[[], T], patience_s: float = STORE_PATIENCE_S) -> T:
    """Return what `act` returns, and try it again for as long as the store cannot be used.

    Args:
        act: something that may be done twice: the store may have done it although its answer was lost.
        patience_s: how long to try [s].

    Raises:
        StoreUnavailable: the store could not be used for `patience_s`.
    """
    give_up_at = time.monotonic() + patience_s
    told = False
    while True:
        try:
            return act()
        except StoreUnavailable as err:
            if time.monotonic() > give_up_at:
                raise
            if not told:
                log.warning("Waiting for the store: %s", err)
                told = True
        time.sleep(PAUSE_S)
