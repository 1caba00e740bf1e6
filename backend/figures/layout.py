"""Panels in rows and columns, with one legend below them."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from backend.figures.styles import Size

POINTS_PER_INCH = 72
CHARACTER = 0.58
"""Mean width of a character by the size of its font."""
SPARE = 9
"""Room that a legend's entry needs beside its text [characters]."""
NO_BREAK = "\N{NO-BREAK SPACE}"


def panel_grid(count: int, size: Size, shape: float) -> tuple[Figure, list[Axes]]:
    """Return a figure with `count` panels, in rows of at most `size.columns`.

    Args:
        count: panels; without any, the figure is empty.
        size: how large it is drawn.
        shape: height of a panel by its width, in a full row.
    """
    columns = max(1, min(count, size.columns))
    rows = max(1, -(-count // columns))
    height = rows * shape * size.width / max(columns, 2)
    figure = Figure(figsize=(size.width, height), layout="constrained")
    return figure, [figure.add_subplot(rows, columns, place + 1) for place in range(count)]


def add_legend(figure: Figure, entries: Sequence[tuple[Artist, str]], caption: str, size: Size) -> None:
    """Put a legend below all panels, headed by a caption; the figure grows by what they need."""
    letters = int(size.width * POINTS_PER_INCH / (CHARACTER * size.font))
    widest = max((len(label) for _, label in entries), default=1) + SPARE
    columns = max(1, min(len(entries), letters // widest))
    words = fill(caption.replace(" %", NO_BREAK + "%"), letters)
    lines = -(-len(entries) // columns) + words.count("\n") + 1
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + 1.5 * lines * size.font / POINTS_PER_INCH)
    legend = figure.legend(
        [handle for handle, _ in entries],
        [label for _, label in entries],
        title=words,
        title_fontsize=size.font,
        loc="outside lower center",
        ncols=columns,
        frameon=False,
        handlelength=3.2,
    )
    legend.get_title().set_color("#444a54")


def chunks(tasks: Sequence[str], most: int) -> list[Sequence[str]]:
    """Return tasks in rows of `most`; the last may be shorter."""
    return [tasks[start : start + most] for start in range(0, len(tasks), most)]
