"""The figure of learning curves: small multiples, one panel a task, as the paper lays them out."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from backend.comparison.records import CurveComparison, Group, GroupCurve, Panel
from backend.comparison.words import CENTRES, HELD
from backend.figures.layout import add_legend, panel_grid
from backend.figures.styles import Size, color_of, dash_of
from backend.statistics.bands import SEEDS_FOR_BAND

BAND_ALPHA = 0.18
SEED_ALPHA = 0.45
PANEL_SHAPE = 0.78
"""Height of a panel by its width."""


def draw_curves(comparison: CurveComparison, size: Size, log_x: bool = False, log_y: bool = False) -> Figure:
    """Draw one panel a task."""
    groups = {group.key: group for group in comparison.groups}
    figure, panels = panel_grid(len(comparison.panels), size, PANEL_SHAPE)
    for place, (axes, panel) in enumerate(zip(panels, comparison.panels, strict=True)):
        _draw_panel(axes, panel, groups, size)
        _scale(axes, comparison, log_x, log_y)
        if place % size.columns == 0:
            axes.set_ylabel(comparison.words.metric)
        if place + size.columns >= len(comparison.panels):
            axes.set_xlabel(comparison.words.x)
    shown = {curve.group for panel in comparison.panels for curve in panel.curves if curve.n}
    entries = [(_key_line(group, size), group.label) for group in comparison.groups if group.key in shown]
    add_legend(figure, entries, caption(comparison), size)
    return figure


def caption(comparison: CurveComparison) -> str:
    """Return statistic, number of seeds and level in words."""
    curves = [curve for panel in comparison.panels for curve in panel.curves if curve.n]
    if not curves:
        return "Nothing logged yet"
    fewest, most = min(curve.n for curve in curves), max(curve.n for curve in curves)
    seeds = f"{most}" if fewest == most else f"{fewest} to {most}"
    statistic = comparison.words.statistic
    if not any(curve.has_band for curve in curves):
        statistic = CENTRES["seeds"]
    elif not all(curve.has_band for curve in curves):
        statistic += f", {CENTRES['seeds']} where there are fewer than {SEEDS_FOR_BAND}"
    held = f", {HELD}" if any(curve.holds and curve.has_band for curve in curves) else ""
    return f"{statistic[:1].upper()}{statistic[1:]}; seeds: {seeds}{held}"


def _draw_panel(axes: Axes, panel: Panel, groups: dict[str, Group], size: Size) -> None:
    axes.set_title(panel.task)
    for curve in panel.curves:
        group = groups[curve.group]
        color, dash = color_of(group.color), dash_of(group.dash, size.line)
        for member in curve.members:
            if member.x is not None and member.y is not None:
                alpha = SEED_ALPHA if curve.has_band else 0.85
                width = 0.5 * size.line if curve.has_band else 0.8 * size.line
                axes.plot(member.x, member.y, color=color, linestyle=dash, linewidth=width, alpha=alpha)
        if curve.has_band:
            _draw_aggregate(axes, curve, color, dash, size)


def _draw_aggregate(axes: Axes, curve: GroupCurve, color: str, dash: Any, size: Size) -> None:
    low, high = (np.array(end, dtype=np.float64) for end in (curve.low, curve.high))
    axes.fill_between(curve.x, low, high, color=color, alpha=BAND_ALPHA, linewidth=0)
    axes.plot(curve.x, np.array(curve.centre, dtype=np.float64), color=color, linestyle=dash, linewidth=size.line)
    for loss in curve.losses:
        if loss.y is not None:
            axes.plot([loss.x], [loss.y], marker="X", markersize=3.5 * size.line, color=color, markeredgecolor="white")


def _scale(axes: Axes, comparison: CurveComparison, log_x: bool, log_y: bool) -> None:
    if log_x:
        axes.set_xscale("log")
    if log_y:
        axes.set_yscale("log")
    elif comparison.metric.endswith("success_rate"):
        axes.set_ylim(-0.03, 1.03)


def _key_line(group: Group, size: Size) -> Line2D:
    return Line2D(
        [], [], color=color_of(group.color), linestyle=dash_of(group.dash, size.line), linewidth=1.3 * size.line
    )
