"""How often somebody may try to sign in: few failures for each account and each address, then a pause."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict, deque
from collections.abc import Callable
from ipaddress import IPv6Address, ip_address

WINDOW_S = 15 * 60.0
"""Failures older than this count no more [s]."""

ACCOUNT_FAILURES = 10
"""Failures for one account within the window."""

ADDRESS_FAILURES = 50
"""Failures from one address within the window, whatever the accounts."""

MOST_KEYS = 20_000
"""Accounts and addresses that are remembered; beyond, the one that was quiet longest is forgotten."""

IPV6_PREFIX = 64
"""One household or machine has so many bits of IPv6 addresses in common."""


class Throttle:
    """Count attempts to sign in. An attempt counts as a failure until `forgive` says otherwise."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._failures: OrderedDict[tuple[str, str], deque[float]] = OrderedDict()
        self._lock = threading.Lock()

    def admit(self, name: str | None, address: str) -> float:
        """Count an attempt and return 0, or return after how long the next one is admitted [s].

        Args:
            name: the account; None: there is none, only an address.
            address: where the attempt comes from.
        """
        now = self._clock()
        with self._lock:
            keys = self._keys(name, address)
            pause = max(self._pause(key, limit, now) for key, limit in keys)
            if pause == 0:
                for key, limit in keys:
                    self._failures.setdefault(key, deque(maxlen=limit)).append(now)
                    self._failures.move_to_end(key)
            while len(self._failures) > MOST_KEYS:
                self._failures.popitem(last=False)
        return pause

    def forgive(self, name: str | None, address: str) -> None:
        """Take back an attempt that succeeded, and with it the account's failures."""
        with self._lock:
            for key, _ in self._keys(name, address):
                if key[0] == "account":
                    self._failures.pop(key, None)
                elif self._failures.get(key):
                    self._failures[key].pop()

    def _pause(self, key: tuple[str, str], limit: int, now: float) -> float:
        times = self._failures.get(key)
        while times and now - times[0] >= WINDOW_S:
            times.popleft()
        return WINDOW_S - (now - times[0]) if times and len(times) >= limit else 0.0

    def _keys(self, name: str | None, address: str) -> list[tuple[tuple[str, str], int]]:
        keys = [(("address", network_of(address)), ADDRESS_FAILURES)]
        if name is not None:
            keys.append((("account", name), ACCOUNT_FAILURES))
        return keys


def network_of(address: str) -> str:
    """Return what stands for the machine at an address: IPv6 gives each one more addresses than could be counted."""
    try:
        parsed = ip_address(address)
    except ValueError:
        return address
    if isinstance(parsed, IPv6Address):
        return str(parsed.ipv4_mapped or int(parsed) >> (128 - IPV6_PREFIX))
    return str(parsed)
