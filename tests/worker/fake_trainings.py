"""Short times and fake trainings, for workers here and in processes of their own, which find only what lies here."""

from __future__ import annotations

import sys
from pathlib import Path

from worker.supervisor import Timing

HERE = Path(__file__).parent
TIMING = Timing(
    poll_s=0.05,
    heartbeat_s=0.2,
    lease_s=60.0,
    reap_s=0.1,
    cancel_grace_s=0.5,
    stop_grace_s=5.0,
    retry_backoff_s=0.0,
)


def fake_command(behaviour: str) -> list[str]:
    """Return the command of a child that behaves so."""
    return [sys.executable, str(HERE / "fake_child.py"), behaviour]
