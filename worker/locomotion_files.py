"""Finding the locomotion models that a claimed run takes its reward from."""

from __future__ import annotations

from pathlib import Path

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.files import find_file
from backend.store.settings import Settings
from sldr_core.errors import BadFile, LocomotionMissing
from worker.recorder import checksum

LOCOMOTION_FILE = "locomotion.pt"


def find_locomotion_models(db: Database, settings: Settings, claim: Claim) -> list[Path]:
    """Return the models' files, each the very bytes that were registered.

    Raises:
        LocomotionMissing: a locomotion run has left no model, or its file is gone.
        BadFile: a model's file has changed since it was written.
    """
    return [_find_model(db, settings, run_id) for run_id in claim.locomotion_run_ids]


def _find_model(db: Database, settings: Settings, run_id: str) -> Path:
    try:
        row = find_file(db, run_id, LOCOMOTION_FILE)
    except NotFound as err:
        raise LocomotionMissing(
            f"The locomotion run {run_id} has left no locomotion model; launch it again under a longer preset."
        ) from err
    path = settings.home / row.path
    if not path.is_file():
        raise LocomotionMissing(
            f"The locomotion model {path} is gone; put it back, or cancel its run {run_id} and launch again."
        )
    if checksum(path) != row.sha256:
        raise BadFile(f"The locomotion model {path} is not the file that run {run_id} wrote; put back the right one.")
    return path
