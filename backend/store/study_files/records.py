"""What a study file says of itself: strict records, because the file may come from anyone.

```
study.json             the study, its runs, and the size and checksum of everything else; `StudyFile`
metrics/<key>.json     the curves of a run; `Curves`
runs/<key>/<name>      its files: policies, locomotion model, recorded episodes
```
"""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, AwareDatetime, BaseModel, ConfigDict, Field

from backend.store.studies.spec import LONGEST_NOTE, MOST_PLACES

FORMAT: Literal[1] = 1
"""Raised when an older program could not read a newer file."""
STUDY_MEMBER = "study.json"
MOST_RUNS = 2500
MOST_FILES = 12
MOST_EPISODES = 100
MOST_EVENTS = 2000
MOST_CYCLES = 100_000
MOST_METRICS = 500
LONGEST_MACHINE = 200
"""Of what says what trained a run [characters]."""
LARGEST_FILE = 128 * 2**20
"""Of one file of a run [bytes]."""

EARLIEST, LATEST = datetime(2000, 1, 1, tzinfo=UTC), datetime(2200, 1, 1, tzinfo=UTC)
"""Times outside cannot be of a run, and no database has to bear them."""


def _in_reason(at: datetime) -> datetime:
    if not EARLIEST <= at <= LATEST:
        raise ValueError("no run was trained then")
    return at


Time = Annotated[AwareDatetime, AfterValidator(_in_reason)]
Key = Annotated[str, Field(pattern=r"^[0-9a-f]{1,32}$")]
"""What a run is called in the file."""
Word = Annotated[str, Field(min_length=1, max_length=200, pattern=r"^[^\x00-\x1f]*$")]
Text = Annotated[str, Field(max_length=20_000, pattern=r"^[^\x00]*$")]
Count = Annotated[int, Field(ge=0, le=2**31 - 1)]
Large = Annotated[int, Field(ge=0, le=2**53)]
LARGEST_SEED = 2**31 - 1
Seed = Annotated[int, Field(ge=0, le=LARGEST_SEED)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]
FileName = Annotated[str, Field(pattern=r"^(policy-(best|newest)\.pt|locomotion\.pt|episodes-epoch-[0-9]{4,6}\.npz)$")]
"""The files that a study file may hold; no other name is ever written to a disk."""


class Strict(BaseModel):
    """Take exactly the fields that are named, of exactly their types."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class Member(Strict):
    """Something else in the file."""

    size: Annotated[int, Field(ge=0, le=LARGEST_FILE)]
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


class RunFile(Member):
    """A file of a run."""

    name: FileName
    kind: Literal["policy", "locomotion", "episodes"]


class Place(Strict):
    """Where a run stands in the study."""

    task: Word
    method: Word
    variant: Annotated[str, Field(max_length=200)]
    seed: Seed


class EventRecord(Strict):
    """Something that happened to a run."""

    at: Time
    event: Word
    attempt: Count
    detail: Text | None


class EpisodeRecord(Strict):
    """A recorded episode, as the list of episodes shows it."""

    epoch: Count
    number: Count
    file: FileName
    success: bool
    tag: Word
    task_return: Number
    worst_q: Number | None
    worst_q_step: Count | None
    length: Count
    resimulates: bool


class ProgressRecord(Strict):
    """How far a run came."""

    epoch: Count
    epochs: Count
    env_steps: Large
    episodes: Count
    updates: Count
    fraction: Share
    success_rate: Share | None
    best_success_rate: Share | None
    env_steps_per_s: Number | None
    updates_per_s: Number | None


class RunRecord(Strict):
    """A run that has succeeded."""

    key: Key
    preset: Word
    config: dict[str, Any]
    success_rate: Share | None
    created_at: Time
    started_at: Time | None
    ended_at: Time | None
    needs: Annotated[list[Key], Field(max_length=8)]
    machine: Annotated[str, Field(max_length=LONGEST_MACHINE, pattern=r"^[^\x00-\x1f]*$")] = ""
    """What trained it, if that is known."""
    place: Place | None
    progress: ProgressRecord | None
    events: Annotated[list[EventRecord], Field(max_length=MOST_EVENTS)]
    episodes: Annotated[list[EpisodeRecord], Field(max_length=MOST_EPISODES)]
    files: Annotated[list[RunFile], Field(max_length=MOST_FILES)]
    metrics: Member


class VariantRecord(Strict):
    """Settings that were tried beside others."""

    name: Annotated[str, Field(min_length=1, max_length=80)]
    overrides: dict[str, Any]


class SpecRecord(Strict):
    """The axes of the study."""

    tasks: Annotated[list[Word], Field(min_length=1, max_length=MOST_PLACES)]
    methods: Annotated[list[Word], Field(min_length=1, max_length=MOST_PLACES)]
    seeds: Annotated[list[Seed], Field(min_length=1, max_length=MOST_PLACES)]
    preset: Word
    overrides: dict[str, Any]
    variants: Annotated[list[VariantRecord], Field(max_length=MOST_PLACES)] = []
    locomotion: Literal["zoo", "train"] = "train"


class StudyRecord(Strict):
    """What the study asked for."""

    name: Word
    note: Annotated[str, Field(max_length=LONGEST_NOTE, pattern=r"^[^\x00]*$")]
    spec: SpecRecord


class StudyFile(Strict):
    """The whole of `study.json`."""

    format: Literal[1]
    made_at: Time
    versions: dict[Word, Word]
    machine: Word
    study: StudyRecord
    runs: Annotated[list[RunRecord], Field(min_length=1, max_length=MOST_RUNS)]


class Curve(Strict):
    """The values of one metric, and the places of their steps in `Curves.steps`."""

    at: Annotated[list[Count], Field(max_length=MOST_CYCLES)]
    values: Annotated[list[Number], Field(max_length=MOST_CYCLES)]


class Curves(Strict):
    """All curves of a run, of the cycles that count."""

    steps: Annotated[list[tuple[Count, Count, Large, Count, Count, Number]], Field(max_length=MOST_CYCLES)]
    """Cycle, epoch, control steps, episodes, updates, seconds."""
    metrics: Annotated[dict[Word, Curve], Field(max_length=MOST_METRICS)]


def metrics_member(key: str) -> str:
    """Return where the curves of a run lie."""
    return f"metrics/{key}.json"


def file_member(key: str, name: str) -> str:
    """Return where a file of a run lies."""
    return f"runs/{key}/{name}"
