"""What people write on runs: tags and notes."""

from __future__ import annotations

from dataclasses import asdict

from fastapi import APIRouter

from backend.api.access.declarations import needs
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.table_schemas import Notes, TagChange, TagCount, Tags
from backend.store import labels

router = APIRouter(prefix="/api", tags=["runs"])


@router.get("/tags", responses=problem_responses())
@needs("viewer", shared=True)
def list_tags(store: Store) -> Tags:
    """List every tag in use."""
    return Tags(tags=[TagCount(**asdict(count)) for count in labels.list_tags(store)])


@router.post("/runs/tags", status_code=204, responses=problem_responses(400, 403, 404, 422))
@needs("operator")
def change_run_tags(change: TagChange, store: Store) -> None:
    """Give runs tags and take others away."""
    labels.change_tags(store, change.run_ids, change.add, change.remove)


@router.put("/runs/{run_id}/notes", status_code=204, responses=problem_responses(400, 403, 404, 422))
@needs("operator")
def set_run_notes(run_id: str, written: Notes, store: Store) -> None:
    """Replace the notes of a run."""
    labels.set_notes(store, run_id, written.notes)
