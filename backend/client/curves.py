"""A run's metrics as arrays."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic.dataclasses import dataclass as record

from backend.client.errors import ClientError
from backend.client.records import RECORD

AXES = ("step", "epoch", "env_steps", "episodes", "updates", "wall_seconds")
"""What a point can be drawn over; `step` counts cycles, `wall_seconds` are seconds of training [s]."""


@record(frozen=True, config=RECORD)
class MetricBatch:
    """Points of a run after a cursor, in columns."""

    cursor: int
    step: list[int]
    epoch: list[int]
    env_steps: list[int]
    episodes: list[int]
    updates: list[int]
    wall_seconds: list[float]
    values: dict[str, list[float | None]]


@dataclass(frozen=True)
class Metrics:
    """The curves of one run; `P` points, oldest first."""

    run_id: str
    axes: Mapping[str, NDArray[np.float64]]
    """Each of `AXES` `[P]`."""
    values: Mapping[str, NDArray[np.float64]]
    """Each metric `[P]`; NaN where it was not logged."""

    def __len__(self) -> int:
        return len(self.axes["step"])

    def curve(self, name: str, over: str = "epoch") -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return where a metric was logged and its values there, each `[Q]` with Q <= P.

        Raises:
            ClientError: the run has no such metric, or there is no such axis.
        """
        if name not in self.values:
            raise ClientError(f"Run {self.run_id} has no metric '{name}'; it has {', '.join(sorted(self.values))}.")
        if over not in self.axes:
            raise ClientError(f"No axis is called '{over}'; there are {', '.join(AXES)}.")
        logged = ~np.isnan(self.values[name])
        return self.axes[over][logged], self.values[name][logged]

    def frame(self) -> Any:
        """Return axes and metrics as a pandas DataFrame.

        Raises:
            ClientError: pandas is not installed.
        """
        try:
            import pandas  # type: ignore[import-not-found]  # Only some installations have it.
        except ModuleNotFoundError as err:
            raise ClientError("A frame needs pandas; install it with `pip install pandas`.") from err
        return pandas.DataFrame({**self.axes, **self.values})


def join_batches(run_id: str, batches: Sequence[MetricBatch], names: Collection[str] | None) -> Metrics:
    """Return the points of batches that follow each other.

    Args:
        names: the metrics wanted; all if None.
    """
    axes = {axis: np.concatenate([_numbers(getattr(batch, axis)) for batch in batches]) for axis in AXES}
    known = sorted({name for batch in batches for name in batch.values})
    wanted = [name for name in known if names is None or name in names]
    values = {
        name: np.concatenate([_column(batch, name) for batch in batches])  # a batch need not know every metric
        for name in wanted
    }
    return Metrics(run_id, axes, values)


def _column(batch: MetricBatch, name: str) -> NDArray[np.float64]:
    return _numbers(batch.values[name]) if name in batch.values else np.full(len(batch.step), np.nan)


def _numbers(column: Sequence[float | None]) -> NDArray[np.float64]:
    return np.array(column, dtype=np.float64)  # None becomes NaN
