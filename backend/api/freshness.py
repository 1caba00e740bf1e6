"""How old an answer may be for whoever asks: pages that ask every two seconds take one that is a second old."""

from __future__ import annotations

import re

from starlette.datastructures import Headers

OLDEST_S = 5.0
"""Nothing is given that is older, whatever age is asked for [s]."""

MAX_AGE = re.compile(r"(?:^|[\s,])max-age=(\d{1,6})(?:$|[\s,])")


def accepted_age(headers: Headers) -> float:
    """Return how old an answer may be by a request's `Cache-Control` (RFC 9111 5.2.1.1) [s]; 0: it has to be new."""
    found = MAX_AGE.search(headers.get("cache-control", "").lower())
    return min(float(found[1]), OLDEST_S) if found else 0.0
