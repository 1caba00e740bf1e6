"""Making room: what a rule names, what it spares, and that a crash in between loses nothing else."""

from __future__ import annotations

import shutil
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from sqlalchemy import Engine, event, update
from store_cases import claim_next, claimed_run, order

from backend.store.actions import Action, act
from backend.store.blocks import EMPTY, put_blocks
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import FilesUnavailable
from backend.store.files import REPLAY_FILE, REPLAY_LIST, list_files, register_file
from backend.store.labels import change_tags
from backend.store.launches import launch
from backend.store.outcomes import Failed, Succeeded
from backend.store.queue import finish
from backend.store.retention import removal
from backend.store.retention.plan import find_protected, is_old_enough, plan_retention
from backend.store.retention.removal import apply_retention, finish_removals
from backend.store.retention.rule import Removable, Rule, kind_of
from backend.store.settings import Settings
from backend.store.storage import FileStorage, SharedPlace, checksum
from backend.store.tables import runs

EVERYTHING = Rule(frozenset(Removable), 0)
REPLAY = Rule(frozenset({Removable.REPLAY}), 0)
WRITTEN = {
    "checkpoint.pt": "checkpoint",
    "policy-newest.pt": "policy",
    "policy-best.pt": "policy",
    "policy-epoch-0004.pt": "policy",
    "locomotion.pt": "locomotion",
    "episodes-00001.npz": "episodes",
    "video-1.mp4": "video",
    "recording-attempt-1.rrd": "recording",
    "thumbnail.webp": "thumbnail",
}
STAYING = {"policy-newest.pt", "policy-best.pt", "locomotion.pt", "thumbnail.webp"}
UNREGISTERED = (REPLAY_FILE, "checkpoint-previous.pt", "log.txt", ".attempt")


def write(settings: Settings, db: Database, held: Claim) -> Path:
    """Let an attempt write everything that one can write; return its directory."""
    directory = settings.run_directory(held.run_id)
    directory.mkdir(parents=True, exist_ok=True)
    storage = FileStorage(settings)
    for name, kind in WRITTEN.items():
        path = directory / name
        path.write_bytes(name.encode() * 100)
        digest = checksum(path)
        place = storage.keep(held.run_id, held.attempt, path, digest)
        register_file(db, held, name, kind, place, path.stat().st_size, digest)
    for name in UNREGISTERED:
        (directory / name).write_bytes(b"x" * 5000)
    return directory


def ended(settings: Settings, db: Database, outcome: Succeeded | Failed | None = None) -> tuple[str, Path]:
    held = claimed_run(db)
    directory = write(settings, db, held)
    finish(db, held, outcome or Succeeded(0.9))
    return held.run_id, directory


def names(directory: Path) -> set[str]:
    return {path.name for path in directory.iterdir()}


def test_a_preview_names_everything_and_changes_nothing(db: Database, settings: Settings):
    run_id, directory = ended(settings, db)
    before = names(directory), list_files(db, run_id)
    plan = plan_retention(db, settings, EVERYTHING)
    (share,) = plan.runs
    going = {file.name for file in share.files}
    assert going == (set(WRITTEN) - STAYING) | {REPLAY_FILE, "checkpoint-previous.pt"}
    count, size = plan.totals()[Removable.EPISODES]
    assert (count, size) == (1, len("episodes-00001.npz") * 100)
    assert share.size == sum(file.size for file in share.files)
    assert (names(directory), list_files(db, run_id)) == before


def count_statements(db: Database, settings: Settings) -> int:
    """Return how many statements a preview asks the store."""
    asked: list[str] = []

    def note(_conn: object, _cursor: object, statement: str, *_: object) -> None:
        asked.append(statement)

    event.listen(Engine, "before_cursor_execute", note)
    try:
        plan_retention(db, settings, EVERYTHING)
    finally:
        event.remove(Engine, "before_cursor_execute", note)
    return len(asked)


def test_a_preview_asks_the_store_no_more_however_many_runs_have_ended(db: Database, settings: Settings):
    ended(settings, db)
    of_one = count_statements(db, settings)
    for _ in range(3):
        ended(settings, db)
    assert len(plan_retention(db, settings, EVERYTHING).runs) == 4
    assert count_statements(db, settings) == of_one


