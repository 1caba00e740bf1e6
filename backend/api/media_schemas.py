"""The API's records of pictures and videos."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from backend.api.schemas import Strict

BLOCK = 8
"""Width and height are multiples of it [pixels]: encoders stretch what is not."""
SMALLEST_SIDE, LARGEST_SIDE = 64, 1920
"""Of a video [pixels]."""


class VideoOrder(Strict):
    """A request for a video of an episode."""

    epoch: int | None = Field(
        default=None,
        ge=0,
        le=10**9,
        description="The test whose episode it shows; left out: the newest policy makes one.",
    )
    number: int = Field(
        default=0, ge=0, lt=2**31, description="Which episode of the test; without a test, the seed of start and goal."
    )
    width: int = Field(default=640, ge=SMALLEST_SIDE, le=LARGEST_SIDE, multiple_of=BLOCK, description="[pixels]")
    height: int = Field(default=480, ge=SMALLEST_SIDE, le=LARGEST_SIDE, multiple_of=BLOCK, description="[pixels]")
    format: Literal["mp4", "webm"] = "mp4"


class Video(Strict):
    """A video: poll it until it is done, then play its url."""

    id: str
    run_id: str
    epoch: int | None = Field(description="The test whose episode it shows; null: one of the newest policy then.")
    number: int = Field(description="Which episode of the test; without a test, the seed of start and goal.")
    width: int
    height: int
    name: str = Field(description="Its name among the run's files.")
    state: Literal["queued", "running", "done", "failed"]
    reason: str | None = Field(description="Why it failed, in one sentence.")
    url: str | None = Field(description="Path of the file, below this server, once it is done.")
    created_at: datetime


class Videos(Strict):
    """The videos of a run, the newest first."""

    videos: list[Video]
