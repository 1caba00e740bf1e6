"""Where the locomotion models of a launch come from: the zoo, runs of their own, or runs that a person names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sqlalchemy import Connection, select

from backend.store.states import RunState
from backend.store.tables import AnyRow, runs
from backend.store.zoo_runs import ZooShelf
from sldr_core.config import TrainConfig, config_from_dict
from sldr_core.errors import InvalidConfig
from sldr_core.presets import locomotion_tasks, make_locomotion_config
from sldr_core.zoo.index import ZooModel

ZOO = "zoo"
"""Use the models that come with the product, and train what it has none of."""
TRAIN = "train"
"""Train every model here, or share one that was trained so."""
SETTING = "locomotion"


@dataclass(frozen=True)
class LocomotionWish:
    """Say where models come from: `zoo`, `train`, or ids of locomotion runs, separated by commas."""

    choice: str = TRAIN
    shelf: ZooShelf | None = None
    """The zoo; None where there is none."""


@dataclass(frozen=True)
class LocomotionSource:
    """Say which locomotion run a model is taken from."""

    config: TrainConfig
    """What it was, or will be, trained with."""
    run_id: str | None = None
    """The run that a person has named."""
    model: ZooModel | None = None
    """The model of the zoo that is imported, unless that was done before."""


def find_sources(
    conn: Connection, wish: LocomotionWish, config: TrainConfig, preset: str
) -> Sequence[LocomotionSource]:
    """Return where each locomotion model comes from that a training takes its reward from; often there is none.

    Raises:
        InvalidConfig: a named run cannot serve, or of those named none, or more than one, is of a task that is needed.
        BadFile: the index of the zoo cannot be read.
    """
    wanted = [make_locomotion_config(config, preset, task) for task in locomotion_tasks(config)]
    if wish.choice == TRAIN:
        return [LocomotionSource(needed) for needed in wanted]
    if wish.choice == ZOO:
        models = [None if wish.shelf is None else wish.shelf.find(needed) for needed in wanted]
        return [
            LocomotionSource(needed if model is None else model.config, model=model)
            for needed, model in zip(wanted, models, strict=True)
        ]
    named = _named_runs(conn, wish.choice)
    return [_named_source(named, needed) for needed in wanted]


def _named_runs(conn: Connection, choice: str) -> Sequence[AnyRow]:
    ids = [word.strip() for word in choice.split(",") if word.strip()]
    rows = conn.execute(
        select(runs).where(runs.c.id.in_(ids), runs.c.deleted_at.is_(None)).order_by(runs.c.number)
    ).all()
    unknown = sorted(set(ids) - {row.id for row in rows})
    if unknown or not ids:
        raise InvalidConfig(
            {SETTING: f"there is no run '{', '.join(unknown)}'; give {ZOO}, {TRAIN}, or ids of locomotion runs."}
        )
    for row in rows:
        if row.phase != "locomotion":
            raise InvalidConfig({SETTING: f"run {row.id} is of the robot; name runs in which the object learnt."})
        if row.state in (RunState.FAILED, RunState.CANCELLED):
            raise InvalidConfig(
                {SETTING: f"run {row.id} {row.state}, so it leaves no model; retry it, or name another."}
            )
    return rows


def _named_source(named: Sequence[AnyRow], needed: TrainConfig) -> LocomotionSource:
    fitting = [row for row in named if row.task == needed.task]
    if not fitting:
        raise InvalidConfig({SETTING: f"a run of {needed.task} is needed too; name one, or choose {ZOO} or {TRAIN}."})
    if len(fitting) > 1:
        ids = " and ".join(row.id for row in fitting[:2])
        raise InvalidConfig({SETTING: f"runs {ids} are both of {needed.task}; name one of them."})
    return LocomotionSource(config_from_dict(fitting[0].config), run_id=fitting[0].id)
