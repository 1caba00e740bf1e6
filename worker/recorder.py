"""The recorder of a worker's training: files in the run's directory, numbers and file rows in the store."""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable, Collection, Mapping
from functools import partial
from pathlib import Path

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.metrics import MetricPoint
from backend.store.outcomes import CHECKPOINT_KIND
from backend.store.progress import Progress, find_progress
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from sldr_core.disk import write_atomically
from sldr_core.episodes import KIND as EPISODES_KIND
from sldr_core.episodes import RecordedTest, episodes_file, remove_episodes, write_episodes
from sldr_core.errors import SldrError, TrainingDiverged
from sldr_core.records import Step
from worker.file_keeper import FileKeeper
from worker.metric_writer import MetricWriter
from worker.sign_of_life import showing_life
from worker.words import StopWord

RECORDING_INTERVAL_S = 60.0
"""While a run trains, its Rerun file is renewed after a test if it is older than this [s]."""

RECORDING_SHARE = 0.01
"""No more than this share of a training's time goes into that."""

log = logging.getLogger(__name__)


WriteRecording = Callable[[Path], None]
"""Write all that the store has of the run to a Rerun file."""


class StoreRecorder:
    """Be the `Recorder` of one attempt. Use it in a `with`: leaving it writes what is still queued."""

    def __init__(
        self,
        db: Database,
        settings: Settings,
        claim: Claim,
        stop_requested: Callable[[], StopWord | None],
        write_recording: WriteRecording | None = None,
    ) -> None:
        self._db = db
        self._directory = settings.run_directory(claim.run_id)
        self._directory.mkdir(parents=True, exist_ok=True)
        self._claim = claim
        self._keeper = FileKeeper(db, FileStorage(settings), claim)
        self._stop_requested = stop_requested
        self._write_recording = write_recording
        self._record_at = time.monotonic() + RECORDING_INTERVAL_S
        self._known = find_progress(db, claim.run_id)
        self._writer = MetricWriter(db, claim)

    def __enter__(self) -> StoreRecorder:
        return self

    def __exit__(self, *_: object) -> None:
        self._writer.close()
        self._save_recording()

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
            if time.monotonic() > self._record_at:
                self._save_recording()

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        """Write a file of the run safely, and keep it where other machines find it, with size and checksum.

        Raises:
            StaleFence: the run was given to another worker.
            StoreUnavailable: the place that machines share files through could not be used for minutes.
        """
        self._writer.check()
        if kind == CHECKPOINT_KIND:
            # Another attempt goes on after the checkpoint, so what was logged before it must not be lost with this one.
            self._writer.flush()
        path = write_atomically(self._directory / name, write)
        with showing_life(self._db, self._claim):
            self._keeper.keep(name, kind, path)
        self._writer.check()
        return path

    def record_episodes(self, test: RecordedTest, kept_epochs: Collection[int]) -> None:
        """Keep the episodes of a test, list them in the store, and drop those of earlier tests that are not to stay.

        Raises:
            StaleFence: the run was given to another worker.
            StoreUnavailable: store or shared place could not be used for minutes.
        """
        newest = test.origin.epoch
        self.save_file(episodes_file(newest), EPISODES_KIND, partial(write_episodes, test=test))
        self._keeper.keep_episodes(test, kept_epochs)
        remove_episodes(self._directory, newest, kept_epochs)

    def stop_requested(self) -> StopWord | None:
        """Return what the supervisor asked for, if anything; who asks often shows that the training goes on.

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

    def _save_recording(self) -> None:
        """Write the run, as this attempt and those before it have left it, to a Rerun file."""
        write = self._write_recording
        if write is None or self._known is None:
            return
        begun = time.monotonic()
        self._writer.flush()
        try:
            self.save_file(f"recording-attempt-{self._claim.attempt}.rrd", "recording", write)
        except (StaleFence, StoreUnavailable):
            raise
        except SldrError as err:
            log.warning("The Rerun file could not be written: %s", err)
        except Exception:
            # A training must not fail for a copy of what is in the store.
            log.exception("The Rerun file could not be written.")
        ended = time.monotonic()
        self._record_at = ended + max(RECORDING_INTERVAL_S, (ended - begun) / RECORDING_SHARE)
