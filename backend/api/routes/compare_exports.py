"""Comparisons to take along: figures, the numbers behind them, LaTeX tables, and the bundle of everything."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query
from fastapi.responses import Response

from backend.api.access.declarations import needs
from backend.api.compare_questions import Choice, FigureLook, Look, View
from backend.api.dependencies import Memory, Store
from backend.api.errors import problem_responses
from backend.comparison.best import compare_best
from backend.comparison.curves import CurveView, compare_curves
from backend.comparison.memory import ComparisonMemory
from backend.comparison.records import BestModels, CurveComparison
from backend.figures.bundle import make_bundle
from backend.figures.csv_tables import best_csv, curves_csv
from backend.figures.drawing import Drawing, Format, draw_apart
from backend.figures.gathering import gather_bundle
from backend.figures.latex import best_latex, curves_latex
from backend.store.compared_runs import RunChoice
from backend.store.database import Database

FigureFormat = Literal[Format, "csv", "tex"]

MEDIA_TYPES: dict[FigureFormat, str] = {
    "svg": "image/svg+xml",
    "pdf": "application/pdf",
    "png": "image/png",
    "csv": "text/csv",
    "tex": "application/x-tex",
}

router = APIRouter(prefix="/api/compare", tags=["compare"])


def _content(*media_types: str) -> dict[int | str, dict[str, Any]]:
    return {200: {"content": {media_type: {} for media_type in media_types}}}


@router.get(
    "/figure.{format}", response_class=Response, responses=_content(*MEDIA_TYPES.values()) | problem_responses(404, 422)
)
@needs("viewer")
def get_figure(
    format: FigureFormat, choice: Choice, view: View, look: FigureLook, store: Store, memory: Memory
) -> Response:
    """Draw a comparison, or send the numbers that would be drawn."""
    content = _compare(store, memory, choice, view, look)
    headers = {"content-disposition": f'attachment; filename="sldr-{look.kind}.{format}"'}
    return Response(_file(content, format, look), media_type=MEDIA_TYPES[format], headers=headers)


@router.get("/bundle.zip", response_class=Response, responses=_content("application/zip") | problem_responses(404, 422))
@needs("viewer")
def get_bundle(
    choice: Choice,
    view: View,
    look: FigureLook,
    store: Store,
    memory: Memory,
    anonymous: Annotated[bool, Query(description="Whether to leave out what tells who made it, and where.")] = False,
) -> Response:
    """Send figures, numbers, configs, versions, seeds and references in one archive."""
    bundle = gather_bundle(store, memory, choice, view, anonymous, look.width, look.log_x, look.log_y)
    headers = {"content-disposition": 'attachment; filename="sldr-comparison.zip"'}
    return Response(make_bundle(bundle), media_type="application/zip", headers=headers)


def _compare(
    store: Database, memory: ComparisonMemory, choice: RunChoice, view: CurveView, look: Look
) -> CurveComparison | BestModels:
    if look.kind == "best":
        return compare_best(store, memory, choice, view)
    return compare_curves(store, memory, choice, view)


def _file(content: CurveComparison | BestModels, format: FigureFormat, look: Look) -> bytes | str:
    is_curves = isinstance(content, CurveComparison)
    if format == "csv":
        return curves_csv(content) if is_curves else best_csv(content)
    if format == "tex":
        return curves_latex(content) if is_curves else best_latex(content)
    [drawn] = draw_apart([Drawing(content, format, look.width, look.log_x, look.log_y)])
    return drawn
