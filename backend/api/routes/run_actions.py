"""What a person can ask of runs, one or many: end, hold, go on, try again, release, delete; and their order."""

from __future__ import annotations

from dataclasses import asdict

from fastapi import APIRouter

from backend.api.access.declarations import needs
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.queue_schemas import ActionResult, ActionResults, Move, PriorityChange, RunActions
from backend.store import actions, order

router = APIRouter(prefix="/api/runs", tags=["runs"])


@router.post("/actions", responses=problem_responses(400, 403, 422))
@needs("operator")
def act_on_runs(wish: RunActions, store: Store) -> ActionResults:
    """Do something to runs; one that does not allow it says why, and keeps no other from it."""
    results = actions.act_on(store, wish.action, wish.run_ids)
    return ActionResults(results=[ActionResult(**asdict(result)) for result in results])


@router.put("/priority", status_code=204, responses=problem_responses(400, 403, 404, 422))
@needs("operator")
def set_runs_priority(change: PriorityChange, store: Store) -> None:
    """Give runs a priority: all of them or, if one does not exist, none."""
    order.set_priority(store, change.run_ids, change.priority)


@router.post("/{run_id}/move", status_code=204, responses=problem_responses(400, 403, 404, 409, 422))
@needs("operator")
def move_run(run_id: str, move: Move, store: Store) -> None:
    """Put a waiting run before another one, or at the end of the queue."""
    order.move_run(store, run_id, move.before)
