"""The recorder of a worker's training: files in the run's directory, numbers and file rows in the store."""

from __future__ import annotations

import hashlib
import logging
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Protocol

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.files import register_file
from backend.store.metrics import MetricPoint, read_metrics
from backend.store.progress import Progress, find_progress
from backend.store.settings import Settings
from sldr_core.errors import TrainingDiverged
from sldr_core.records import Step
from worker.metric_writer import MetricWriter
from worker.words import StopWord

log = logging.getLogger(__name__)


class WriteCurves(Protocol):
    """Write a run's curves to a Rerun file."""

    def __call__(self, path: Path, run_title: str, points: Sequence[MetricPoint]) -> None:
        """Write all `points` to `path`."""
        ...


class StoreRecorder:
    """Be the `Recorder` of one attempt. Use it in a `with`: leaving it writes what is still queued."""

    def __init__(
        self,
        db: Database,
        settings: Settings,
        claim: Claim,
        stop_requested: Callable[[], StopWord | None],
        write_curves: WriteCurves | None = None,
    ) -> None:
        self._db = db
        self._home = settings.home
        self._directory = settings.run_directory(claim.run_id)
        self._directory.mkdir(parents=True, exist_ok=True)
        self._claim = claim
        self._stop_requested = stop_requested
        self._write_curves = write_curves
        self._known = find_progress(db, claim.run_id)
        self._writer = MetricWriter(db, claim)

    def __enter__(self) -> StoreRecorder:
        return self

    def __exit__(self, *_: object) -> None:
        self._writer.close()
        self._save_curves()

    @property
    def directory(self) -> Path:
        """The run's own directory."""
        return self._directory

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Queue finite numbers for the store, and derive the run's progress from them.

        Raises:
            TrainingDiverged: a number is not finite.
            StaleFence: the run was given to another worker.
        """
        for name, value in metrics.items():
            if not math.isfinite(value):
                raise TrainingDiverged(f"Metric {name} became {value} in cycle {step.cycle}; lower the learning rate.")
        self._known = self._progress(step, metrics)
        self._writer.put(MetricPoint(step, dict(metrics)), self._known)
        if "test/success_rate" in metrics:
            log.info("epoch %d: test success %.1f %%", step.epoch, 100.0 * metrics["test/success_rate"])

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        """Write a file of the run safely, and register it with size and checksum.

        Raises:
            StaleFence: the run was given to another worker.
        """
        # PyTorch comes with this import; a training that saves files has it loaded anyway.
        from sldr_core.training import write_atomically

        self._writer.check()
        path = write_atomically(self._directory / name, write)
        size, digest = path.stat().st_size, checksum(path)
        register_file(self._db, self._claim, name, kind, str(path.relative_to(self._home)), size, digest)
        return path

    def stop_requested(self) -> StopWord | None:
        """Return what the supervisor asked for, if anything.

        Raises:
            StaleFence: the run was given to another worker.
        """
        self._writer.check()
        return self._stop_requested()

    def _progress(self, step: Step, metrics: Mapping[str, float]) -> Progress:
        """Lay what was logged over what was known; tests are rarer than cycles."""
        known, config = self._known, self._claim.config
        return Progress(
            epoch=step.epoch,
            epochs=config.loop.epochs,
            env_steps=step.env_steps,
            episodes=step.episodes,
            updates=step.updates,
            fraction=metrics.get("progress/fraction", min(1.0, step.cycle / config.total_cycles)),
            success_rate=metrics.get("test/success_rate", known.success_rate if known else None),
            best_success_rate=metrics.get("test/best_success_rate", known.best_success_rate if known else None),
            env_steps_per_s=metrics.get("speed/env_steps_per_s", known.env_steps_per_s if known else None),
            updates_per_s=metrics.get("speed/updates_per_s", known.updates_per_s if known else None),
            seconds_left=metrics.get("progress/seconds_left"),
        )

    def _save_curves(self) -> None:
        """Write the run's curves, of this attempt and those before it, to a Rerun file."""
        points = run_points(self._db, self._claim.run_id) if self._write_curves is not None else []
        if self._write_curves is None or not points:
            return
        claim, write_curves = self._claim, self._write_curves
        title = f"{claim.config.task} {claim.config.method} {claim.config.phase}, seed {claim.config.seed}"
        try:
            self.save_file(
                f"curves-attempt-{claim.attempt}.rrd", "recording", lambda path: write_curves(path, title, points)
            )
        except (StaleFence, StoreUnavailable):
            raise
        except Exception:
            # A training must not fail for a copy of what is in the store.
            log.exception("The Rerun file could not be written.")


def run_points(db: Database, run_id: str) -> list[MetricPoint]:
    """Return every point of a run that no later attempt has superseded."""
    points: list[MetricPoint] = []
    cursor = 0
    while True:
        columns = read_metrics(db, run_id, cursor)
        if columns.cursor == cursor:
            return points
        cursor = columns.cursor
        for index, cycle in enumerate(columns.step):
            step = Step(
                cycle=cycle,
                epoch=columns.epoch[index],
                env_steps=columns.env_steps[index],
                episodes=columns.episodes[index],
                updates=columns.updates[index],
                wall_seconds=columns.wall_seconds[index],
            )
            logged = {name: column[index] for name, column in columns.values.items()}
            points.append(MetricPoint(step, {name: value for name, value in logged.items() if value is not None}))


def checksum(path: Path) -> str:
    """Return the sha256 of a file in hex."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
