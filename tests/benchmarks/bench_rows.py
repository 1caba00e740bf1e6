"""What a benchmark measures: rows with a target, each the median of paired repetitions."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

REPETITIONS = 5
"""Paired repetitions of a row, at least."""

Direction = Literal["at least", "at most"]


@dataclass(frozen=True)
class Target:
    """Say what is good enough."""

    direction: Direction
    value: float

    def is_met(self, measured: float) -> bool:
        """Tell whether a measured value is good enough."""
        return measured >= self.value if self.direction == "at least" else measured <= self.value


@dataclass(frozen=True)
class Measured:
    """Hold what one row gave."""

    what: str
    unit: str
    """Of `value`: x for a ratio, else %, s, ms, MB, kB."""
    value: float
    """Median over the repetitions."""
    low: float
    high: float
    """Least and greatest of the repetitions."""
    target: Target | None
    """None where a row tells how something grows, which nobody can call good or bad."""
    detail: str
    """The figures behind it, in words."""
    curve: Mapping[str, Sequence[float]] | None = None
    """How a peer came there, by what each column holds; only in the file of numbers."""

    @property
    def is_met(self) -> bool:
        """Whether the target is reached, if there is one."""
        return self.target is None or self.target.is_met(self.value)

    def as_json(self) -> dict[str, Any]:
        """Return everything as plain values."""
        return {**asdict(self), "met": self.is_met}


def as_measured(kept: Mapping[str, Any]) -> Measured:
    """Return a row of the plain values that it was kept as."""
    values = {name: value for name, value in kept.items() if name != "met"}
    target = kept["target"]
    return Measured(**{**values, "target": target and Target(**target)})


def row(
    what: str,
    unit: str,
    values: Sequence[float],
    target: Target | None,
    detail: str,
    curve: Mapping[str, Sequence[float]] | None = None,
) -> Measured:
    """Return a row of the values of its repetitions."""
    return Measured(what, unit, statistics.median(values), min(values), max(values), target, detail, curve)


@dataclass(frozen=True)
class Pairs:
    """Hold the seconds of two things that were measured in turns."""

    ours: list[float]
    theirs: list[float]

    @property
    def speedups(self) -> list[float]:
        """How many times as long the other one took, pair by pair."""
        return [theirs / ours for ours, theirs in zip(self.ours, self.theirs, strict=True)]

    @property
    def costs(self) -> list[float]:
        """How many times as long ours took, pair by pair."""
        return [ours / theirs for ours, theirs in zip(self.ours, self.theirs, strict=True)]


def time_pairs(ours: Callable[[], object], theirs: Callable[[], object], repetitions: int = REPETITIONS) -> Pairs:
    """Time two things in turns, after once each uncounted, so that a machine whose speed drifts favours neither."""
    ours()
    theirs()
    pairs = Pairs([], [])
    for _ in range(repetitions):
        pairs.ours.append(seconds_of(ours))
        pairs.theirs.append(seconds_of(theirs))
    return pairs


def seconds_of(action: Callable[[], object]) -> float:
    """Return how long something takes [s]."""
    begun = time.perf_counter()
    action()
    return time.perf_counter() - begun


def seconds_until(rate: float, seconds: Sequence[float], rates: Sequence[float]) -> float:
    """Return when tests first reached a rate, of when each ended [s] and what it gave; infinity if none did."""
    return next((when for when, reached in zip(seconds, rates, strict=True) if reached >= rate), float("inf"))


@dataclass
class Stopwatch:
    """Add up the time spent in functions that it wraps [s]."""

    total_s: float = 0.0

    def around(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Return the function, timed."""

        def timed(*args: Any, **kwargs: Any) -> Any:
            begun = time.perf_counter()
            try:
                return function(*args, **kwargs)
            finally:
                self.total_s += time.perf_counter() - begun

        return timed
