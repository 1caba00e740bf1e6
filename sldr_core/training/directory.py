"""The library's own recorder: a directory with `metrics.jsonl` and the files of a run."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path

from sldr_core.records import Step
from sldr_core.training.recorder import StopReason

METRICS_FILE = "metrics.jsonl"


class DirectoryRecorder:
    """Keep everything below one directory. After a resume, lines of cycles that are run again are replaced."""

    def __init__(self, directory: Path) -> None:
        directory.mkdir(parents=True, exist_ok=True)
        self._directory = directory
        self._stop: StopReason | None = None
        self._logged = False

    @property
    def directory(self) -> Path:
        """The run's directory."""
        return self._directory

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        """Append one line with the step and the metrics."""
        path = self._directory / METRICS_FILE
        if not self._logged:
            _drop_from(path, step.cycle)
            self._logged = True
        with path.open("a") as file:
            file.write(json.dumps({**asdict(step), "metrics": dict(metrics)}) + "\n")

    def save_file(self, name: str, kind: str, write: Callable[[Path], None]) -> Path:
        """Write to a temporary name, sync, rename."""
        return write_atomically(self._directory / name, write)

    def stop_requested(self) -> StopReason | None:
        """Return what `request_stop` was given."""
        return self._stop

    def request_stop(self, reason: StopReason) -> None:
        """Ask the training to end."""
        self._stop = reason


def write_atomically(path: Path, write: Callable[[Path], None]) -> Path:
    """Let `write` fill a temporary file beside `path`, sync it, and rename it to `path`.

    A reader sees the old file or the new one, whenever this process or the machine dies.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        write(temporary)
        with temporary.open("rb") as file:
            os.fsync(file.fileno())
        temporary.rename(path)
    finally:
        temporary.unlink(missing_ok=True)
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)
    return path


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
