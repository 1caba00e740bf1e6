"""A run as other trackers take it: names, settings, and every point that counts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import timedelta

from backend.client.records.runs import RunDetail
from backend.comparison.variants import as_text
from backend.store.database import Database
from backend.store.runs import RunRow
from sldr_core.config import flatten
from sldr_core.records import Step
from worker.recording.curves import read_curves


@dataclass(frozen=True)
class ExportedRun:
    """Hold one run."""

    row: RunRow | RunDetail
    """The run, as the store has it or as a service has told it."""
    steps: Sequence[Step]
    curves: Mapping[str, Sequence[float | None]]
    """Values per metric, as long as the steps; None where a metric was not logged."""

    @property
    def name(self) -> str:
        """What a person calls it."""
        return f"{self.row.task} {self.row.method} {self.row.phase} seed {self.row.seed}"

    @property
    def settings(self) -> dict[str, str]:
        """Its config with dotted names."""
        return {name: as_text(value) for name, value in flatten(self.row.config).items()}

    def points(self) -> Iterator[tuple[Step, float, dict[str, float]]]:
        """Yield each step, when it was logged [s since 1970], and what was logged."""
        begun = self.row.started_at or self.row.created_at
        for index, step in enumerate(self.steps):
            at = (begun + timedelta(seconds=step.wall_seconds)).timestamp()
            values = {name: column[index] for name, column in self.curves.items()}
            yield step, at, {name: value for name, value in values.items() if value is not None}


def load_exported(db: Database, row: RunRow) -> ExportedRun:
    """Read everything that a run has logged, without what a later attempt has superseded."""
    steps, curves = read_curves(db, row.id)
    return ExportedRun(row, steps, curves)
