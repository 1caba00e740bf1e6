"""Which ports there are."""

from __future__ import annotations

HIGHEST_PORT = 65535
