"""A run goes on where another machine left it: two data directories, one store, one shared place for files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
import torch
from two_machines import begin, hand_over, next_claim, save, write

from backend.store import files
from backend.store.backups.make import make_backup
from backend.store.backups.restore import restore_backup
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import FilesUnavailable, StaleFence
from backend.store.files import find_file, list_files
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.outcomes import CHECKPOINT_KIND, Succeeded
from backend.store.queue import finish
from backend.store.settings import Settings
from backend.store.storage import FileStorage, SharedPlace
from sldr_core.records import Step
from sldr_core.training import DirectoryRecorder, train
from sldr_core.training.checkpoint import KIND
from sldr_core.training.files import CHECKPOINT_FILE, NEWEST_POLICY_FILE, PREVIOUS_CHECKPOINT_FILE, REPLAY_FILE
from worker.claimed_files import CHECKPOINT_FILES
from worker.file_keeper import FileKeeper
from worker.locomotion_files import find_locomotion_models
from worker.recorder import StoreRecorder

KILLED_AT = 11
"""Cycle after which the first machine dies; its newest checkpoint is of cycle 10."""
LOOP = {"epochs": 2, "cycles_per_epoch": 6, "episodes_per_cycle": 2, "test_episodes": 2}


class PowerCut(Exception):
    """Stand in for the end of a machine."""


class DyingRecorder(StoreRecorder):
    """Record until the machine dies."""

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        if step.cycle > KILLED_AT:
            raise PowerCut
        super().log(step, metrics)


def tensors(path: Path) -> Iterator[torch.Tensor]:
    """Return every tensor in a file."""
    yield from _tensors_in(torch.load(path, weights_only=True))


def _tensors_in(value: Any) -> Iterator[torch.Tensor]:
    if isinstance(value, torch.Tensor):
        yield value
    elif isinstance(value, Mapping):
        for part in value.values():
            yield from _tensors_in(part)
    elif isinstance(value, list | tuple):
        for part in value:
            yield from _tensors_in(part)


def shared_paths(settings: Settings, run_id: str) -> set[str]:
    assert settings.files_url is not None
    return set(SharedPlace(settings.files_url).paths_below(f"runs/{run_id}"))


def test_the_worker_knows_the_files_that_a_training_resumes_from() -> None:
    assert files.REPLAY_FILE == REPLAY_FILE
    assert (CHECKPOINT_FILE, PREVIOUS_CHECKPOINT_FILE) == CHECKPOINT_FILES
    assert KIND == CHECKPOINT_KIND


def test_a_run_whose_machine_died_ends_elsewhere_with_the_same_bits(
    db: Database, here: Settings, there: Settings, tmp_path: Path
) -> None:
    launch(db, LaunchOrder("FetchPush", "locomotion", "her", [0], "smoke", {"loop": LOOP}))
    first = next_claim(db)
    dying = begin(db, here, first, DyingRecorder)
    with pytest.raises(PowerCut), dying:
        train(first.config, dying)
    second = hand_over(db, first)
    with begin(db, there, second) as recorder:
        train(second.config, recorder)

    undisturbed = DirectoryRecorder(tmp_path / "undisturbed")
    train(first.config, undisturbed)
    for name in (CHECKPOINT_FILE, NEWEST_POLICY_FILE):
        pairs = zip(tensors(recorder.directory / name), tensors(undisturbed.directory / name), strict=True)
        assert all(torch.equal(*pair) for pair in pairs)
    columns = read_metrics(db, first.run_id)
    assert columns.step == list(range(1, 13))
    assert [columns.attempt[cycle - 1] for cycle in (1, 10, 11, 12)] == [1, 1, 2, 2]


def test_a_machine_that_gets_its_run_back_takes_the_newer_checkpoint(
    db: Database, here: Settings, there: Settings, first: Claim
) -> None:
    save(db, here, first, b"of the first")
    second = hand_over(db, first)
    save(db, there, second, b"of the second")
    third = hand_over(db, second)

    directory = begin(db, here, third).directory

    assert (directory / CHECKPOINT_FILE).read_bytes() == b"of the second"
    assert (directory / REPLAY_FILE).read_bytes() == b"of the second" * 2


def test_a_machine_that_trained_last_goes_on_from_its_own_directory(db: Database, here: Settings, first: Claim) -> None:
    save(db, here, first, b"stored")
    (here.run_directory(first.run_id) / CHECKPOINT_FILE).write_bytes(b"newer, its row was not written any more")

    directory = begin(db, here, hand_over(db, first)).directory

    assert (directory / CHECKPOINT_FILE).read_bytes().startswith(b"newer")


@pytest.mark.parametrize("is_saved_before", [True, False])
def test_after_a_restore_a_machine_leaves_what_it_trained_since_the_backup(
    db: Database, here: Settings, there: Settings, first: Claim, tmp_path: Path, is_saved_before: bool
) -> None:
    there.home.mkdir()
    if is_saved_before:
        save(db, here, first, b"before the backup")
    make_backup(there, tmp_path / "kept", overwrite=False, tell=lambda _: None)
    save(db, here, first, b"after the backup")
    save(db, here, hand_over(db, first), b"the next day")
    restore_backup(there, tmp_path / "kept", overwrite=True, tell=lambda _: None)

    again = next_claim(db)
    checkpoint = begin(db, here, again).directory / CHECKPOINT_FILE

    assert (checkpoint.read_bytes() if checkpoint.exists() else None) == (
        b"before the backup" if is_saved_before else None
    )
    save(db, here, again, b"trained again")
    directory = begin(db, here, hand_over(db, again)).directory
    assert (directory / CHECKPOINT_FILE).read_bytes() == b"trained again"


def test_what_no_row_holds_any_more_is_removed(db: Database, here: Settings, first: Claim) -> None:
    for content in (b"one", b"two"):
        save(db, here, first, content)
    stray = f"runs/{first.run_id}/attempt-1/policy-best-000000000000.pt"
    assert here.files_url is not None
    SharedPlace(here.files_url).put_bytes(b"its attempt died before it was registered", stray)

    second = hand_over(db, first)
    begin(db, here, second)

    rows = {row.path for row in list_files(db, first.run_id)}
    blocks = {path for path in shared_paths(here, first.run_id) if "/replay/" in path}
    assert shared_paths(here, first.run_id) == rows | blocks
    assert len(blocks) == 1


def test_an_attempt_that_is_over_spoils_nothing(db: Database, here: Settings, there: Settings, first: Claim) -> None:
    late = begin(db, here, first)
    save(db, there, hand_over(db, first), b"of the second")

    with pytest.raises(StaleFence):
        late.save_file(CHECKPOINT_FILE, KIND, lambda path: write(path, b"late"))

    row = find_file(db, first.run_id, CHECKPOINT_FILE)
    assert b"".join(FileStorage(here).read(row)) == b"of the second"


def test_a_model_trained_elsewhere_is_fetched(db: Database, here: Settings, there: Settings, first: Claim) -> None:
    save(db, here, first, b"weights", "locomotion.pt")
    finish(db, first, Succeeded(1.0))
    waiting = next_claim(db)

    (path,) = find_locomotion_models(db, there, waiting)

    assert path.is_relative_to(there.home)
    assert path.read_bytes() == b"weights"


def test_a_place_out_of_reach_is_trouble_that_may_pass(
    db: Database, here: Settings, first: Claim, tmp_path: Path
) -> None:
    (tmp_path / "shared").write_text("a file where the directory should be")
    (tmp_path / "policy-best.pt").write_bytes(b"weights")
    keeper = FileKeeper(db, FileStorage(here), first, patience_s=0.0)

    with pytest.raises(FilesUnavailable):
        keeper.keep("policy-best.pt", "policy", tmp_path / "policy-best.pt")
    assert list_files(db, first.run_id) == []
