"""The API's records: what a request may say and what an answer holds. The TypeScript client is generated from them."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from backend.store.states import RunState
from sldr_core.config import Phase

MOST_LETTERS_OF_LOCOMOTION = 400

Seed = Annotated[int, Field(ge=0, lt=2**31)]


class Strict(BaseModel):
    """Refuse unknown fields and silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class Problem(Strict):
    """One thing wrong with a request."""

    field: str | None = Field(description="Dotted name of the field or setting at fault, if there is one.")
    message: str = Field(description="What is wrong and what to do, in one sentence.")


class Problems(Strict):
    """Everything wrong with a request; the body of every 4xx and 5xx answer."""

    problems: list[Problem]


class Task(Strict):
    """One task, for the launch form."""

    name: str
    goal_text: str
    obs_size: int
    goal_size: int
    robot_action_size: int
    object_action_size: int
    episode_length: int
    success_distance: float | None
    success_angle: float | None
    picture_url: str


class Method(Strict):
    """One method, for the launch form."""

    name: str
    title: str
    summary: str
    needs_locomotion: bool
    phases: list[Phase] = Field(description="The phases it can train.")


class PresetSummary(Strict):
    """One preset, for the launch form."""

    name: str
    summary: str


class Choices(Strict):
    """All that a launch can choose from."""

    tasks: list[Task]
    phases: list[Phase]
    methods: list[Method]
    presets: list[PresetSummary]
    config_schema: dict[str, Any] = Field(description="JSON schema of a run's config, with defaults.")


LocomotionChoice = Annotated[
    str,
    Field(
        min_length=1,
        max_length=MOST_LETTERS_OF_LOCOMOTION,
        description="Where the locomotion models come from: `zoo` takes those that come with the product and trains "
        "the others, `train` trains all, and ids of locomotion runs, separated by commas, name them.",
    ),
]


class Launch(Strict):
    """A request to train: one run per seed, with the locomotion run they need."""

    task: str
    phase: Phase = "manipulation"
    method: str
    seeds: list[Seed] = Field(min_length=1, max_length=100)
    preset: str
    overrides: dict[str, Any] = Field(default_factory=dict, description="Settings laid over the preset, nested.")
    locomotion: LocomotionChoice = "zoo"


class PlannedRun(Strict):
    """One run that a launch would queue, or an existing one that it would share."""

    task: str
    phase: Phase
    method: str
    seed: int
    reused_run_id: str | None = Field(description="The existing run that serves, if one does.")
    zoo_success: float | None = Field(
        description="Measured success of the zoo's model, if that serves; null for a run that is trained."
    )
    equal_run_id: str | None = Field(
        description="A run with the same config and seed, which the new one would repeat; null if there is none."
    )
    config: dict[str, Any]


class LaunchPlan(Strict):
    """What a launch would do."""

    runs: list[PlannedRun]


class Progress(Strict):
    """How far a run is. Null until its first report."""

    epoch: int
    epochs: int
    env_steps: int
    episodes: int
    updates: int
    fraction: float = Field(description="Share of the whole training done, 0 to 1.")
    success_rate: float | None = Field(description="Success of the newest test.")
    best_success_rate: float | None
    env_steps_per_s: float | None
    updates_per_s: float | None
    seconds_left: float | None


class RunSummary(Strict):
    """One row of the runs table."""

    id: str
    task: str
    phase: Phase
    method: str
    seed: int
    preset: str
    state: RunState
    reason: str | None = Field(description="Why it waits or ended so, in one sentence.")
    needs: list[str] = Field(description="Ids of the runs it waits for.")
    attempt: int
    progress: Progress | None
    created_at: datetime
    started_at: datetime | None
    ended_at: datetime | None
    trained_s: float = Field(
        description="Time of its attempts that have ended, in seconds; pauses and waits between them do not count."
    )
    training_since: datetime | None = Field(description="When the attempt began that runs; null if none does.")
    cancel_requested: bool = Field(description="It will end; its worker has not ended it yet.")
    pause_requested: bool = Field(description="It will pause; its worker has not paused it yet.")
    is_below_gate: bool = Field(description="Only its gate holds it back, so that it can be released.")
    gate_waived: bool = Field(description="A person has let it start below its gate.")
    priority: int = Field(description="Runs of a higher one start first.")
    deleted_at: datetime | None = Field(description="When a person hid it; it can be restored.")
    settings_hash: str = Field(description="Equal for runs that differ in nothing but the seed.")
    changes: list[str] = Field(
        description="Settings in which it is not as its preset, as overrides; the device and threads are none."
    )
    tags: list[str] = Field(description="What people call it, in the order of the alphabet.")


class RunPage(Strict):
    """One page of runs, in the order asked for."""

    runs: list[RunSummary]
    values: list[list[float | None]] = Field(
        description="For each run, the values of the columns asked for; null where it has not logged the metric."
    )
    next_cursor: str | None
    total: int


class LaunchResult(Strict):
    """The runs of a launch, queued or shared, the locomotion run first."""

    runs: list[RunSummary]


class RunDetail(RunSummary):
    """Everything about one run but its curves and logs."""

    config: dict[str, Any]
    config_hash: str
    notes: str = Field(description="What people wrote about it, as plain text.")
    locomotion_run_id: str | None
    has_policy: bool = Field(description="Whether there is a policy that can be watched in 3D.")
    has_recording: bool = Field(description="Whether there is a Rerun file to download.")


class RunEvent(Strict):
    """One line of a run's history."""

    at: datetime
    event: str
    state: RunState
    attempt: int
    detail: str | None


class RunEvents(Strict):
    """A run's history, oldest first."""

    events: list[RunEvent]


class MetricBatch(Strict):
    """The points of a run after a cursor, in columns. Value columns are as long as `step`; null where not logged."""

    cursor: int = Field(description="Pass as `after` to get what comes next.")
    attempt: list[int]
    step: list[int] = Field(description="Cycles since the start of the training.")
    epoch: list[int]
    env_steps: list[int]
    episodes: list[int]
    updates: list[int]
    wall_seconds: list[float]
    values: dict[str, list[float | None]]


class LogTail(Strict):
    """A piece of a run's log."""

    text: str
    offset: int = Field(description="Pass as `after` to get what comes next.")


class RunFile(Strict):
    """One stored file of a run."""

    name: str
    kind: str
    size: int
    sha256: str
    created_at: datetime
    url: str
    ticket: str | None = Field(
        description="Of a recording: `url` with `?ticket=` and this opens for some minutes without a session."
    )


class RunFiles(Strict):
    """The stored files of a run."""

    files: list[RunFile]


class ViewerSession(Strict):
    """A 3D session: poll it until it is ready, then open its url."""

    id: str
    run_id: str
    state: Literal["starting", "ready", "ended", "failed"]
    url: str | None = Field(description="Path of the 3D page, below this server, once ready.")
    message: str | None = Field(description="What it shows, or why it ended or failed.")


class Health(Strict):
    """Whether the service can do its work."""

    status: Literal["ok", "degraded"]
    version: str
    store: str = Field(description="The database that answers: `sqlite` or `postgresql`.")
    schema_revision: str = Field(description="The revision of its tables.")
    workers_alive: int
    worker_seen_at: datetime | None = Field(description="The newest sign of life of a listed worker.")
    viewer_alive: bool
