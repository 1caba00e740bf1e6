"""Runs that are wanted: which existing ones serve, which have to be made, and making those in one go."""

from __future__ import annotations

import uuid
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Connection, insert, or_, select

from backend.store.dependents import why_blocked
from backend.store.errors import Refused
from backend.store.locomotion import LocomotionSource, LocomotionWish, find_sources
from backend.store.order import last_position
from backend.store.states import Event, RunState, append_event
from backend.store.tables import AnyRow, run_needs, runs
from backend.store.zoo_runs import ZOO_TAG, ZooShelf, import_model
from sldr_core.config import Phase, TrainConfig, config_hash, config_to_dict, settings_hash
from sldr_core.zoo.index import ZooModel

RUN_ID_LENGTH = 12
"""Hex digits of a run's id."""
TRAINED_HERE = LocomotionWish()
"""What is asked for where nobody says anything else."""


@dataclass(frozen=True)
class PlannedRun:
    """Name one run that is wanted: an existing one that serves, or one to be made."""

    config: TrainConfig
    config_hash: str
    preset: str
    needs: tuple[str, ...]
    """Config hashes of the locomotion runs in the same plan that it waits for."""
    reused_run_id: str | None
    """The existing run that serves, if one does."""
    model: ZooModel | None = None
    """The model of the zoo that it is made from, if it is."""
    equal_run_id: str | None = None
    """Of a run to be made: the one that has the same config and learns from the same, if there is one."""

    @property
    def zoo_success(self) -> float | None:
        """Measured success of the zoo's model, 0 to 1; None where the zoo has none that serves."""
        return None if self.model is None else self.model.measured.success_rate

    @property
    def task(self) -> str:
        """The task."""
        return self.config.task

    @property
    def phase(self) -> Phase:
        """The phase."""
        return self.config.phase

    @property
    def method(self) -> str:
        """The method."""
        return self.config.method

    @property
    def seed(self) -> int:
        """The seed."""
        return self.config.seed


def plan_runs(
    conn: Connection,
    configs: Sequence[TrainConfig],
    preset: str,
    share_all: bool = False,
    wish: LocomotionWish = TRAINED_HERE,
) -> list[PlannedRun]:
    """Return the runs that configs stand for, in their order, behind the locomotion runs that they need.

    Args:
        configs: what is wanted, each once.
        preset: the budget of the locomotion runs, and the name of it that every run bears.
        share_all: whether any existing run may serve; else only locomotion runs are shared.
        wish: where locomotion models come from.

    Raises:
        InvalidConfig: a locomotion run that a person has named cannot serve.
    """
    wanted = {config_hash(config): config for config in configs}
    needed = _find_needed(conn, wanted, preset, wish)
    learnt_from = {
        digest: {source.run_id or needed_digest for needed_digest, source in needed[digest].items()}
        for digest in wanted
    }
    equal = find_serving(conn, learnt_from)
    serving = {digest: run for digest, run in equal.items() if share_all or wanted[digest].phase == "locomotion"}
    # A run that is there already has what it needs, or says itself what became of that.
    of_new_runs = [sources for digest, sources in needed.items() if digest not in serving]
    locomotion = {digest: source for sources in of_new_runs for digest, source in sources.items()}
    named = {digest: source.run_id for digest, source in locomotion.items() if source.run_id is not None}
    serving = find_serving(conn, dict.fromkeys(locomotion, frozenset())) | serving | named
    plan = [
        PlannedRun(source.config, digest, preset, needs=(), reused_run_id=serving.get(digest), model=source.model)
        for digest, source in locomotion.items()
    ]
    for digest, config in wanted.items():
        needs = () if digest in serving else tuple(needed[digest])
        repeated = None if digest in serving else equal.get(digest)
        plan.append(PlannedRun(config, digest, preset, needs, serving.get(digest), equal_run_id=repeated))
    return plan


def _find_needed(
    conn: Connection, wanted: Mapping[str, TrainConfig], preset: str, wish: LocomotionWish
) -> dict[str, dict[str, LocomotionSource]]:
    """Return by config hash where its locomotion models come from, each by the config hash of its run."""
    of_all_seeds: dict[str, dict[str, LocomotionSource]] = {}
    needed: dict[str, dict[str, LocomotionSource]] = {}
    for digest, config in wanted.items():
        settings = settings_hash(config)
        if settings not in of_all_seeds:
            sources = find_sources(conn, wish, config, preset)
            of_all_seeds[settings] = {config_hash(source.config): source for source in sources}
        needed[digest] = of_all_seeds[settings]
    return needed


