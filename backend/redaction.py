"""Secrets in words for people: logs say where something happened, and not with which key."""

from __future__ import annotations

import re

HIDDEN = "***"

SECRETS = (
    re.compile(r"(?<=[?&]token=)[^&\s\"']+"),
    re.compile(r"(?<=[?&]ticket=)[^&\s\"']+"),
    re.compile(r"(?<=/viewer/)[^/\s\"'?]+"),
    re.compile(r"\bsldr_[\w-]{20,}"),
    re.compile(r"(?<=[Bb]earer )[^\s\"',]+"),
    re.compile(r"(?<=://)[^/\s:@]+:[^/\s@]+(?=@)"),
)
"""Tokens in addresses, addresses of 3D views, tokens anywhere, and passwords in addresses of stores."""


def redact(text: str) -> str:
    """Return a text without its secrets."""
    for pattern in SECRETS:
        text = pattern.sub(HIDDEN, text)
    return text
