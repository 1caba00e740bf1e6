"""Waiting for a store that cannot be used just now: what is written must not be lost, and a training can wait."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import TypeVar

from backend.store.errors import StoreUnavailable

RETRY_S = 1.0
"""Between two tries [s]."""

Result = TypeVar("Result")

log = logging.getLogger(__name__)


def insist(call: Callable[[], Result], retry_s: float = RETRY_S) -> Result:
    """Call until the store can be used, however long that takes; return what the call returns.

    Who calls this ends with its supervisor, so it cannot wait for ever on its own.
    """
    while True:
        try:
            return call()
        except StoreUnavailable as err:
            log.warning("Trying again: %s", err)
            time.sleep(retry_s)
