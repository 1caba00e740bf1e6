"""Making and changing studies: launch, extend, fill what is missing, rename, delete and bring back."""

from __future__ import annotations

import uuid
from dataclasses import dataclass

from sqlalchemy import Connection, delete, insert, select, update

from backend.store.database import LAUNCH_TURN, Database, current_time, take_turn
from backend.store.errors import NotFound, Refused
from backend.store.run_plans import make_runs
from backend.store.studies.plan import PlannedPlace, StudyPlan, plan_study
from backend.store.studies.spec import (
    LONGEST_NOTE,
    Addition,
    StudySpec,
    check_name,
    check_text,
    extend_spec,
    spec_from_dict,
    spec_to_dict,
)
from backend.store.tables import AnyRow, runs, studies, study_runs
from backend.store.zoo_runs import ZooShelf
from sldr_core.errors import InvalidConfig

STUDY_ID_LENGTH = 12
"""Hex digits of a study's id."""


@dataclass(frozen=True)
class Launched:
    """Say what launching a study, or more of it, has done."""

    study_id: str
    queued: int
    """Runs that were made, locomotion runs counted."""
    joined: int
    """Places that a run from elsewhere serves."""


def preview_study(
    db: Database, spec: StudySpec, study_id: str | None = None, shelf: ZooShelf | None = None
) -> StudyPlan:
    """Return what launching a spec would do, for a new study or for one that is there.

    Raises:
        NotFound: there is no such study.
        UnknownName: task, method or preset does not exist.
        InvalidConfig: the study, or a setting of one of its runs, cannot work.
    """
    with db.read() as conn:
        if study_id is not None:
            hold_study(conn, study_id)
        return plan_study(conn, spec, study_id, shelf)


def create_study(db: Database, name: str, spec: StudySpec, note: str = "", shelf: ZooShelf | None = None) -> Launched:
    """Make a study and queue the runs that nothing serves yet.

    Raises:
        UnknownName: task, method or preset does not exist.
        InvalidConfig: the study, its name, or a setting of one of its runs, cannot work.
        Refused: another study has the name.
    """
    name, note = check_name(name), check_text("note", note, LONGEST_NOTE)
    study_id = uuid.uuid4().hex[:STUDY_ID_LENGTH]
    with db.write() as conn:
        # Two launches at once must not both find that a run has to be made, or that a name is free.
        take_turn(conn, LAUNCH_TURN)
        _check_name_is_free(conn, name)
        plan = plan_study(conn, spec, shelf=shelf)
        values = {"id": study_id, "name": name, "note": note, "preset": spec.preset, "spec": spec_to_dict(spec)}
        conn.execute(insert(studies).values(**values, created_at=current_time(conn)))
        return _launch(conn, study_id, plan, shelf)


def extend_study(db: Database, study_id: str, addition: Addition, shelf: ZooShelf | None = None) -> Launched:
    """Add tasks, methods, seeds or variants to a study, and queue every run that it then misses.

    Raises:
        NotFound: there is no such study.
        UnknownName: a task or method does not exist.
        InvalidConfig: nothing would be added, the study would be too large, or a variant cannot be beside its others.
        Refused: the study is deleted.
    """
    with db.write() as conn:
        take_turn(conn, LAUNCH_TURN)
        spec = spec_from_dict(hold_study(conn, study_id).spec)
        longer = extend_spec(spec, addition)
        if longer == spec:
            raise InvalidConfig(
                {"seeds": "the study has all of that already; name a task, method, seed or variant to add."}
            )
        plan = plan_study(conn, longer, study_id, shelf)
        conn.execute(update(studies).where(studies.c.id == study_id).values(spec=spec_to_dict(longer)))
        return _launch(conn, study_id, plan, shelf)


def fill_study(db: Database, study_id: str, shelf: ZooShelf | None = None) -> Launched:
    """Queue the runs that a study misses, as those that were deleted; asked again, it finds nothing to do.

    Raises:
        NotFound: there is no such study.
        InvalidConfig: a setting no longer works in this version.
        Refused: the study is deleted.
    """
    with db.write() as conn:
        take_turn(conn, LAUNCH_TURN)
        spec = spec_from_dict(hold_study(conn, study_id).spec)
        return _launch(conn, study_id, plan_study(conn, spec, study_id, shelf), shelf)


