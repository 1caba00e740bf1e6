"""From a comparison to the bytes of a figure. Loads Matplotlib: import it only where that is meant."""

from __future__ import annotations

import io
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg

from backend.comparison.records import CurveComparison
from backend.figures.bar_figure import draw_bars
from backend.figures.curve_figure import draw_curves
from backend.figures.drawing import Drawing
from backend.figures.styles import SIZES, settings

DOTS_PER_INCH = 300
"""Of PNG files."""

METADATA: dict[str, dict[str, Any]] = {
    "svg": {"Date": None, "Creator": "SLDR dashboard"},
    "pdf": {"CreationDate": None, "Creator": "SLDR dashboard", "Producer": None},
    "png": {"Software": None},
}
"""What files say of their making: nothing that differs by day or machine."""


def render(drawing: Drawing) -> bytes:
    """Return a figure as the file that was asked for; the same drawing gives the same bytes."""
    size = SIZES[drawing.width]
    with mpl.rc_context(settings(size)):
        if isinstance(drawing.content, CurveComparison):
            figure = draw_curves(drawing.content, size, drawing.log_x, drawing.log_y)
        else:
            figure = draw_bars(drawing.content, size)
        FigureCanvasAgg(figure)
        file = io.BytesIO()
        figure.savefig(file, format=drawing.format, dpi=DOTS_PER_INCH, metadata=METADATA[drawing.format])
    return file.getvalue()
