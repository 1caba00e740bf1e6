"""What the service says of itself: its health, its workers, and what can be trained."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from pydantic.dataclasses import dataclass

from backend.client.records import RECORD
from backend.client.records.runs import Phase


@dataclass(frozen=True, config=RECORD)
class Health:
    """Whether the service can do its work."""

    status: str
    """`ok`, or `degraded` without a worker or viewer."""
    version: str
    store: str
    """The database that answers: `sqlite` or `postgresql`."""
    schema_revision: str
    workers_alive: int
    worker_seen_at: datetime | None
    viewer_alive: bool


@dataclass(frozen=True, config=RECORD)
class Worker:
    """One worker process."""

    id: str
    host: str
    executor: str
    slots: int
    gpu: str | None
    draining: bool
    last_heartbeat_at: datetime
    alive: bool


@dataclass(frozen=True, config=RECORD)
class Named:
    """A task, method or preset by its name."""

    name: str


@dataclass(frozen=True, config=RECORD)
class Choices:
    """All that a launch can choose from."""

    tasks: list[Named]
    phases: list[Phase]
    methods: list[Named]
    presets: list[Named]
    config_schema: dict[str, Any]
    """JSON schema of a run's config, with defaults."""
