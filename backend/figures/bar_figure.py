"""The figure of best models: one bar for each method in each task, with its interval and its seeds."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from backend.comparison.records import BestModels, BestScore, Group
from backend.figures.layout import add_legend, chunks, panel_grid
from backend.figures.styles import HATCHES, Size, color_of

CLUSTER = 0.84
"""Share of a task's room that its bars fill."""
ROW_SHAPE = 0.62
"""Height of a row by half of its width."""


def draw_bars(best: BestModels, size: Size) -> Figure:
    """Draw the best test success of every group in every task."""
    tasks = list(dict.fromkeys(score.task for score in best.scores))
    shown = [group for group in best.groups if any(score.group == group.key for score in best.scores)]
    rows = chunks(tasks, size.tasks)
    one_column = Size(size.width, 1, size.tasks, size.font, size.line)
    figure, panels = panel_grid(len(rows) if tasks else 0, one_column, ROW_SHAPE)
    for axes, row in zip(panels, rows, strict=False):
        _draw_row(axes, row, shown, best.scores, size)
        axes.set_xlim(-0.5, max(map(len, rows)) - 0.5)
    entries = [(_patch(group), group.label) for group in shown]
    add_legend(figure, entries, caption(best), size)
    return figure


def caption(best: BestModels) -> str:
    """Return statistic, number of seeds and level in words."""
    numbers = [score.n for score in best.scores]
    if not numbers:
        return "No test yet"
    fewest, most = min(numbers), max(numbers)
    seeds = f"{most}" if fewest == most else f"{fewest} to {most}"
    statistic = best.words.statistic.replace(", band:", ", interval:")
    return f"Best test of each seed (points); {statistic}; seeds: {seeds}"


def _draw_row(
    axes: Axes, tasks: Sequence[str], groups: Sequence[Group], scores: Sequence[BestScore], size: Size
) -> None:
    by_cell = {(score.task, score.group): score for score in scores}
    width = CLUSTER / max(1, len(groups))
    for place, task in enumerate(tasks):
        for number, group in enumerate(groups):
            score = by_cell.get((task, group.key))
            if score is not None:
                _draw_bar(axes, place + (number - (len(groups) - 1) / 2) * width, width, score, group, size)
    axes.set_xticks(range(len(tasks)), tasks)
    axes.set_ylim(0.0, 1.05)
    axes.set_ylabel("Best test success")
    axes.grid(visible=False, axis="x")
    axes.tick_params(axis="x", length=0)


def _draw_bar(axes: Axes, at: float, width: float, score: BestScore, group: Group, size: Size) -> None:
    if score.centre is not None:
        axes.bar([at], [score.centre], 0.9 * width, **_look(group))
    if score.centre is not None and score.low is not None and score.high is not None:
        ends = [[max(0.0, score.centre - score.low)], [max(0.0, score.high - score.centre)]]
        axes.errorbar([at], [score.centre], yerr=ends, color="#1c1f24", linewidth=0.8 * size.line, capsize=1.5)
    places = [at] * len(score.seeds)
    bests = [seed.best for seed in score.seeds]
    axes.scatter(places, bests, s=3.0 * size.line, color="#1c1f24", alpha=0.55, linewidths=0, zorder=3)


def _look(group: Group) -> dict[str, object]:
    hatch = HATCHES[group.dash % len(HATCHES)]
    return {"color": color_of(group.color), "hatch": hatch, "edgecolor": "white", "linewidth": 0.3, "zorder": 2}


def _patch(group: Group) -> Patch:
    return Patch(
        facecolor=color_of(group.color), hatch=HATCHES[group.dash % len(HATCHES)], edgecolor="white", linewidth=0.3
    )
