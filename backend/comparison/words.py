"""Metrics, axes and statistics in words: the same on the page, in figures and in tables."""

from __future__ import annotations

from collections.abc import Mapping

from backend.comparison.records import Axis, Statistic, Words
from backend.statistics.bands import SEEDS_FOR_BAND

AXES: Mapping[Axis, str] = {
    "epoch": "Epoch",
    "env_steps": "Environment steps",
    "episodes": "Episodes",
    "updates": "Gradient updates",
    "wall_seconds": "Wall time [s]",
}

METRICS: Mapping[str, str] = {
    "test/success_rate": "Test success rate",
    "test/best_success_rate": "Best test success rate so far",
    "test/final_distance": "Distance from the goal at the end of a test episode",
    "train/success_rate": "Success rate of exploring episodes",
}
"""Titles of the metrics that most comparisons are about; others are called by their names."""

CENTRES: Mapping[Statistic, str] = {
    "median": "median",
    "mean": "mean",
    "iqm": "interquartile mean",
    "seeds": "each seed by itself",
}

HELD = "those that are done with their last value"
"""How seeds count that have ended while others of their curve go on."""


def describe(metric: str, x: Axis, statistic: Statistic, level: float) -> Words:
    """Return a view in words."""
    return Words(
        metric=METRICS.get(metric, metric), x=AXES[x], statistic=f"{CENTRES[statistic]}{_band(statistic, level)}"
    )


def legend(statistic: Statistic, level: float, n: int, fewest: int, holds: bool) -> str:
    """Return what a curve shows: statistic, number of seeds and level.

    Args:
        n: seeds of the curve.
        fewest: seeds where it has the fewest.
        holds: whether seeds that are done count on somewhere.
    """
    if n == 0:
        return "nothing logged yet"
    seeds = f"{n} seed{'' if n == 1 else 's'}"
    if statistic == "seeds":
        return f"{seeds}, each by itself"
    if n < SEEDS_FOR_BAND:
        return f"{seeds}, each by itself: too few for a band"
    counted = seeds if fewest == n else f"{fewest} to {seeds}"
    return f"{CENTRES[statistic]} of {counted}{f', {HELD}' if holds else ''}{_band(statistic, level)}"


def _band(statistic: Statistic, level: float) -> str:
    share = f"{100 * level:g} %"
    return {
        "median": ", band: quartiles (25 to 75 %)",
        "mean": f", band: {share} confidence (Student's t)",
        "iqm": f", band: {share} confidence (bootstrap over seeds)",
        "seeds": "",
    }[statistic]
