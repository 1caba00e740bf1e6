"""Colours, dashes and sizes of figures: the page's palette on white, at the widths that papers and slides have."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

COLORS = ("#0067a8", "#c25700", "#00805c", "#a8508a", "#8a6d00", "#2b8fc9", "#555b66")
"""Those of `web/src/lib/palette.ts` on light; a test holds the two equal."""

DASHES: tuple[tuple[float, ...], ...] = ((), (7, 3), (2, 2), (9, 3, 2, 3), (12, 4), (4, 2, 1, 2), (1, 3))
"""Lengths of line and gap in CSS pixels, likewise."""

HATCHES = ("", "///", "...", "\\\\\\", "xxx", "---", "|||")
"""What bars have where lines have dashes."""

Width = Literal["single", "double", "slide"]


@dataclass(frozen=True)
class Size:
    """Say how large a figure is drawn."""

    width: float
    """Of the whole figure [in]."""
    columns: int
    """Panels side by side, at most."""
    tasks: int
    """Tasks of a bar chart side by side, at most."""
    font: float
    """Of labels [pt]."""
    line: float
    """Width of a line [pt]."""


SIZES: Mapping[Width, Size] = {
    "single": Size(width=3.5, columns=2, tasks=3, font=6.5, line=0.9),
    "double": Size(width=7.16, columns=4, tasks=7, font=7.0, line=1.0),
    "slide": Size(width=10.0, columns=4, tasks=7, font=11.0, line=1.8),
}
"""One column of a paper, both columns, and a slide."""


def color_of(index: int) -> str:
    """Return the n-th colour."""
    return COLORS[index % len(COLORS)]


def dash_of(index: int, line: float) -> Any:
    """Return the n-th dash pattern as Matplotlib's line style: multiples of a point, scaled to the line's width."""
    pattern = DASHES[index % len(DASHES)]
    return (0, tuple(0.45 * length / line for length in pattern)) if pattern else "-"


def settings(size: Size) -> dict[str, Any]:
    """Return Matplotlib's settings; fonts are embedded (PDF) or drawn as outlines (SVG)."""
    return {
        "font.family": "DejaVu Sans",  # comes with Matplotlib, so figures look the same on every machine
        "font.size": size.font,
        "axes.titlesize": size.font + 0.5,
        "axes.labelsize": size.font,
        "xtick.labelsize": size.font - 1,
        "ytick.labelsize": size.font - 1,
        "legend.fontsize": size.font,
        "axes.linewidth": 0.6,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.axisbelow": True,
        "axes.grid": True,
        "grid.color": "#d9dce1",
        "grid.linewidth": 0.5,
        "hatch.linewidth": 0.4,
        "pdf.fonttype": 42,
        "svg.fonttype": "path",
        "svg.hashsalt": "sldr",
    }
