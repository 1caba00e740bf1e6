"""Studies as the service answers: what they ask for and how they stand."""

from __future__ import annotations

from dataclasses import field
from datetime import datetime
from typing import Any, Literal

from pydantic.dataclasses import dataclass

from backend.client.records import RECORD
from backend.client.records.runs import ENDED, State

Standing = Literal["new", "joined", "in_study"]


@dataclass(frozen=True, config=RECORD)
class Variant:
    """Settings that are tried beside others."""

    name: str
    overrides: dict[str, Any] = field(default_factory=dict)
    """Settings laid over those of the study, nested."""


@dataclass(frozen=True, config=RECORD)
class StudySpec:
    """Every combination of tasks, methods, seeds and, if there are any, variants."""

    tasks: list[str]
    methods: list[str]
    seeds: list[int]
    preset: str
    overrides: dict[str, Any] = field(default_factory=dict)
    """Settings laid over the preset in every run, nested."""
    variants: list[Variant] = field(default_factory=list)
    locomotion: str = "zoo"
    """Where locomotion models come from: `zoo`, `train`, or ids of locomotion runs, separated by commas."""


@dataclass(frozen=True, config=RECORD)
class PlannedPlace:
    """One training of a study, and how it comes to its run."""

    task: str
    method: str
    variant: str
    """Empty in a study without variants."""
    seed: int
    standing: Standing
    run_id: str | None


@dataclass(frozen=True, config=RECORD)
class PlannedLocomotion:
    """A locomotion run that new runs of a study need."""

    task: str
    run_id: str | None
    """The existing run that is reused; None for a new one."""
    zoo_success: float | None = None
    """Measured success of the model of the zoo that serves; None for a run that is trained."""


@dataclass(frozen=True, config=RECORD)
class StudyEstimate:
    """What the new runs will cost."""

    training_s: float | None
    """Time that they train, added up; None if nobody knows [s]."""
    until_done_s: float | None
    unknown_runs: int
    """Runs of whose like none has succeeded there."""
    slots: int
    disk_bytes: int


@dataclass(frozen=True, config=RECORD)
class StudyPreview:
    """All that launching a study would do."""

    places: list[PlannedPlace]
    locomotion: list[PlannedLocomotion]
    queued: int
    """Runs that would be made, locomotion runs counted."""
    estimate: StudyEstimate


@dataclass(frozen=True, config=RECORD)
class StudyOutcome:
    """What launching a study, or more of it, has done."""

    study_id: str
    queued: int
    joined: int
    """Trainings that a run from elsewhere serves."""


@dataclass(frozen=True, config=RECORD)
class StudyRun:
    """How one run of a study stands."""

    run_id: str
    task: str
    seed: int
    state: State
    reason: str | None
    progress: float
    best_success_rate: float | None


@dataclass(frozen=True, config=RECORD)
class StudyCell:
    """The runs of one task, method and variant."""

    task: str
    method: str
    variant: str
    runs: list[StudyRun]
    progress: float
    tested: int
    best_success_rate: float | None
    """Median over the seeds that have been tested."""
    missing_seeds: list[int]


@dataclass(frozen=True, config=RECORD)
class Study:
    """One row of the list of studies."""

    id: str
    name: str
    note: str
    spec: StudySpec
    created_at: datetime
    deleted_at: datetime | None
    size: int
    """Trainings that it asks for, locomotion runs not counted."""
    states: dict[State, int]
    progress: float

    @property
    def has_ended(self) -> bool:
        """Whether none of its runs will go on by itself."""
        return all(state in ENDED for state, count in self.states.items() if count)


@dataclass(frozen=True, config=RECORD)
class StudyDetail(Study):
    """A study with all its cells."""

    cells: list[StudyCell]
    locomotion: list[StudyRun]
