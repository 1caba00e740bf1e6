"""The run state machine: which states there are and which changes are allowed."""

from __future__ import annotations

from enum import StrEnum


class RunState(StrEnum):
    """Where a run stands."""

    BLOCKED = "blocked"
    """Waits for another run, or its locomotion model missed the gate."""
    QUEUED = "queued"
    """Waits for a free worker."""
    RUNNING = "running"
    """A worker trains it."""
    PAUSED = "paused"
    """Checkpointed, its slot given back, waiting for a person."""
    SUCCEEDED = "succeeded"
    """Trained to its end."""
    FAILED = "failed"
    """Ended by an error that would repeat, or out of attempts."""
    CANCELLED = "cancelled"
    """Ended by a person."""
