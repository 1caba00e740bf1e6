"""The API's records of studies: what one asks for, what launching it would do, and how its cells stand."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any

from pydantic import Field

from backend.api.schemas import LocomotionChoice, Seed, Strict
from backend.store.states import RunState
from backend.store.studies.plan import Standing
from backend.store.studies.spec import LONGEST_NAME, LONGEST_NOTE, MOST_PLACES

Word = Annotated[str, Field(min_length=1, max_length=200)]
Name = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME)]
Note = Annotated[str, Field(max_length=LONGEST_NOTE)]


class StudyVariant(Strict):
    """Settings that are tried beside others."""

    name: Name
    overrides: dict[str, Any] = Field(description="Settings laid over those of the study, nested.")


class StudySpec(Strict):
    """Every combination of tasks, methods, seeds and, if there are any, variants."""

    tasks: list[Word] = Field(min_length=1, max_length=MOST_PLACES)
    methods: list[Word] = Field(min_length=1, max_length=MOST_PLACES)
    seeds: list[Seed] = Field(min_length=1, max_length=MOST_PLACES)
    preset: Word
    overrides: dict[str, Any] = Field(
        default_factory=dict, description="Settings laid over the preset in every run, nested."
    )
    variants: list[StudyVariant] = Field(default_factory=list, max_length=MOST_PLACES)
    locomotion: LocomotionChoice = "zoo"


class StudyPreviewRequest(Strict):
    """A study that could be launched, or a longer spec for one that is there."""

    spec: StudySpec
    study_id: Word | None = Field(default=None, description="The study that the spec would be for.")


class StudyLaunch(Strict):
    """A request to make a study and to queue what nothing serves yet."""

    name: Name
    note: Note = ""
    spec: StudySpec


class StudyChange(Strict):
    """A new name or note; what is null stays."""

    name: Name | None = None
    note: Note | None = None


class StudyAddition(Strict):
    """What a study shall have besides."""

    tasks: list[Word] = Field(default_factory=list, max_length=MOST_PLACES)
    methods: list[Word] = Field(default_factory=list, max_length=MOST_PLACES)
    seeds: list[Seed] = Field(default_factory=list, max_length=MOST_PLACES)
    variants: list[StudyVariant] = Field(
        default_factory=list, max_length=MOST_PLACES, description="Only for a study that has variants."
    )


class PlannedPlace(Strict):
    """One training of a study, and how it comes to its run."""

    task: str
    method: str
    variant: str = Field(description="Empty in a study without variants.")
    seed: int
    standing: Standing
    run_id: str | None = Field(description="The existing run; null for a new one.")


class PlannedLocomotion(Strict):
    """A locomotion run that new runs of a study need."""

    task: str
    run_id: str | None = Field(description="The existing run that is reused; null for a new one.")
    zoo_success: float | None = Field(
        description="Measured success of the zoo's model, if that serves; null for a run that is trained."
    )


class StudyEstimate(Strict):
    """What the new runs will cost, as far as this store's own runs tell."""

    training_s: float | None = Field(description="Time that they train, added up, in seconds; null if nobody knows.")
    until_done_s: float | None = Field(
        description="Time until all have ended if the living workers train nothing else; null if nobody knows."
    )
    unknown_runs: int = Field(description="Runs of whose like none has succeeded here.")
    slots: int = Field(description="Runs that the living workers can train at once.")
    disk_bytes: int = Field(description="What their replay files take, nearly all that they write.")
    disk_free_bytes: int = Field(description="What is free where this server keeps its data.")


class StudyPreview(Strict):
    """All that launching a study would do."""

    places: list[PlannedPlace]
    locomotion: list[PlannedLocomotion]
    queued: int = Field(description="Runs that would be made, locomotion runs counted.")
    estimate: StudyEstimate


class StudyOutcome(Strict):
    """What launching a study, or more of it, has done."""

    study_id: str
    queued: int = Field(description="Runs that were made, locomotion runs counted.")
    joined: int = Field(description="Trainings that a run from elsewhere serves.")


class StudySummary(Strict):
    """One row of the list of studies."""

    id: str
    name: str
    note: str
    spec: StudySpec
    created_at: datetime
    deleted_at: datetime | None = Field(description="When a person hid it; it can be restored.")
    size: int = Field(description="Trainings that it asks for, locomotion runs not counted.")
    states: dict[RunState, int] = Field(description="How many of its runs are in each state.")
    progress: float = Field(description="Share of all its trainings done, 0 to 1.")


class Studies(Strict):
    """Studies, the newest first."""

    studies: list[StudySummary]


class StudyRun(Strict):
    """How one run of a study stands."""

    run_id: str
    task: str
    seed: int
    state: RunState
    reason: str | None = Field(description="Why it waits or ended so, in one sentence.")
    progress: float = Field(description="Share of its training done, 0 to 1.")
    best_success_rate: float | None = Field(description="Success of its best test.")


class StudyCell(Strict):
    """The runs of one task, method and variant."""

    task: str
    method: str
    variant: str = Field(description="Empty in a study without variants.")
    runs: list[StudyRun] = Field(description="One for each seed that has one.")
    states: dict[RunState, int]
    progress: float = Field(description="Share of its trainings done, 0 to 1.")
    tested: int = Field(description="Runs that have been tested.")
    best_success_rate: float | None = Field(
        description="Median, over the seeds that have been tested, of the success of the best test."
    )
    missing_seeds: list[int] = Field(description="Seeds that no run stands for.")


class StudyDetail(StudySummary):
    """A study with all its cells."""

    cells: list[StudyCell] = Field(description="Task by task.")
    locomotion: list[StudyRun] = Field(description="The locomotion runs that its runs need, each once.")


class StudyTemplate(Strict):
    """A study that can be launched at once, or be changed first."""

    name: str
    title: str
    summary: str
    spec: StudySpec


class StudyTemplates(Strict):
    """The studies that come with the product."""

    templates: list[StudyTemplate]


class StudyRetry(Strict):
    """Which of a study's ended runs shall be tried again."""

    cancelled: bool = Field(default=False, description="Those that a person cancelled, instead of those that failed.")
