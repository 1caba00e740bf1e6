"""Making room: what a rule would remove of ended runs, and removing it."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.access.declarations import needs
from backend.api.dependencies import ServiceSettings, Store
from backend.api.errors import problem_responses
from backend.api.retention_schemas import (
    RemovableSum,
    RetentionPreview,
    RetentionRemoved,
    RetentionRule,
    RetentionRun,
)
from backend.store.retention.plan import RetentionPlan, plan_retention
from backend.store.retention.removal import apply_retention
from backend.store.retention.rule import LONGEST_DAYS, Removable, Rule

SHOWN_RUNS = 200
"""Runs in one answer at most, those with the largest share first."""

router = APIRouter(prefix="/api/retention", tags=["retention"])


@router.get("", responses=problem_responses(422))
@needs("viewer")
def preview_retention(
    store: Store,
    settings: ServiceSettings,
    kind: Annotated[list[Removable], Query(min_length=1, max_length=len(Removable), description="What may go.")],
    older_than_days: Annotated[int, Query(ge=0, le=LONGEST_DAYS, description="Spare runs that ended later.")] = 30,
) -> RetentionPreview:
    """Tell what a rule would remove of ended runs; remove nothing."""
    return _preview(plan_retention(store, settings, Rule(frozenset(kind), older_than_days)))


@router.post("", responses=problem_responses(400, 403, 422))
@needs("admin")
def apply_retention_rule(rule: RetentionRule, store: Store, settings: ServiceSettings) -> RetentionRemoved:
    """Remove what a rule names, as it stands now; runs that move on meanwhile keep everything."""
    plan = plan_retention(store, settings, Rule(frozenset(rule.kinds), rule.older_than_days))
    removed = apply_retention(store, settings, plan)
    return RetentionRemoved(runs=removed.runs, files=removed.files, size=removed.size, left=removed.left)


def _preview(plan: RetentionPlan) -> RetentionPreview:
    return RetentionPreview(
        kinds=[RemovableSum(kind=kind, files=files, size=size) for kind, (files, size) in plan.totals().items()],
        runs=[
            RetentionRun(
                run_id=share.run_id,
                task=share.task,
                phase=share.phase,
                method=share.method,
                seed=share.seed,
                state=share.state,
                ended_at=share.ended_at,
                files=len(share.files),
                size=share.size,
            )
            for share in plan.runs[:SHOWN_RUNS]
        ],
        total_runs=len(plan.runs),
        size=sum(share.size for share in plan.runs),
        spared_young=plan.spared["young"],
        spared_kept=plan.spared["kept"],
        spared_needed=plan.spared["needed"],
    )
