"""The library's own recorder: a directory with `metrics.jsonl` and the files of a run."""

from __future__ import annotations

import fcntl
import json
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from functools import partial
from pathlib import Path

from sldr_core.disk import explain_full_disk, remove_leftovers, sync, write_atomically
from sldr_core.episodes import KIND as EPISODES_KIND
from sldr_core.episodes import RecordedTest, episodes_file, remove_episodes, write_episodes
from sldr_core.errors import DirectoryInUse
from sldr_core.records import Step
from sldr_core.training.files import CHECKPOINT_FILE, METRICS_FILE, PREVIOUS_CHECKPOINT_FILE, is_product
from sldr_core.training.recorder import StopReason

LOCK_FILE = ".training.lock"


class DirectoryRecorder:
    """Keep everything below one directory.

    After a resume, lines of cycles that are run again are replaced. A training that goes on from nothing begins with
    removing what an earlier one has left there, or the two would be taken for one. One recorder serves one call of
    `train`: what was asked of it stays asked.
    """

    def __init__(self, directory: Path) -> None:
        directory.mkdir(parents=True, exist_ok=True)
        self._directory = directory
        self._stop: StopReason | None = None
        self._begun = False
        self._last_cycle: int | None = None

    @property
    def directory(self) -> Path:
        """The run's directory."""
        return self._directory

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Append one line with the step and the metrics.

        Raises:
            DiskTooFull: there is no room for it.
        """
        self._begin()
        path = self._directory / METRICS_FILE
        if self._last_cycle is None or step.cycle <= self._last_cycle:
            _drop_from(path, step.cycle)
        self._last_cycle = step.cycle
        with explain_full_disk(path), path.open("a") as file:
            file.write(json.dumps({**asdict(step), "metrics": dict(metrics)}) + "\n")

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        """Write to a temporary name, sync, rename.

        Raises:
            DiskTooFull: there is no room for it.
        """
        self._begin()
        # A checkpoint must never be on the disk before the lines that it says are logged.
        sync(self._directory / METRICS_FILE)
        return write_atomically(self._directory / name, write)

    def record_episodes(self, test: RecordedTest, kept_epochs: Collection[int]) -> None:
        """Write the test's file, then remove those of earlier tests that are not to be kept.

        Raises:
            DiskTooFull: there is no room for it.
        """
        newest = test.origin.epoch
        self.save_file(episodes_file(newest), EPISODES_KIND, partial(write_episodes, test=test))
        remove_episodes(self._directory, newest, kept_epochs)

    def stop_requested(self) -> StopReason | None:
        """Return what `request_stop` was given."""
        return self._stop

    def request_stop(self, reason: StopReason) -> None:
        """Ask the training to end."""
        self._stop = reason

    def _begin(self) -> None:
        """Before the first line or file: remove what a training has left that nothing goes on from."""
        if self._begun:
            return
        self._begun = True
        checkpoints = (CHECKPOINT_FILE, PREVIOUS_CHECKPOINT_FILE)
        if not any((self._directory / name).exists() for name in checkpoints):
            for path in self._directory.iterdir():
                if is_product(path.name):
                    path.unlink()


@contextmanager
def alone_in(directory: Path) -> Iterator[None]:
    """Keep every other process from training in a directory, and remove what killed ones left half written there.

    A process that is killed lets go of it.

    Raises:
        DirectoryInUse: another process trains there.
    """
    with (directory / LOCK_FILE).open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as err:
            raise DirectoryInUse(f"Another process trains in {directory}; wait for it, or use another one.") from err
        remove_leftovers(directory)
        yield


def _drop_from(path: Path, cycle: int) -> None:
    """Remove the lines of `cycle` and later, and a last line cut short."""
    if not path.exists():
        return
    kept = [line for line in path.read_text().splitlines(keepends=True) if _cycle_of(line) < cycle]

    def write(temporary: Path) -> None:
        temporary.write_text("".join(kept))

    write_atomically(path, write)


def _cycle_of(line: str) -> float:
    try:
        return json.loads(line)["cycle"]
    except json.JSONDecodeError:
        return float("inf")
