"""Passwords: what is asked of them, and how they are kept (argon2id, RFC 9106)."""

from __future__ import annotations

import threading
from base64 import b64encode
from secrets import token_bytes

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError
from argon2.low_level import ARGON2_VERSION

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
        self._nobodys = _hash_of_nothing(self._hasher)

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


def _hash_of_nothing(hasher: PasswordHasher) -> str:
    """Return what no password fits: drawn, not made, for a service should not begin with the work of a hash."""
    salt, digest = (b64encode(token_bytes(size)).decode().rstrip("=") for size in (hasher.salt_len, hasher.hash_len))
    costs = f"m={hasher.memory_cost},t={hasher.time_cost},p={hasher.parallelism}"
    return f"$argon2id$v={ARGON2_VERSION}${costs}${salt}${digest}"


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
