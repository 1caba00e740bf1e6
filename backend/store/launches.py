"""Launching: which runs an order stands for, and which existing ones already serve."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import Connection

from backend.store.database import LAUNCH_TURN, Database, current_time, take_turn
from backend.store.locomotion import TRAIN, LocomotionWish
from backend.store.run_plans import PlannedRun, make_runs, plan_runs
from backend.store.zoo_runs import ZooShelf
from sldr_core.config import Phase
from sldr_core.errors import InvalidConfig
from sldr_core.presets import make_config


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
    locomotion: str = TRAIN
    """Where the locomotion models come from: `zoo`, `train`, or ids of locomotion runs, separated by commas."""


def plan_launch(db: Database, order: LaunchOrder, shelf: ZooShelf | None = None) -> list[PlannedRun]:
    """Return what `launch` would do, locomotion first.

    Raises:
        UnknownName: task, phase, method or preset does not exist.
        InvalidConfig: a setting is unknown or cannot work.
    """
    with db.read() as conn:
        return _plan(conn, order, shelf)


def launch(db: Database, order: LaunchOrder, shelf: ZooShelf | None = None) -> list[str]:
    """Queue the runs of an order; return their ids and those of the existing ones that serve, locomotion first.

    Raises:
        UnknownName: task, phase, method or preset does not exist.
        InvalidConfig: a setting is unknown or cannot work.
        Refused: a locomotion run that would serve was deleted meanwhile.
    """
    with db.write() as conn:
        # Two launches at once must not both find that a locomotion run has to be made.
        take_turn(conn, LAUNCH_TURN)
        return list(make_runs(conn, _plan(conn, order, shelf), current_time(conn), shelf).values())


def _plan(conn: Connection, order: LaunchOrder, shelf: ZooShelf | None) -> list[PlannedRun]:
    _check(order)
    overrides = dict(order.overrides)
    configs = [
        make_config(order.task, order.phase, order.method, seed, order.preset, overrides) for seed in order.seeds
    ]
    return plan_runs(conn, configs, order.preset, wish=LocomotionWish(order.locomotion, shelf))


def _check(order: LaunchOrder) -> None:
    if not order.seeds:
        raise InvalidConfig({"seeds": "none is given; list at least one."})
    twice = sorted({seed for seed in order.seeds if list(order.seeds).count(seed) > 1})
    if twice:
        raise InvalidConfig({"seeds": f"{twice[0]} is listed more than once; list each seed once."})
