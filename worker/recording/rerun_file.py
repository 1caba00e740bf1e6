"""Write a run to a file that Rerun opens, laid out.

The whole file is written anew each time, beside the old one, and put in its place: a reader never sees half a file.
2,000 points of six curves take less than 0.1 s, so it can be called again and again while a training runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
import rerun as rr
import rerun_bindings as bindings
from numpy.typing import NDArray

from sldr_core.disk import write_atomically
from sldr_core.records import Step
from worker.recording.blueprint import LOG, make_blueprint
from worker.recording.content import Recording
from worker.recording.rerun_episodes import send_episode

APPLICATION = "sldr"
"""Rerun keeps a person's layout per application."""


def write_recording(path: Path, recording: Recording) -> None:
    """Write a run and the layout of its views to a Rerun file, which appears whole or not at all.

    Raises:
        DiskTooFull: there is no room for it.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, partial(_write, recording))


def _write(recording: Recording, path: Path) -> None:
    # Rerun 0.33 waits for ever, and nothing can end it, where it is to write to a disk that is full.
    path.write_bytes(_encode(recording))


def _encode(recording: Recording) -> bytes:
    try:
        return _collect(recording)
    finally:
        # Rerun 0.33 ends a stream's threads only here, once nobody holds the stream; a training writes many files.
        bindings.flush_and_cleanup_orphaned_recordings()


def _collect(recording: Recording) -> bytes:
    stream, layout = rr.RecordingStream(APPLICATION), _lay_out(recording)
    try:
        content = stream.memory_recording().storage
        storage = layout.memory_recording().storage
        bindings.send_blueprint(storage, make_active=False, make_default=True, recording=stream.to_native())
        stream.send_recording_name(recording.title)
        for name, column in recording.curves.items():
            _send_curve(stream, name, recording.steps, column)
        for scene in recording.episodes:
            send_episode(stream, scene)
        _send_log(stream, recording)
        return content.drain_as_bytes()
    finally:
        layout.disconnect()
        stream.disconnect()


def _lay_out(recording: Recording) -> rr.RecordingStream:
    """Return the layout as a stream, as `RecordingStream.save` makes it; that one cannot be disconnected."""
    native = bindings.new_blueprint(APPLICATION, make_default=False, make_thread_default=False, default_enabled=True)
    layout = rr.RecordingStream._from_native(native)
    layout.set_time("blueprint", sequence=0)
    make_blueprint(recording)._log_to_stream(layout)
    return layout


def _send_curve(stream: rr.RecordingStream, name: str, steps: Sequence[Step], column: Sequence[float | None]) -> None:
    scalars = np.array([np.nan if value is None else value for value in column], dtype=np.float64)
    there = np.flatnonzero(np.isfinite(scalars))
    if not there.size:
        return
    stream.log(name, rr.SeriesLines(names=name), static=True)
    stream.send_columns(
        name,
        indexes=[
            rr.TimeColumn("env_steps", sequence=_column(steps, "env_steps", there)),
            rr.TimeColumn("epoch", sequence=_column(steps, "epoch", there)),
            rr.TimeColumn("wall_seconds", duration=_column(steps, "wall_seconds", there)),
        ],
        columns=rr.Scalars.columns(scalars=scalars[there]),
    )


def _send_log(stream: rr.RecordingStream, recording: Recording) -> None:
    if recording.log:
        stream.send_columns(
            LOG,
            indexes=[rr.TimeColumn("env_steps", sequence=np.array([line.env_steps for line in recording.log]))],
            columns=rr.TextLog.columns(text=[line.text for line in recording.log]),
        )


def _column(steps: Sequence[Step], field: str, there: NDArray[np.intp]) -> NDArray:
    return np.array([getattr(steps[index], field) for index in there])
