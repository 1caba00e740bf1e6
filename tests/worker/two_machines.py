"""What the processes of a run do on two machines: two data directories, one store, one shared place for files."""

from __future__ import annotations

from pathlib import Path

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.outcomes import HandedBack
from backend.store.queue import claim, finish
from backend.store.settings import Settings
from sldr_core.training.checkpoint import KIND
from sldr_core.training.files import CHECKPOINT_FILE, REPLAY_FILE
from worker.claimed_files import bring_claimed_run
from worker.recorder import StoreRecorder


def next_claim(db: Database) -> Claim:
    claimed = claim(db, "worker-1")
    assert claimed is not None
    return claimed


def hand_over(db: Database, held: Claim) -> Claim:
    """End an attempt and claim its run again."""
    finish(db, held, HandedBack("Its worker was asked to end."))
    return next_claim(db)


def begin(
    db: Database, settings: Settings, held: Claim, recorder: type[StoreRecorder] = StoreRecorder
) -> StoreRecorder:
    """Do what a child does before it trains."""
    settings.run_directory(held.run_id).mkdir(parents=True, exist_ok=True)
    bring_claimed_run(db, settings, held)
    return recorder(db, settings, held, lambda: None)


def save(db: Database, settings: Settings, held: Claim, content: bytes, name: str = CHECKPOINT_FILE) -> None:
    """Save a file as a training would, after episodes were stored."""
    with begin(db, settings, held) as recorder:
        (recorder.directory / REPLAY_FILE).write_bytes(content * 2)
        recorder.save_file(name, KIND if name == CHECKPOINT_FILE else "policy", lambda path: write(path, content))


def write(path: Path, content: bytes) -> None:
    path.write_bytes(content)
