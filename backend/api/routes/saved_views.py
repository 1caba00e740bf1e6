"""Saved views of the runs table, for everyone."""

from __future__ import annotations

from dataclasses import asdict

from fastapi import APIRouter

from backend.api.access.declarations import needs
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.table_schemas import NewView, SavedView, SavedViews, ViewChange
from backend.store import saved_views

router = APIRouter(prefix="/api/views", tags=["views"])


@router.get("", responses=problem_responses())
@needs("viewer", shared=True)
def list_views(store: Store) -> SavedViews:
    """List every saved view, by name."""
    return SavedViews(views=[SavedView(**asdict(view)) for view in saved_views.list_views(store)])


@router.post("", status_code=201, responses=problem_responses(400, 403, 409, 422))
@needs("operator")
def save_view(view: NewView, store: Store) -> SavedView:
    """Keep a view under a name that no other has."""
    return SavedView(**asdict(saved_views.save_view(store, view.name, view.search)))


@router.patch("/{view_id}", responses=problem_responses(400, 403, 404, 409, 422))
@needs("operator")
def change_view(view_id: str, change: ViewChange, store: Store) -> SavedView:
    """Give a view another name, or let it show something else."""
    return SavedView(**asdict(saved_views.change_view(store, view_id, change.name, change.search)))


@router.delete("/{view_id}", status_code=204, responses=problem_responses(400, 403, 404, 422))
@needs("operator")
def delete_view(view_id: str, store: Store) -> None:
    """Forget a view."""
    saved_views.delete_view(store, view_id)
