"""Who has just asked: a page that asks every two seconds is looked up in the store once, and known for a second."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable
from typing import TYPE_CHECKING

from starlette.requests import HTTPConnection

if TYPE_CHECKING:
    from backend.api.access.callers import Caller

KNOWN_FOR_S = 1.0
"""After so long somebody is looked up again [s]."""
MOST_CALLERS = 1024
"""Remembered at once; beyond, the one that was looked up first is forgotten."""


class RecentCallers:
    """Remember who showed which secret. Whatever this process writes, a sign-out say, makes it forget all of them."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._known: OrderedDict[tuple[str, str], tuple[Caller, float, int]] = OrderedDict()

    def find(self, connection: HTTPConnection, accepted_s: float, writes: int) -> Caller | None:
        """Return who asks, if that was found out lately enough for the request, and nothing was written since."""
        caller, at, known_writes = self._known.get(_shown(connection), (None, 0.0, 0))
        is_recent = self._clock() - at <= min(accepted_s, KNOWN_FOR_S)
        return caller if is_recent and accepted_s and known_writes == writes else None

    def remember(self, connection: HTTPConnection, caller: Caller, at: float, writes: int) -> None:
        """Keep who asks, as the store said at a time when this process had written so often."""
        self._known[_shown(connection)] = (caller, at, writes)
        while len(self._known) > MOST_CALLERS:
            self._known.popitem(last=False)

    def now(self) -> float:
        """Return the time that is compared [s]."""
        return self._clock()


def _shown(connection: HTTPConnection) -> tuple[str, str]:
    return connection.headers.get("authorization", ""), connection.headers.get("cookie", "")