def find_serving(conn: Connection, digests: Mapping[str, AbstractSet[str]]) -> dict[str, str]:
    """Return the oldest run that was or will be trained with each of these configs, where there is one.

    Args:
        digests: by config hash, what such a run must learn from: the id of each locomotion run, or its config hash.
    """
    lost = (RunState.FAILED, RunState.CANCELLED)
    there = (
        runs.c.config_hash.in_(list(digests)),
        runs.c.state.not_in(lost),
        or_(runs.c.cancel_requested.is_(False), runs.c.state == RunState.SUCCEEDED),
        runs.c.deleted_at.is_(None),
        # What came in a study file is there to be looked at; nobody here can vouch for it.
        or_(runs.c.origin.is_(None), runs.c.origin == ZOO_TAG),
    )
    found = conn.execute(select(runs.c.id, runs.c.config_hash).where(*there).order_by(runs.c.number)).all()
    needs = _read_needs(conn, there)
    serving: dict[str, str] = {}
    for row in found:
        wanted = digests[row.config_hash]
        learnt_from = [need.id if need.id in wanted else need.config_hash for need in needs.get(row.id, ())]
        # The config does not tell what a run learns from, so two of the same config may be different trainings.
        if sorted(learnt_from) == sorted(wanted):
            serving.setdefault(row.config_hash, row.id)
    return serving


def _read_needs(conn: Connection, conditions: Sequence[ColumnElement[bool]]) -> dict[str, list[AnyRow]]:
    """Return id and config hash of what runs need, deleted or not, by run id."""
    needed = runs.alias("needed")
    query = (
        select(run_needs.c.run_id, needed.c.id, needed.c.config_hash)
        .join(needed, needed.c.id == run_needs.c.needs_run_id)
        .where(run_needs.c.run_id.in_(select(runs.c.id).where(*conditions)))
    )
    needs: dict[str, list[AnyRow]] = {}
    for row in conn.execute(query):
        needs.setdefault(row.run_id, []).append(row)
    return needs


def make_runs(
    conn: Connection, plan: Sequence[PlannedRun], at: datetime, shelf: ZooShelf | None = None
) -> dict[str, str]:
    """Make the runs of a plan that do not exist; return the ids of all of them by their config hash, in its order.

    Raises:
        BadFile: a model of the zoo is not the one that was measured.
        DiskTooFull: there is no room for it.
        Refused: a locomotion run of the plan was deleted meanwhile.
    """
    ids = {planned.config_hash: planned.reused_run_id or _new_id() for planned in plan}
    new = [planned for planned in plan if planned.reused_run_id is None]
    if shelf is not None:
        for planned in new:
            if planned.model is not None:
                import_model(conn, shelf, ids[planned.config_hash], planned.model, at)
        new = [planned for planned in new if planned.model is None]
    # What others need is made first, so that a needed run has the lower number.
    _insert_runs(conn, [planned for planned in new if not planned.needs], ids, at)
    _insert_runs(conn, [planned for planned in new if planned.needs], ids, at)
    return ids


def _new_id() -> str:
    return uuid.uuid4().hex[:RUN_ID_LENGTH]


def _insert_runs(conn: Connection, new: Sequence[PlannedRun], ids: Mapping[str, str], at: datetime) -> None:
    if not new:
        return
    edges = {ids[planned.config_hash]: [ids[digest] for digest in planned.needs] for planned in new}
    needed_ids = {needed_id for of_one_run in edges.values() for needed_id in of_one_run}
    # Locked, so that a locomotion run can neither end nor go unseen between this look and the insert.
    query = select(runs).where(runs.c.id.in_(needed_ids)).order_by(runs.c.number)
    needed = conn.execute(query.with_for_update()).all()
    for row in needed:
        if row.deleted_at is not None:
            raise Refused(f"The locomotion run {row.id} was deleted just now; launch again to train another.")
    rows = [_new_row(planned, ids, needed) for planned in new]
    first = last_position(conn)
    placed = [{**row, "queue_position": first + place, "created_at": at} for place, row in enumerate(rows)]
    conn.execute(insert(runs), placed)
    pairs = [{"run_id": run_id, "needs_run_id": needed_id} for run_id, own in edges.items() for needed_id in own]
    if pairs:
        conn.execute(insert(run_needs), pairs)
    for row in rows:
        append_event(conn, row["id"], Event.CREATED, row["state"], at=at, attempt=0, detail=row["reason"])


def _new_row(planned: PlannedRun, ids: Mapping[str, str], needed: Sequence[AnyRow]) -> dict[str, Any]:
    """Return what the table holds of a new run, but its place in the queue and the time."""
    own = {ids[digest] for digest in planned.needs}
    reason = why_blocked([row for row in needed if row.id in own], planned.config.sldr.gate)
    return {
        "id": ids[planned.config_hash],
        "task": planned.task,
        "phase": planned.phase,
        "method": planned.method,
        "seed": planned.seed,
        "preset": planned.preset,
        "config": config_to_dict(planned.config),
        "config_hash": planned.config_hash,
        "settings_hash": settings_hash(planned.config),
        "state": RunState.QUEUED if reason is None else RunState.BLOCKED,
        "reason": reason,
        "needs_gpu": planned.config.compute.device == "cuda",
    }
