"""Runs as the service answers: what they are, how they stand, what they wrote."""

from __future__ import annotations

from dataclasses import field
from datetime import datetime
from typing import Any, Literal

from pydantic.dataclasses import dataclass

from backend.client.records import RECORD

Phase = Literal["locomotion", "manipulation"]
State = Literal["blocked", "queued", "running", "paused", "succeeded", "failed", "cancelled"]

ENDED: frozenset[State] = frozenset({"succeeded", "failed", "cancelled"})
"""The states that a run ends in."""


@dataclass(frozen=True, config=RECORD)
class Progress:
    """How far a run is."""

    epoch: int
    epochs: int
    env_steps: int
    """Control steps of training episodes."""
    episodes: int
    updates: int
    fraction: float
    """Share of the whole training done, 0 to 1."""
    success_rate: float | None
    """Success of the newest test."""
    best_success_rate: float | None
    env_steps_per_s: float | None
    updates_per_s: float | None
    seconds_left: float | None
    """Estimate of what is left [s]."""


@dataclass(frozen=True, config=RECORD)
class Run:
    """One run, as a row of the table."""

    id: str
    task: str
    phase: Phase
    method: str
    seed: int
    preset: str
    state: State
    reason: str | None
    """Why it waits or ended so, in one sentence."""
    needs: list[str]
    """Ids of the runs it waits for."""
    attempt: int
    progress: Progress | None
    created_at: datetime
    started_at: datetime | None
    ended_at: datetime | None
    cancel_requested: bool
    pause_requested: bool
    is_below_gate: bool
    """Only its gate holds it back, so that it can be released."""
    gate_waived: bool
    priority: int
    deleted_at: datetime | None
    settings_hash: str
    """Equal for runs that differ in nothing but the seed."""
    tags: list[str]
    changes: list[str] = field(default_factory=list[str], kw_only=True)
    """Settings in which it is not as its preset, as overrides."""

    @property
    def has_ended(self) -> bool:
        """Whether it has succeeded, failed or was cancelled."""
        return self.state in ENDED


@dataclass(frozen=True, config=RECORD)
class RunDetail(Run):
    """Everything about one run but its curves and files."""

    config: dict[str, Any]
    config_hash: str
    notes: str
    locomotion_run_id: str | None


@dataclass(frozen=True, config=RECORD)
class PlannedRun:
    """One run that a launch would queue, or an existing one that it would share."""

    task: str
    phase: Phase
    method: str
    seed: int
    reused_run_id: str | None
    """The existing run that serves, if one does."""
    config: dict[str, Any]
    zoo_success: float | None = None
    """Measured success of the model of the zoo that serves; None for a run that is trained."""
    equal_run_id: str | None = None
    """A run with the same config and seed, which the new one would repeat; None if there is none."""


@dataclass(frozen=True, config=RECORD)
class ActionResult:
    """What became of a wish for one run."""

    run_id: str
    done: bool
    """Whether it was done; if not, nothing was changed."""
    message: str


@dataclass(frozen=True, config=RECORD)
class RunFile:
    """One stored file of a run."""

    name: str
    kind: str
    size: int
    """Length [bytes]."""
    sha256: str
    created_at: datetime
    url: str
    ticket: str | None
    """Of a recording: what opens its `url` for some minutes without a token."""


@dataclass(frozen=True, config=RECORD)
class RunEvent:
    """One line of a run's history."""

    at: datetime
    event: str
    state: State
    attempt: int
    detail: str | None


@dataclass(frozen=True, config=RECORD)
class Attempt:
    """One claim of a run by a worker."""

    attempt: int
    worker_id: str
    host: str | None
    started_at: datetime
    ended_at: datetime | None
    outcome: str | None
    reason: str | None
    first_cycle: int | None


@dataclass(frozen=True, config=RECORD)
class RunPage:
    """One page of runs."""

    runs: list[Run]
    next_cursor: str | None
    total: int
    """Runs that pass the filter, on all pages."""


@dataclass(frozen=True, config=RECORD)
class LogPiece:
    """A piece of a run's log."""

    text: str
    offset: int
