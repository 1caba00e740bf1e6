"""Secrets in words for people: logs say where something happened, and not with which key."""

from __future__ import annotations

import logging
import re

HIDDEN = "***"

SECRETS = (
    re.compile(r"(?<=[?&]token=)[^&\s\"']+"),
    re.compile(r"(?<=/viewer/)[^/\s\"'?]+"),
    re.compile(r"\bsldr_[\w-]{20,}"),
    re.compile(r"(?<=[Bb]earer )\S+"),
    re.compile(r"(?<=://)([^/\s:@]+):[^/\s@]+(?=@)"),
)
"""Tokens in addresses, addresses of 3D views, tokens anywhere, and passwords in addresses of stores."""


def redact(text: str) -> str:
    """Return a text without its secrets."""
    for pattern in SECRETS:
        text = pattern.sub(HIDDEN, text)
    return text


class HideSecrets(logging.Filter):
    """Take secrets out of every line that passes."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Change the record in place."""
        said = record.getMessage()
        shown = redact(said)
        if shown != said:
            record.msg, record.args = shown, None
        return True


def hide_secrets(*loggers: str) -> None:
    """Let these loggers write no secrets."""
    for name in loggers:
        logging.getLogger(name).addFilter(HideSecrets())
