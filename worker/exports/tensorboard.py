"""Runs as TensorBoard's event files, one directory a run; the step is the number of environment steps."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from sldr_core.errors import InvalidConfig
from worker.exports.exported_run import ExportedRun
from worker.exports.extras import load_extra

EXTRA = "tensorboard"


def export_to_tensorboard(run: ExportedRun, target: Path, overwrite: bool) -> Path:
    """Write a run below `target` and return its directory.

    Raises:
        ExtraMissing: TensorBoard is not installed.
        InvalidConfig: the run was exported to there before.
    """
    writers = load_extra("tensorboard.summary.writer.event_file_writer", EXTRA)
    events = load_extra("tensorboard.compat.proto.event_pb2", EXTRA)
    summaries = load_extra("tensorboard.compat.proto.summary_pb2", EXTRA)
    directory = _make_directory(run, target, overwrite)
    writer = writers.EventFileWriter(str(directory))
    for step, at, values in run.points():
        numbers = [summaries.Summary.Value(tag=name, simple_value=value) for name, value in values.items()]
        summary = summaries.Summary(value=numbers)
        writer.add_event(events.Event(step=step.env_steps, wall_time=at, summary=summary))
    writer.close()
    (directory / "config.json").write_text(json.dumps(run.row.config, indent=2) + "\n", encoding="utf-8")
    return directory


def _make_directory(run: ExportedRun, target: Path, overwrite: bool) -> Path:
    row = run.row
    directory = target / row.task / row.phase / row.method / f"seed-{row.seed}-{row.id}"
    if directory.exists():
        if not overwrite:
            raise InvalidConfig({"out": f"{directory} holds an earlier export; choose another, or add --overwrite"})
        shutil.rmtree(directory)
    directory.mkdir(parents=True)
    return directory
