"""Comparing for a bundle: curves, best models and configs of the same runs, under names that may leave it."""

from __future__ import annotations

from dataclasses import replace

from backend.comparison.best import compare_best
from backend.comparison.curves import CurveView, compare_curves
from backend.comparison.memory import ComparisonMemory
from backend.figures.bundle import Bundle
from backend.figures.styles import Width
from backend.store.compared_runs import RunChoice, read_configs
from backend.store.database import Database


def gather_bundle(
    db: Database,
    memory: ComparisonMemory,
    choice: RunChoice,
    view: CurveView,
    anonymous: bool,
    width: Width,
    log_x: bool = False,
    log_y: bool = False,
) -> Bundle:
    """Return what a bundle is made of.

    Args:
        db: where the runs are.
        memory: what was compared already.
        choice: which runs.
        view: how they are compared.
        anonymous: whether to leave out whatever may tell who made it and where.
        width: of the figures.
        log_x: whether curves are drawn over a logarithmic axis.
        log_y: whether they rise on one.
    """
    view = replace(view, anonymous=anonymous)
    curves = compare_curves(db, memory, choice, view)
    best = compare_best(db, memory, choice, view)
    ids = [member.run_id for panel in curves.panels for curve in panel.curves for member in curve.members]
    return Bundle(curves, best, read_configs(db, ids), anonymous, width, log_x, log_y)
