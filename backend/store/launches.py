"""Launching: which runs an order stands for, and which existing ones already serve."""

from __future__ import annotations

import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, insert, select

from backend.store.database import LAUNCH_TURN, Database, current_time, take_turn
from backend.store.dependents import why_blocked
from backend.store.order import last_position
from backend.store.states import Event, RunState, append_event
from backend.store.tables import AnyRow, run_needs, runs
from sldr_core.config import PHASES, Phase, TrainConfig, config_hash, config_to_dict, settings_hash
from sldr_core.errors import InvalidConfig, UnknownName
from sldr_core.presets import locomotion_tasks, make_config, make_locomotion_config

RUN_ID_LENGTH = 12
"""Hex digits of a run's id."""
SET_BY_THE_ORDER = ("task", "phase", "method", "seed")
"""Settings that an order names itself, so that its overrides must not."""


@dataclass(frozen=True)
class LaunchOrder:
    """Ask for one run per seed, with the locomotion run they need."""

    task: str
    phase: Phase
    method: str
    seeds: Sequence[int]
    preset: str
    overrides: Mapping[str, Any] = field(default_factory=dict[str, Any])
    """Settings laid over the preset, nested."""


@dataclass(frozen=True)
class PlannedRun:
    """Name one run of an order: an existing one that serves, or one to be made."""

    config: TrainConfig
    config_hash: str
    preset: str
    needs: tuple[str, ...]
    """Config hashes of the locomotion runs in the same plan that it waits for."""
    reused_run_id: str | None
    """The existing run that serves, if one does."""

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


def plan_launch(db: Database, order: LaunchOrder) -> list[PlannedRun]:
    """Return what `launch` would do, locomotion first.

    Raises:
        UnknownName: task, phase, method or preset does not exist.
        InvalidConfig: a setting is unknown or cannot work.
    """
    with db.read() as conn:
        return _plan(conn, order)


def launch(db: Database, order: LaunchOrder) -> list[str]:
    """Queue the runs of an order; return their ids and those of the existing ones that serve, locomotion first.

    Raises:
        UnknownName: task, phase, method or preset does not exist.
        InvalidConfig: a setting is unknown or cannot work.
    """
    ids: dict[str, str] = {}
    with db.write() as conn:
        # Two launches at once must not both find that a locomotion run has to be made.
        take_turn(conn, LAUNCH_TURN)
        at = current_time(conn)
        for planned in _plan(conn, order):
            needed = [ids[needed_hash] for needed_hash in planned.needs]
            ids[planned.config_hash] = planned.reused_run_id or _insert_run(conn, planned, needed, at)
    return list(ids.values())


def _plan(conn: Connection, order: LaunchOrder) -> list[PlannedRun]:
    _check(order)
    overrides = dict(order.overrides)
    configs = [
        make_config(order.task, order.phase, order.method, seed, order.preset, overrides) for seed in order.seeds
    ]
    needed = [_locomotion_configs(config, order.preset) for config in configs]
    locomotion = {digest: config for of_one_run in needed for digest, config in of_one_run.items()}
    plan = [_planned(conn, config, order.preset, ()) for config in locomotion.values()]
    for config, of_one_run in zip(configs, needed, strict=True):
        plan.append(_planned(conn, config, order.preset, tuple(of_one_run)))
    return plan


def _locomotion_configs(config: TrainConfig, preset: str) -> dict[str, TrainConfig]:
    """Return the locomotion runs that a run takes its reward from, by their hash."""
    configs = [make_locomotion_config(config, preset, task) for task in locomotion_tasks(config)]
    return {config_hash(config): config for config in configs}


def _check(order: LaunchOrder) -> None:
    if order.phase not in PHASES:
        raise UnknownName("phase", order.phase, PHASES)
    if not order.seeds:
        raise InvalidConfig({"seeds": "none is given; list at least one."})
    twice = sorted({seed for seed in order.seeds if list(order.seeds).count(seed) > 1})
    if twice:
        raise InvalidConfig({"seeds": f"{twice[0]} is listed more than once; list each seed once."})
    misplaced = [name for name in SET_BY_THE_ORDER if name in order.overrides]
    if misplaced:
        raise InvalidConfig(
            {name: "is named by the launch itself; leave it out of the overrides." for name in misplaced}
        )


def _planned(conn: Connection, config: TrainConfig, preset: str, needs: tuple[str, ...]) -> PlannedRun:
    digest = config_hash(config)
    reused = _find_shared(conn, digest) if config.phase == "locomotion" else None
    return PlannedRun(config=config, config_hash=digest, preset=preset, needs=needs, reused_run_id=reused)


def _find_shared(conn: Connection, digest: str) -> str | None:
    """Return the locomotion run that was or will be trained with this config."""
    lost = (RunState.FAILED, RunState.CANCELLED)
    query = (
        select(runs.c.id)
        .where(
            runs.c.config_hash == digest,
            runs.c.state.not_in(lost),
            runs.c.cancel_requested.is_(False),
            runs.c.deleted_at.is_(None),
        )
        .order_by(runs.c.number)
        .limit(1)
    )
    return conn.execute(query).scalar_one_or_none()


def _insert_run(conn: Connection, planned: PlannedRun, needed_ids: list[str], at: datetime) -> str:
    # Locked, so that a locomotion run cannot end unseen between this look and the insert.
    query = select(runs).where(runs.c.id.in_(needed_ids)).order_by(runs.c.number).with_for_update()
    needed: Sequence[AnyRow] = conn.execute(query).all()
    reason = why_blocked(needed, planned.config.sldr.gate)
    state = RunState.QUEUED if reason is None else RunState.BLOCKED
    run_id = uuid.uuid4().hex[:RUN_ID_LENGTH]
    conn.execute(
        insert(runs).values(
            id=run_id,
            task=planned.task,
            phase=planned.phase,
            method=planned.method,
            seed=planned.seed,
            preset=planned.preset,
            config=config_to_dict(planned.config),
            config_hash=planned.config_hash,
            settings_hash=settings_hash(planned.config),
            state=state,
            reason=reason,
            needs_gpu=planned.config.compute.device == "cuda",
            queue_position=last_position(conn),
            created_at=at,
        )
    )
    for needed_id in needed_ids:
        conn.execute(insert(run_needs).values(run_id=run_id, needs_run_id=needed_id))
    append_event(conn, run_id, Event.CREATED, state, at=at, attempt=0, detail=reason)
    return run_id