def test_what_a_preview_names_goes_and_nothing_else(db: Database, settings: Settings):
    run_id, directory = ended(settings, db)
    plan = plan_retention(db, settings, EVERYTHING)
    removed = apply_retention(db, settings, plan)
    assert names(directory) == STAYING | {"log.txt", ".attempt"}
    assert {row.name for row in list_files(db, run_id)} == STAYING
    assert (removed.runs, removed.files, removed.size, removed.left) == (
        1,
        len(plan.runs[0].files),
        plan.runs[0].size,
        0,
    )
    assert plan_retention(db, settings, EVERYTHING).runs == []


def test_a_rule_takes_only_its_kinds(db: Database, settings: Settings):
    _, directory = ended(settings, db)
    apply_retention(db, settings, plan_retention(db, settings, REPLAY))
    assert names(directory) == (set(WRITTEN) - {"checkpoint.pt"}) | {"log.txt", ".attempt"}


def test_runs_that_train_wait_are_young_kept_or_needed_lose_nothing(db: Database, settings: Settings):
    locomotion, manipulation = launch(db, order(method="her-sldr"))
    held = claim_next(db)
    write(settings, db, held)
    assert plan_retention(db, settings, REPLAY).runs == []
    finish(db, held, Succeeded(1.0))
    assert plan_retention(db, settings, REPLAY).spared == {"young": 0, "kept": 0, "needed": 1}
    held = claim_next(db)
    write(settings, db, held)
    finish(db, held, Succeeded(1.0))
    assert [share.run_id for share in plan_retention(db, settings, REPLAY).runs] == [manipulation]
    assert plan_retention(db, settings, replace(REPLAY, older_than_days=1)).spared["young"] == 2
    change_tags(db, [manipulation], ["keep"], [])
    assert plan_retention(db, settings, REPLAY).spared == {"young": 0, "kept": 1, "needed": 1}
    act(db, Action.DELETE, manipulation)
    assert [share.run_id for share in plan_retention(db, settings, REPLAY).runs] == [locomotion]


def test_days_are_counted_from_the_end(db: Database, settings: Settings):
    run_id, _ = ended(settings, db)
    with db.write() as conn:
        conn.execute(update(runs).where(runs.c.id == run_id).values(ended_at=datetime.now(UTC) - timedelta(days=30.5)))
    assert plan_retention(db, settings, replace(REPLAY, older_than_days=31)).runs == []
    assert len(plan_retention(db, settings, replace(REPLAY, older_than_days=30)).runs) == 1


def test_a_run_that_was_tagged_or_tried_again_meanwhile_keeps_everything(db: Database, settings: Settings):
    kept, kept_directory = ended(settings, db)
    again, again_directory = ended(settings, db, Failed("It broke.", retry=False))
    plan = plan_retention(db, settings, EVERYTHING)
    change_tags(db, [kept], ["starred"], [])
    act(db, Action.RETRY, again)
    assert apply_retention(db, settings, plan).files == 0
    for run_id, directory in ((kept, kept_directory), (again, again_directory)):
        assert names(directory) == set(WRITTEN) | set(UNREGISTERED)
        assert len(list_files(db, run_id)) == len(WRITTEN)


