"""Passwords: what is asked of them, and how they are kept (argon2id, RFC 9106)."""

from __future__ import annotations

import threading

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

SHORTEST_PASSWORD = 12
"""Characters; length is what counts, so nothing else is asked for."""
LONGEST_PASSWORD = 256
"""Characters; more would only make the server work."""

TIME_COST = 3
"""Passes over the memory."""
MEMORY_KIB = 64 * 1024
"""Memory that one hash takes [KiB]."""
LANES = 1
"""Threads of one hash."""

AT_ONCE = 2
"""Hashes made at the same time, so that a crowd that signs in takes neither all memory nor all cores."""


class Passwords:
    """Hash passwords and compare them. A call takes about a tenth of a second: never make it on the event loop."""

    def __init__(self, hasher: PasswordHasher | None = None) -> None:
        self._hasher = hasher or PasswordHasher(TIME_COST, MEMORY_KIB, LANES)
        self._turns = threading.BoundedSemaphore(AT_ONCE)
        self._nobodys = self._hasher.hash("the password of an account that does not exist")

    def hash(self, password: str) -> str:
        """Return what is stored of a password."""
        with self._turns:
            return self._hasher.hash(password.encode(errors="surrogatepass"))

    def matches(self, stored: str | None, password: str) -> bool:
        """Tell whether a password is the one that was stored; without an account it takes as long, and is not."""
        with self._turns:
            try:
                self._hasher.verify(stored or self._nobodys, password.encode(errors="surrogatepass"))
            except (VerificationError, InvalidHashError):
                return False
        return stored is not None

    def is_outdated(self, stored: str) -> bool:
        """Tell whether a password was stored with other parameters than today's."""
        return self._hasher.check_needs_rehash(stored)


def find_weakness(name: str, password: str) -> str | None:
    """Return what is wrong with a password for an account, in one sentence, or None."""
    if len(password) < SHORTEST_PASSWORD:
        return f"It has {len(password)} characters; use at least {SHORTEST_PASSWORD}, several words for example."
    if len(password) > LONGEST_PASSWORD:
        return f"It has {len(password)} characters; use at most {LONGEST_PASSWORD}."
    lowered = password.lower()
    if len(set(lowered)) < 5 or name.lower() * 2 in lowered or lowered.strip("0123456789!.") == name.lower():
        return "It is easy to guess; use several words that do not belong together."
    return None
