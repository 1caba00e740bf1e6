"""Studies: what one would do, launching and changing it, and how its cells stand."""

from __future__ import annotations

import shutil
from dataclasses import asdict
from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.access.declarations import needs
from backend.api.dependencies import ServiceSettings, Store
from backend.api.errors import problem_responses
from backend.api.queue_schemas import ActionResult, ActionResults
from backend.api.study_answers import (
    api_spec,
    store_addition,
    store_spec,
    study_detail,
    study_outcome,
    study_preview,
    study_summary,
)
from backend.api.study_schemas import (
    Studies,
    StudyAddition,
    StudyChange,
    StudyDetail,
    StudyLaunch,
    StudyOutcome,
    StudyPreview,
    StudyPreviewRequest,
    StudyRetry,
    StudyTemplate,
    StudyTemplates,
)
from backend.store.studies import launch, matrix, retry
from backend.store.studies.estimate import estimate_study
from backend.store.studies.templates import TEMPLATES
from backend.store.zoo_runs import ZooShelf

MOST_STUDIES = 500
"""Studies in one answer at most."""

router = APIRouter(prefix="/api/studies", tags=["studies"])


@router.get("", responses=problem_responses(422))
@needs("viewer", shared=True)
def list_studies(
    store: Store,
    deleted: Annotated[bool, Query(description="The studies that a person hid, instead of all others.")] = False,
    limit: Annotated[int, Query(ge=1, le=MOST_STUDIES)] = 200,
) -> Studies:
    """List studies, the newest first."""
    return Studies(studies=[study_summary(row) for row in matrix.list_studies(store, limit, deleted)])


@router.get("/templates", responses=problem_responses())
@needs("viewer")
def list_study_templates() -> StudyTemplates:
    """List the studies that come with the product: the paper's, its families, and one of two minutes."""
    return StudyTemplates(
        templates=[
            StudyTemplate(
                name=template.name,
                title=template.title,
                summary=template.summary,
                spec=api_spec(template.spec),
            )
            for template in TEMPLATES.values()
        ]
    )


@router.post("/preview", responses=problem_responses(400, 403, 404, 409, 422))
@needs("viewer")
def preview_study(wish: StudyPreviewRequest, store: Store, settings: ServiceSettings) -> StudyPreview:
    """Tell what launching a study, or a longer spec of one, would do and cost; queue nothing."""
    plan = launch.preview_study(store, store_spec(wish.spec), wish.study_id, ZooShelf(settings))
    return study_preview(plan, estimate_study(store, plan), shutil.disk_usage(settings.home).free)


@router.post("", status_code=201, responses=problem_responses(400, 403, 409, 422))
@needs("operator")
def create_study(wish: StudyLaunch, store: Store, settings: ServiceSettings) -> StudyOutcome:
    """Make a study and queue the runs that nothing serves yet."""
    shelf = ZooShelf(settings)
    return study_outcome(launch.create_study(store, wish.name, store_spec(wish.spec), wish.note, shelf))


@router.get("/{study_id}", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_study(study_id: str, store: Store) -> StudyDetail:
    """Return a study with all its cells."""
    return study_detail(matrix.get_study(store, study_id))


@router.patch("/{study_id}", status_code=204, responses=problem_responses(400, 403, 404, 409, 422))
@needs("operator")
def change_study(study_id: str, change: StudyChange, store: Store) -> None:
    """Give a study another name or note."""
    launch.rename_study(store, study_id, change.name, change.note)


@router.post("/{study_id}/extend", responses=problem_responses(400, 403, 404, 409, 422))
@needs("operator")
def extend_study(study_id: str, addition: StudyAddition, store: Store, settings: ServiceSettings) -> StudyOutcome:
    """Add tasks, methods, seeds or variants to a study, and queue every run that it then misses."""
    return study_outcome(launch.extend_study(store, study_id, store_addition(addition), ZooShelf(settings)))


@router.post("/{study_id}/fill", responses=problem_responses(403, 404, 409, 422))
@needs("operator")
def fill_study(study_id: str, store: Store, settings: ServiceSettings) -> StudyOutcome:
    """Queue the runs that a study misses; asked again, it finds nothing to do."""
    return study_outcome(launch.fill_study(store, study_id, ZooShelf(settings)))


@router.post("/{study_id}/retry", responses=problem_responses(400, 403, 404, 409, 422))
@needs("operator")
def retry_study(study_id: str, wish: StudyRetry, store: Store) -> ActionResults:
    """Try a study's failed or cancelled runs again, and first the locomotion runs that they need."""
    results = retry.retry_study(store, study_id, wish.cancelled)
    return ActionResults(results=[ActionResult(**asdict(result)) for result in results])


@router.delete("/{study_id}", status_code=204, responses=problem_responses(403, 404, 409, 422))
@needs("operator")
def delete_study(study_id: str, store: Store) -> None:
    """Hide a study; its runs stay as they are."""
    launch.delete_study(store, study_id)


@router.post("/{study_id}/restore", status_code=204, responses=problem_responses(403, 404, 409, 422))
@needs("operator")
def restore_study(study_id: str, store: Store) -> None:
    """Bring back a deleted study."""
    launch.restore_study(store, study_id)
