"""Finding the locomotion models that a claimed run takes its reward from."""

from __future__ import annotations

from pathlib import Path

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import FileGone, NotFound
from backend.store.files import find_file
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from sldr_core.errors import LocomotionMissing

LOCOMOTION_FILE = "locomotion.pt"


def find_locomotion_models(db: Database, settings: Settings, claim: Claim) -> list[Path]:
    """Return the models' files, each the very bytes that were registered, fetched if another machine wrote them.

    Raises:
        LocomotionMissing: a locomotion run has left no model, or its file is gone.
        BadFile: a model's file has changed since it was written.
        StoreUnavailable: store or shared place cannot be used just now.
    """
    storage = FileStorage(settings)
    return [_find_model(db, storage, run_id) for run_id in claim.locomotion_run_ids]


def _find_model(db: Database, storage: FileStorage, run_id: str) -> Path:
    try:
        return storage.bring(find_file(db, run_id, LOCOMOTION_FILE))
    except NotFound as err:
        raise LocomotionMissing(
            f"The locomotion run {run_id} has left no locomotion model; launch it again under a longer preset."
        ) from err
    except FileGone as err:
        raise LocomotionMissing(
            f"The locomotion model of run {run_id} is not there ({err}); put it back, "
            "or cancel that run and launch again."
        ) from err
