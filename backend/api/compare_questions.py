"""What every question to a comparison says in its address: which runs, and how they are looked at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from fastapi import Depends, Query

from backend.comparison.curves import SUCCESS_RATE, CurveView
from backend.comparison.records import Axis, Statistic
from backend.figures.styles import Width
from backend.store.compared_runs import RunChoice
from sldr_core.config import Phase

NAMES_AT_MOST = 200
"""Tasks, methods or runs named in one question."""

LONGEST_NAME = 200
"""As the store's columns."""


@dataclass(frozen=True)
class Look:
    """Say what a figure shows and how large."""

    kind: Literal["curves", "best"]
    width: Width
    log_x: bool
    log_y: bool


Names = Annotated[list[str], Query(max_length=NAMES_AT_MOST)]


def read_choice(
    phase: Annotated[Phase, Query(description="Which training is compared.")] = "manipulation",
    task: Annotated[Names, Query(description="Repeat for several; none: all.")] = [],  # noqa: B006 - only read
    method: Annotated[Names, Query(description="Repeat for several; none: all.")] = [],  # noqa: B006
    preset: Annotated[Names, Query(description="Repeat for several; none: all.")] = [],  # noqa: B006
    run: Annotated[Names, Query(description="Ids of runs, to compare these only.")] = [],  # noqa: B006
    study: Annotated[str | None, Query(max_length=LONGEST_NAME, description="Id of a study: its runs only.")] = None,
) -> RunChoice:
    """Return which runs are compared."""
    return RunChoice(phase=phase, tasks=task, methods=method, presets=preset, run_ids=run, study_id=study)


def read_view(
    metric: Annotated[str, Query(max_length=LONGEST_NAME)] = SUCCESS_RATE,
    x: Annotated[Axis, Query(description="What curves are drawn over.")] = "epoch",
    statistic: Annotated[Statistic, Query(description="`seeds` shows each by itself.")] = "median",
    level: Annotated[float, Query(ge=0.5, le=0.999, description="Of confidence intervals.")] = 0.95,
    seeds: Annotated[bool, Query(description="Whether to add each seed's own curve.")] = False,
    drop_ended: Annotated[
        bool, Query(description="Whether a run that is done counts no more behind its end; else its last value does.")
    ] = False,
) -> CurveView:
    """Return how they are looked at."""
    return CurveView(metric=metric, x=x, statistic=statistic, level=level, with_seeds=seeds, drop_ended=drop_ended)


def read_look(
    kind: Annotated[
        Literal["curves", "best"], Query(description="Learning curves, or bars of best models.")
    ] = "curves",
    width: Annotated[Width, Query(description="One column of a paper, both, or a slide.")] = "double",
    log_x: bool = False,
    log_y: bool = False,
) -> Look:
    """Return what a figure looks like."""
    return Look(kind=kind, width=width, log_x=log_x, log_y=log_y)


Choice = Annotated[RunChoice, Depends(read_choice)]
View = Annotated[CurveView, Depends(read_view)]
FigureLook = Annotated[Look, Depends(read_look)]
