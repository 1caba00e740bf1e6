"""The seam between science and service: where a training puts its numbers and files."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Literal, Protocol

from sldr_core.episodes import RecordedTest
from sldr_core.records import Step

StopReason = Literal["cancel", "pause", "shutdown"]
"""Why a training is asked to stop: for good, until a person resumes it, or until a worker is free again."""


class Recorder(Protocol):
    """Receive what a training makes. The training owns no database, no network and no clock but this."""

    @property
    def directory(self) -> Path:
        """The run's own directory; checkpoints and the replay file live here."""
        ...

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Keep finite numbers under their `group/name`."""
        ...

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        """Keep a file: `write` fills a temporary path, which is synced and renamed to `name`."""
        ...

    def record_episodes(self, test: RecordedTest, kept_epochs: Collection[int]) -> None:
        """Keep the first episodes of a test, and of the tests before it those of `kept_epochs` alone."""
        ...

    def stop_requested(self) -> StopReason | None:
        """Tell whether the training should checkpoint and end now."""
        ...
