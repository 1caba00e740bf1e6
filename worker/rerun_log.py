"""Write a training's curves to a file that Rerun opens, laid out.

The whole file is written anew each time, beside the old one, and put in its place: a reader never sees half a file.
2,000 points of six curves take less than 0.1 s, so it can be called again and again while a training runs.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from sldr_core.records import Step

APPLICATION = "sldr"
"""Rerun keeps a person's layout per application."""

TIMELINE = "env_steps"
"""The timeline that the charts open with."""

Columns = Mapping[str, Sequence[float | None]]
"""Values per metric `group/name`, as long as the steps; None or NaN where a metric was not logged."""


def write_curves(path: Path, title: str, steps: Sequence[Step], values: Columns) -> None:
    """Write curves and their layout to a Rerun file, which appears whole or not at all.

    Args:
        path: the `.rrd` file.
        title: what is trained; the charts' heading.
        steps: how far the training was at each point.
        values: one curve per metric; its group is what stands before the last `/`.
    """
    temporary = Path(_reserve(path))
    try:
        stream = rr.RecordingStream(APPLICATION)
        stream.save(temporary, default_blueprint=_blueprint(title, steps, values))
        stream.send_recording_name(title)
        for name, column in values.items():
            _send_curve(stream, name, steps, column)
        stream.flush()
        stream.disconnect()
        _sync(temporary)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


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


def _column(steps: Sequence[Step], field: str, there: NDArray[np.intp]) -> NDArray:
    return np.array([getattr(steps[index], field) for index in there])


def _blueprint(title: str, steps: Sequence[Step], values: Columns) -> rrb.Blueprint:
    """Lay out one chart per group, showing the whole training, at rest: else only the beginning would show."""
    first, last = (steps[0].env_steps, steps[-1].env_steps) if steps else (0, 0)
    view_range = rr.TimeRange(
        start=rr.TimeRangeBoundary.absolute(seq=first), end=rr.TimeRangeBoundary.absolute(seq=max(last, first + 1))
    )
    groups: dict[str, list[str]] = {}
    for name in sorted(values):
        groups.setdefault(name.rpartition("/")[0] or name, []).append(name)
    charts = [
        rrb.TimeSeriesView(
            origin="/",
            contents=[f"+ /{name}" for name in names],
            name=group,
            axis_x=rrb.archetypes.TimeAxis(view_range=view_range),
        )
        for group, names in sorted(groups.items(), key=lambda item: (item[0] != "test", item[0]))
    ]
    return rrb.Blueprint(
        rrb.Grid(*charts, name=title),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE, play_state="paused"),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
    )


def _reserve(path: Path) -> str:
    """Return a new temporary file beside `path`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}-")
    os.close(handle)
    with contextlib.suppress(PermissionError):
        os.chmod(name, 0o644)
    return name


def _sync(path: Path) -> None:
    with path.open("rb") as file:
        os.fsync(file.fileno())