def test_a_crash_in_between_is_ended_by_the_next_removal(
    db: Database, settings: Settings, monkeypatch: pytest.MonkeyPatch
):
    run_id, directory = ended(settings, db)
    with monkeypatch.context() as patch:
        patch.setattr(removal, "finish_removals", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            apply_retention(db, settings, plan_retention(db, settings, REPLAY))
    assert {row.name for row in list_files(db, run_id)} == set(WRITTEN) - {"checkpoint.pt"}
    assert REPLAY_FILE in names(directory)
    assert finish_removals(db, settings).files == 3
    assert names(directory) == (set(WRITTEN) - {"checkpoint.pt"}) | {"log.txt", ".attempt"}
    assert finish_removals(db, settings).files == 0


def test_what_was_marked_stays_if_its_run_began_again(
    db: Database, settings: Settings, monkeypatch: pytest.MonkeyPatch
):
    run_id, directory = ended(settings, db, Failed("It broke.", retry=False))
    with monkeypatch.context() as patch:
        patch.setattr(removal, "finish_removals", lambda *_: None)
        apply_retention(db, settings, plan_retention(db, settings, REPLAY))
    act(db, Action.RETRY, run_id)
    write(settings, db, claim_next(db))
    assert finish_removals(db, settings).files == 0
    assert names(directory) == set(WRITTEN) | set(UNREGISTERED)


def ended_at_a_shared_place(shared: Settings, db: Database) -> tuple[str, Path]:
    storage = FileStorage(shared)
    assert storage.shared is not None
    held = claimed_run(db)
    directory = write(shared, db, held)
    blocks = put_blocks(storage.shared, directory / REPLAY_FILE, f"runs/{held.run_id}/attempt-1/replay", EMPTY)
    (directory / REPLAY_LIST).write_text(blocks.to_json())
    digest = checksum(directory / REPLAY_LIST)
    place = storage.keep(held.run_id, 1, directory / REPLAY_LIST, digest)
    register_file(db, held, REPLAY_LIST, "replay", place, (directory / REPLAY_LIST).stat().st_size, digest)
    finish(db, held, Succeeded(0.9))
    return held.run_id, directory


def kinds_left(shared: Settings) -> set[str]:
    """Return the first word of the name of each file at the shared place; the name of a block is its checksum."""
    place = FileStorage(shared).shared
    assert place is not None
    return {path.rpartition("/")[2].partition("-")[0] for path in place.paths_below("runs")}


@pytest.fixture
def shared(settings: Settings, tmp_path: Path) -> Settings:
    return replace(settings, files_url=f"file://{tmp_path}/shared")


def test_files_at_a_shared_place_go_with_their_blocks_and_copies(db: Database, shared: Settings):
    _, directory = ended_at_a_shared_place(shared, db)
    plan = plan_retention(db, shared, EVERYTHING)
    removed = apply_retention(db, shared, plan)
    assert kinds_left(shared) == {"policy", "locomotion", "thumbnail"}
    assert names(directory) == STAYING | {"log.txt", ".attempt"}
    assert (removed.files, removed.size) == (len(plan.runs[0].files), plan.runs[0].size)


def test_nothing_is_left_of_what_was_looked_at_from_another_machine(db: Database, shared: Settings):
    run_id, directory = ended_at_a_shared_place(shared, db)
    shutil.rmtree(directory)
    apply_retention(db, shared, plan_retention(db, shared, REPLAY))
    assert "replay" not in kinds_left(shared)
    assert not list((shared.fetched_directory / run_id).iterdir())


def test_a_replay_file_whose_blocks_are_not_known_stays_whole(
    db: Database, shared: Settings, monkeypatch: pytest.MonkeyPatch
):
    _, directory = ended_at_a_shared_place(shared, db)
    shutil.rmtree(directory)  # another machine has trained it
    before = kinds_left(shared)

    def fail(*_: object) -> None:
        raise FilesUnavailable("Slow down.")

    with monkeypatch.context() as patch:
        patch.setattr(SharedPlace, "get", fail)
        assert plan_retention(db, shared, REPLAY).runs == []
        assert apply_retention(db, shared, plan_retention(db, shared, REPLAY)).files == 0
    assert kinds_left(shared) == before
    apply_retention(db, shared, plan_retention(db, shared, REPLAY))
    assert kinds_left(shared) == {name.partition("-")[0].partition(".")[0] for name in WRITTEN} - {"checkpoint"}


def test_no_mark_leads_out_of_the_data_directory(tmp_path: Path):
    (tmp_path / "home").mkdir()
    (tmp_path / "precious").touch()
    (tmp_path / "home" / "link").symlink_to(tmp_path / "precious")
    for place in ("../precious", str(tmp_path / "precious"), "link", ".", "gone"):
        assert not removal._unlink(tmp_path / "home", place)
    assert (tmp_path / "precious").exists()


@hypothesis_settings(max_examples=50)
@given(st.text(max_size=40), st.sampled_from(["policy", "locomotion", "thumbnail", "log", "dump"]))
def test_only_policies_of_epochs_go_of_what_results_are_kept_in(name: str, kind: str):
    found = kind_of(name, kind)
    assert found is None or name == REPLAY_LIST or (kind == "policy" and name.startswith("policy-epoch-"))


def test_a_run_that_has_not_ended_is_never_old():
    assert not is_old_enough(None, REPLAY, datetime.now(UTC))


def test_nothing_is_protected_in_an_empty_store(db: Database):
    with db.read() as conn:
        assert find_protected(conn) == {}
