"""The API's records of the queue: what is asked of runs, in which order they start, and who trains them."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import Field

from backend.api.schemas import RunSummary, Strict
from backend.store.actions import Action
from backend.store.order import HIGHEST_PRIORITY
from sldr_core.config import Phase

MOST_RUNS = 1000
"""Runs that one request may name."""

RunIds = Annotated[list[str], Field(min_length=1, max_length=MOST_RUNS)]


class RunActions(Strict):
    """A wish for one or more runs."""

    # JSON has no enums: the word is taken for one, and nothing else is.
    action: Annotated[Action, Field(strict=False)]
    run_ids: RunIds


class ActionResult(Strict):
    """What became of the wish for one run."""

    run_id: str
    done: bool = Field(description="Whether it was done; if not, nothing was changed.")
    message: str = Field(description="What follows, or why it was not done, in one sentence.")


class ActionResults(Strict):
    """What became of the wish, run by run, in the order asked for."""

    results: list[ActionResult]


class PriorityChange(Strict):
    """A new priority for runs: higher ones start first, 0 is usual."""

    run_ids: RunIds
    priority: int = Field(ge=-HIGHEST_PRIORITY, le=HIGHEST_PRIORITY)


class Move(Strict):
    """A new place for a run that waits."""

    before: str | None = Field(description="The waiting run that it shall start before; null for the end.")


class QueueEntry(Strict):
    """When a run that has not ended will start, and what it waits for."""

    run: RunSummary
    position: int | None = Field(description="Place among the runs that wait for a worker, from 1; null for others.")
    waits_for: str = Field(description="What it waits for and why, or what it does, in one sentence.")
    starts_at: datetime | None = Field(description="When it started or is expected to; null if nobody can say.")
    ends_at: datetime | None = Field(description="When it is expected to end; null if nobody can say.")


class Queue(Strict):
    """The first of the runs that have not ended, in the order in which they will start."""

    entries: list[QueueEntry]
    total: int = Field(description="Runs that have not ended, shown or not.")


class Attempt(Strict):
    """One claim of a run by a worker."""

    attempt: int
    worker_id: str
    host: str | None
    started_at: datetime
    ended_at: datetime | None
    outcome: str | None = Field(description="What ended it; null while it runs.")
    reason: str | None
    first_cycle: int | None = Field(description="First cycle that it logged; it replaces earlier attempts from there.")


class Attempts(Strict):
    """The attempts of a run, oldest first."""

    attempts: list[Attempt]


class WorkerRun(Strict):
    """A run that a worker trains now."""

    id: str
    task: str
    phase: Phase
    method: str
    seed: int


class Worker(Strict):
    """One worker process, what it has to train with, and what it does."""

    id: str
    host: str
    pid: int
    executor: str
    slots: int
    running: list[WorkerRun]
    cores: int = Field(description="Cores that it may use; 0 if nobody knows.")
    processor: str | None = Field(description="Model that these are of, if it says so.")
    gpu: str | None
    memory_total: int = Field(description="Memory of its machine, in bytes; 0 if nobody knows.")
    memory_used: int
    draining: bool = Field(description="It takes no further run and keeps those that it has.")
    last_heartbeat_at: datetime
    alive: bool


class Workers(Strict):
    """The workers known to the store."""

    workers: list[Worker]


class Draining(Strict):
    """Whether a worker shall take no further run."""

    draining: bool
