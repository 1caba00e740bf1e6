"""The store's studies as the API's records, and the other way round."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from backend.api import study_schemas as records
from backend.store.studies.estimate import Estimate
from backend.store.studies.launch import Launched
from backend.store.studies.matrix import MatrixCell, StudyMatrix, StudyRow, StudyRun
from backend.store.studies.plan import StudyPlan
from backend.store.studies.spec import Addition, StudySpec, Variant, spec_to_dict


def store_spec(spec: records.StudySpec) -> StudySpec:
    """Return a spec as the store has it."""
    return StudySpec(
        tasks=tuple(spec.tasks),
        methods=tuple(spec.methods),
        seeds=tuple(spec.seeds),
        preset=spec.preset,
        overrides=spec.overrides,
        variants=_store_variants(spec.variants),
        locomotion=spec.locomotion,
    )


def store_addition(addition: records.StudyAddition) -> Addition:
    """Return what a study shall have besides as the store has it."""
    return Addition(
        tasks=tuple(addition.tasks),
        methods=tuple(addition.methods),
        seeds=tuple(addition.seeds),
        variants=_store_variants(addition.variants),
    )


def api_spec(spec: StudySpec) -> records.StudySpec:
    """Return a spec as the API tells it."""
    return records.StudySpec.model_validate(spec_to_dict(spec), strict=False)


def study_summary(row: StudyRow) -> records.StudySummary:
    """Return a study as a row of the list."""
    return records.StudySummary(**_summary_fields(row))


def study_detail(matrix: StudyMatrix) -> records.StudyDetail:
    """Return a study with all its cells."""
    return records.StudyDetail(
        **_summary_fields(matrix.study),
        cells=[_cell(cell) for cell in matrix.cells],
        locomotion=[_run(run) for run in matrix.locomotion],
    )


def study_outcome(launched: Launched) -> records.StudyOutcome:
    """Return what launching has done."""
    return records.StudyOutcome(**asdict(launched))


def study_preview(plan: StudyPlan, estimate: Estimate, disk_free: int) -> records.StudyPreview:
    """Return what launching would do and cost."""
    return records.StudyPreview(
        places=[
            records.PlannedPlace(
                **asdict(planned.place.cell),
                seed=planned.place.seed,
                standing=planned.standing,
                run_id=planned.run_id,
            )
            for planned in plan.places
        ],
        locomotion=[
            records.PlannedLocomotion(task=run.task, run_id=run.reused_run_id, zoo_success=run.zoo_success)
            for run in plan.locomotion
        ],
        queued=len(plan.new_runs),
        estimate=records.StudyEstimate(**asdict(estimate), disk_free_bytes=disk_free),
    )


def _summary_fields(row: StudyRow) -> dict[str, Any]:
    return {
        "id": row.id,
        "name": row.name,
        "note": row.note,
        "spec": api_spec(row.spec),
        "created_at": row.created_at,
        "deleted_at": row.deleted_at,
        "size": row.spec.size,
        "states": dict(row.states),
        "progress": row.progress,
    }


def _cell(cell: MatrixCell) -> records.StudyCell:
    return records.StudyCell(
        **asdict(cell.cell),
        runs=[_run(run) for run in cell.runs],
        states=dict(cell.states),
        progress=cell.progress,
        tested=cell.tested,
        best_success_rate=cell.best_success_rate,
        missing_seeds=list(cell.missing_seeds),
    )


def _run(run: StudyRun) -> records.StudyRun:
    return records.StudyRun(**asdict(run))


def _store_variants(variants: Sequence[records.StudyVariant]) -> tuple[Variant, ...]:
    return tuple(Variant(variant.name, variant.overrides) for variant in variants)
