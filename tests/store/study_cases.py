"""Studies in the situations that tests begin with."""

from __future__ import annotations

from typing import Any

from backend.store.database import Database
from backend.store.metrics import append_metrics
from backend.store.outcomes import Outcome
from backend.store.progress import Progress
from backend.store.queue import claim, finish
from backend.store.studies.matrix import MatrixCell, StudyMatrix, get_study
from backend.store.studies.spec import Cell, StudySpec


def small_spec(**changes: Any) -> StudySpec:
    """Ask for two methods with two seeds on FetchPush, small."""
    values: dict[str, Any] = {"tasks": ("FetchPush",), "methods": ("her", "her-sldr"), "seeds": (0, 1), **changes}
    return StudySpec(preset=values.pop("preset", "smoke"), **values)


def cell_of(db: Database, study_id: str, method: str, task: str = "FetchPush", variant: str = "") -> MatrixCell:
    """Return one cell of a study."""
    return cell_in(get_study(db, study_id), method, task, variant)


def cell_in(matrix: StudyMatrix, method: str, task: str = "FetchPush", variant: str = "") -> MatrixCell:
    """Return one cell of a matrix."""
    return next(cell for cell in matrix.cells if cell.cell == Cell(task, method, variant))


def train_next(db: Database, outcome: Outcome, best: float | None = None, fraction: float = 1.0) -> str:
    """Let a worker take the next run, report how far it came, and end it; return its id."""
    taken = claim(db, "worker-1")
    assert taken is not None
    append_metrics(db, taken, [], progress(fraction, best))
    finish(db, taken, outcome)
    return taken.run_id


def progress(fraction: float, best: float | None = None) -> Progress:
    """Report how far a run is and how well it did."""
    return Progress(
        epoch=1,
        epochs=2,
        env_steps=1000,
        episodes=20,
        updates=8,
        fraction=fraction,
        success_rate=best,
        best_success_rate=best,
        env_steps_per_s=500.0,
        updates_per_s=10.0,
        seconds_left=None,
    )