def rename_study(db: Database, study_id: str, name: str | None = None, note: str | None = None) -> None:
    """Give a study another name or note; None leaves it as it is.

    Raises:
        NotFound: there is no such study.
        InvalidConfig: the name or note cannot work.
        Refused: another study has the name, or this one is deleted.
    """
    with db.write() as conn:
        take_turn(conn, LAUNCH_TURN)
        hold_study(conn, study_id)
        values: dict[str, str] = {}
        if name is not None:
            values["name"] = check_name(name)
            _check_name_is_free(conn, values["name"], study_id)
        if note is not None:
            values["note"] = check_text("note", note, LONGEST_NOTE)
        if values:
            conn.execute(update(studies).where(studies.c.id == study_id).values(values))


def delete_study(db: Database, study_id: str) -> None:
    """Hide a study; its runs stay as they are, and it can be brought back.

    Raises:
        NotFound: there is no such study.
        Refused: it is deleted already.
    """
    with db.write() as conn:
        hold_study(conn, study_id)
        conn.execute(update(studies).where(studies.c.id == study_id).values(deleted_at=current_time(conn)))


def restore_study(db: Database, study_id: str) -> None:
    """Bring back a deleted study.

    Raises:
        NotFound: there is no such study.
        Refused: it is not deleted, or another study has taken its name.
    """
    with db.write() as conn:
        take_turn(conn, LAUNCH_TURN)
        study = find_study(conn, study_id)
        if study.deleted_at is None:
            raise Refused(f"Study '{study.name}' is not deleted.")
        _check_name_is_free(conn, study.name)
        conn.execute(update(studies).where(studies.c.id == study_id).values(deleted_at=None))


def find_study(conn: Connection, study_id: str) -> AnyRow:
    """Return the row of a study, deleted or not.

    Raises:
        NotFound: there is no such study.
    """
    row = conn.execute(select(studies).where(studies.c.id == study_id)).one_or_none()
    if row is None:
        raise NotFound("study", study_id)
    return row


def hold_study(conn: Connection, study_id: str) -> AnyRow:
    """Return the row of a study that can be changed.

    Raises:
        NotFound: there is no such study.
        Refused: it is deleted.
    """
    row = find_study(conn, study_id)
    if row.deleted_at is not None:
        raise Refused(f"Study '{row.name}' is deleted; restore it first.")
    return row


def _launch(conn: Connection, study_id: str, plan: StudyPlan, shelf: ZooShelf | None) -> Launched:
    """Make the runs that a plan lacks, and put every place's run into the study."""
    ids = make_runs(conn, plan.runs, current_time(conn), shelf)
    missing = [planned for planned in plan.places if planned.config_hash is not None]
    # A deleted run gives its place to the one that is made in its stead.
    gone = select(runs.c.id).where(runs.c.deleted_at.is_not(None))
    conn.execute(delete(study_runs).where(study_runs.c.study_id == study_id, study_runs.c.run_id.in_(gone)))
    rows = [_member(study_id, planned, ids[str(planned.config_hash)]) for planned in missing]
    if rows:
        conn.execute(insert(study_runs), rows)
    joined = sum(planned.run_id is not None for planned in missing)
    return Launched(study_id, queued=len(plan.new_runs), joined=joined)


def _member(study_id: str, planned: PlannedPlace, run_id: str) -> dict[str, object]:
    cell, seed = planned.place.cell, planned.place.seed
    return {
        "study_id": study_id,
        "task": cell.task,
        "method": cell.method,
        "variant": cell.variant,
        "seed": seed,
        "run_id": run_id,
    }


def _check_name_is_free(conn: Connection, name: str, own_id: str = "") -> None:
    query = select(studies.c.id).where(studies.c.name == name, studies.c.deleted_at.is_(None), studies.c.id != own_id)
    if conn.execute(query.limit(1)).scalar_one_or_none() is not None:
        raise Refused(
            f"There is a study called '{name}' already; choose another name, or add seeds to that one on its page."
        )
