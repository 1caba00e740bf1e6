"""What the service answers, as frozen records; fields of a later version are left out when an answer is read."""

from __future__ import annotations

from pydantic import ConfigDict

RECORD = ConfigDict(extra="ignore")
"""Of every record: a newer service may say more than this client knows."""
