"""Locomotion models of the zoo as runs: a model that a launch uses is imported once, and is then a run like others."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from functools import cached_property
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, insert

from backend.store.order import last_position
from backend.store.settings import Settings
from backend.store.states import Event, RunState, append_event
from backend.store.storage import FileStorage
from backend.store.tables import run_files, run_progress, run_tags, runs
from sldr_core.config import TrainConfig, config_hash, config_to_dict, settings_hash
from sldr_core.disk import write_atomically
from sldr_core.zoo.index import ZooModel, find_in_zoo, read_zoo

ZOO_TAG = "zoo"
"""What runs are tagged with whose model came with the product."""
LOCOMOTION_FILE = "locomotion.pt"
LOCOMOTION_KIND = "locomotion"
IMPORTED_ATTEMPT = 1


@dataclass(frozen=True)
class ZooShelf:
    """The zoo, and where copies of its models go."""

    settings: Settings

    @cached_property
    def models(self) -> Mapping[str, ZooModel]:
        """The models by their names.

        Raises:
            BadFile: the index cannot be read.
        """
        return read_zoo()

    def find(self, config: TrainConfig) -> ZooModel | None:
        """Return the model that may stand in for the run of a locomotion config, if there is one."""
        return find_in_zoo(self.models, config)

    def place(self, run_id: str, model: ZooModel) -> str:
        """Copy a model to where a run's files lie; return the path for its row.

        Raises:
            BadFile: it is not the file that was measured.
            DiskTooFull: there is no room for it.
            FilesUnavailable: the shared place cannot be written just now.
        """
        model.check()

        def copy(path: Path) -> None:
            shutil.copyfile(model.path, path)

        target = self.settings.run_directory(run_id) / LOCOMOTION_FILE
        target.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(target, copy)
        return FileStorage(self.settings).keep(run_id, IMPORTED_ATTEMPT, target, model.sha256)


def import_model(conn: Connection, shelf: ZooShelf, run_id: str, model: ZooModel, at: datetime) -> None:
    """Make the run of a model of the zoo: it has succeeded, as well as the shipped file was measured to do.

    Raises:
        BadFile: the file is not the one that was measured.
        DiskTooFull: there is no room for it.
        FilesUnavailable: the shared place cannot be written just now.
    """
    path = shelf.place(run_id, model)
    conn.execute(insert(runs).values(**_run(run_id, model), queue_position=last_position(conn), created_at=at))
    conn.execute(
        insert(run_files).values(
            run_id=run_id,
            name=LOCOMOTION_FILE,
            kind=LOCOMOTION_KIND,
            path=path,
            size=model.size,
            sha256=model.sha256,
            attempt=IMPORTED_ATTEMPT,
            created_at=at,
        )
    )
    conn.execute(insert(run_progress).values(**_progress(run_id, model)))
    conn.execute(insert(run_tags).values(run_id=run_id, tag=ZOO_TAG))
    detail = (
        f"Its model came with the product: {model.measured.success_rate:.1%} success "
        f"over {model.measured.episodes} test episodes."
    )
    append_event(conn, run_id, Event.IMPORTED, RunState.SUCCEEDED, at=at, attempt=IMPORTED_ATTEMPT, detail=detail)


def _run(run_id: str, model: ZooModel) -> dict[str, Any]:
    config = model.config
    return {
        "id": run_id,
        "task": config.task,
        "phase": config.phase,
        "method": config.method,
        "seed": config.seed,
        "preset": model.origin.preset,
        "config": config_to_dict(config),
        "config_hash": config_hash(config),
        "settings_hash": settings_hash(config),
        "state": RunState.SUCCEEDED,
        "success_rate": model.measured.success_rate,
        "attempt": IMPORTED_ATTEMPT,
        "origin": ZOO_TAG,
    }


def _progress(run_id: str, model: ZooModel) -> dict[str, Any]:
    epochs = model.config.loop.epochs
    return {
        "run_id": run_id,
        "epoch": epochs,
        "epochs": epochs,
        "env_steps": 0,
        "episodes": 0,
        "updates": 0,
        "fraction": 1.0,
        "success_rate": model.measured.success_rate,
        "best_success_rate": model.measured.success_rate,
    }
