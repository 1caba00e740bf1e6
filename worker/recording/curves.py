"""The curves of a run as the store has them."""

from __future__ import annotations

from backend.store.database import Database
from backend.store.metrics import read_metrics
from sldr_core.records import Step
from worker.recording.content import Curves


def read_curves(db: Database, run_id: str) -> tuple[list[Step], Curves]:
    """Return every point of a run that no later attempt has superseded."""
    steps: list[Step] = []
    curves: dict[str, list[float | None]] = {}
    cursor = 0
    while (page := read_metrics(db, run_id, cursor)).step:
        cursor = page.cursor
        for name in page.values:
            curves.setdefault(name, [None] * len(steps))
        counts = zip(page.step, page.epoch, page.env_steps, page.episodes, page.updates, page.wall_seconds, strict=True)
        steps.extend(Step(*numbers) for numbers in counts)
        for name, column in curves.items():
            column.extend(page.values.get(name, [None] * len(page.step)))
    return steps, curves
