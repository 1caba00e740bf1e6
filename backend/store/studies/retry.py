"""Trying the ended runs of a study again."""

from __future__ import annotations

from backend.store.actions import Action, ActionResult, act_on
from backend.store.database import Database
from backend.store.errors import Refused
from backend.store.states import RunState
from backend.store.studies.matrix import get_study


def retry_study(db: Database, study_id: str, cancelled: bool = False) -> list[ActionResult]:
    """Try the failed or else the cancelled runs of a study again, and first the locomotion runs that they need.

    Raises:
        NotFound: there is no such study.
        Refused: the study is deleted.
    """
    matrix = get_study(db, study_id)
    if matrix.study.deleted_at is not None:
        raise Refused(f"Study '{matrix.study.name}' is deleted; restore it first.")
    ended = RunState.CANCELLED if cancelled else RunState.FAILED
    every = [*matrix.locomotion, *(run for cell in matrix.cells for run in cell.runs)]
    tried = [run.run_id for run in every if run.state is ended]
    results = act_on(db, Action.RETRY, tried)
    # A run brings back what it needs if that was deleted, so there may be more locomotion runs now.
    back = [run.run_id for run in get_study(db, study_id).locomotion if run.state is ended and run.run_id not in tried]
    return results + act_on(db, Action.RETRY, back)
