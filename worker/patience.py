"""Waiting for a store that cannot be used just now: what is written must not be lost, and a training can wait."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from math import inf
from typing import TypeVar

from backend.store.errors import StoreUnavailable

RETRY_S = 1.0
"""Between two tries [s]."""
FILES_PATIENCE_S = 600.0
"""How long a training waits for the place that machines share files through; then another attempt may try [s]."""

Result = TypeVar("Result")

log = logging.getLogger(__name__)


def insist(
    call: Callable[[], Result],
    retry_s: float = RETRY_S,
    patience_s: float = inf,
    is_over: Callable[[], bool] = lambda: False,
) -> Result:
    """Call until the store can be used, however long that takes; return what the call returns.

    Who calls this ends with its supervisor, so it cannot wait for ever on its own; a supervisor says when it `is_over`.

    Args:
        call: what to do; it may be done twice, if only its answer was lost.
        retry_s: between two tries [s].
        patience_s: how long to try [s].
        is_over: whether nobody needs the answer any more.

    Raises:
        StoreUnavailable: patience has ended, or nobody needs the answer any more.
    """
    give_up_at = time.monotonic() + patience_s
    warned = False
    while True:
        try:
            return call()
        except StoreUnavailable as err:
            if is_over() or time.monotonic() >= give_up_at:
                raise
            if not warned:
                log.warning("Trying again and again: %s", err)
                warned = True
            time.sleep(retry_s)
