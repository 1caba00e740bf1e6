"""A backup holds everything, whole, and comes back into a store of either engine and files at either kind of place."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from size_limit import no_file_longer_than
from sqlalchemy import select
from store_cases import claim_next, order, step
from store_engines import Stores

from backend.store.backups.archive import LIST_FILE
from backend.store.backups.make import BackupReport, make_backup
from backend.store.backups.restore import RestoreReport, restore_backup
from backend.store.claims import Claim
from backend.store.database import Database, open_database
from backend.store.errors import StaleFence, WouldOverwrite
from backend.store.files import REPLAY_FILE, list_files, register_file
from backend.store.launches import launch
from backend.store.metrics import MetricPoint, append_metrics, read_metrics
from backend.store.outcomes import Failed, Succeeded
from backend.store.queue import finish
from backend.store.runs import get_run, list_events
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.storage import FileStorage, checksum
from backend.store.tables import metadata
from backend.store.webhooks import add_webhook, plan_deliveries
from backend.store.workers import register_worker
from backend.webhooks.messages import body_of
from sldr_core.errors import BadFile, DiskTooFull

SETTLED = {"runs", "attempts", "run_events", "run_files", "workers", "viewer_hosts", "viewer_sessions"}
"""Tables whose rows a restore may change, so that nothing is in anybody's hands."""
LARGE = 3 * 2**20
"""Length of a file that does not fit; the store itself is smaller [bytes]."""


def silent(sentence: str) -> None:
    """Tell nobody."""


def backup(settings: Settings, target: Path, overwrite: bool = False) -> BackupReport:
    return make_backup(settings, target, overwrite, silent)


def restore(settings: Settings, source: Path, overwrite: bool = False) -> RestoreReport:
    return restore_backup(settings, source, overwrite, silent)


def write(db: Database, settings: Settings, held: Claim, name: str, content: bytes, kind: str = "policy") -> None:
    """Write and register a file as a training does."""
    path = settings.run_directory(held.run_id) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    place = FileStorage(settings).keep(held.run_id, held.attempt, path, checksum(path))
    register_file(db, held, name, kind, place, len(content), checksum(path))


def log(db: Database, held: Claim, *cycles: int) -> None:
    append_metrics(db, held, [MetricPoint(step(cycle), {"train/success_rate": cycle / 100}) for cycle in cycles])


def rows_of(settings: Settings) -> dict[str, list[dict[str, Any]]]:
    """Return every row of every table that a restore leaves alone."""
    db = open_database(settings)
    with db.read() as conn:
        tables = [table for table in metadata.sorted_tables if table.name not in SETTLED]
        rows = {table.name: [dict(row) for row in conn.execute(select(table)).mappings()] for table in tables}
    db.close()
    return {name: sorted(found, key=repr) for name, found in rows.items()}


@pytest.fixture
def filled(db: Database, settings: Settings) -> Claim:
    """Fill a store with a succeeded run, one that is trained, and one that waits for it; return the second."""
    done, running, _ = launch(db, order()) + launch(db, order(method="her-sldr"))
    first = claim_next(db)
    assert first.run_id == done
    log(db, first, 1, 2)
    write(db, settings, first, "policy-best.pt", b"best of the first")
    finish(db, first, Succeeded(0.5))
    second = claim_next(db)
    assert second.run_id == running
    log(db, second, *range(1, 8))
    write(db, settings, second, "policy-best.pt", b"best of the second")
    write(db, settings, second, "checkpoint.pt", b"cycle 5", "checkpoint")
    (settings.run_directory(running) / REPLAY_FILE).write_bytes(b"episodes")
    (settings.run_directory(running) / "log.txt").write_text("said\n")
    return second


def kill_restore(settings: Settings, run_id: str) -> None:
    """Leave a data directory as a restore that was killed while it copied files."""
    settings.runs_directory.rename(settings.home / ".runs.replaced")
    settings.run_directory(run_id).mkdir(parents=True)
    (settings.run_directory(run_id) / "policy-best.pt").write_bytes(b"half of it")


def policy_of(settings: Settings, held: Claim) -> bytes:
    return (settings.run_directory(held.run_id) / "policy-best.pt").read_bytes()


@pytest.fixture(params=["sqlite", "postgresql"])
def target(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Settings]:
    """Return an empty data directory with a store on either engine."""
    stores: Stores = request.getfixturevalue(f"{'sqlite' if request.param == 'sqlite' else 'postgres'}_stores")
    home = tmp_path / "restored"
    home.mkdir()
    with stores.fresh(home, empty=True) as settings:
        yield settings


def test_every_row_and_every_file_comes_back(
    filled: Claim, settings: Settings, target: Settings, tmp_path: Path
) -> None:
    report = backup(settings, tmp_path / "kept.tar")

    restored = restore(target, tmp_path / "kept.tar")

    assert (report.runs, report.left_out, restored.runs, restored.queued_again) == (3, (), 3, 1)
    assert rows_of(target) == rows_of(settings)
    db = open_database(target)
    files = [row for run_id in read_run_ids(db) for row in list_files(db, run_id)]
    assert {FileStorage(target).bring(row).read_bytes() for row in files} == {
        b"best of the first",
        b"best of the second",
        b"cycle 5",
    }
    assert (target.run_directory(filled.run_id) / REPLAY_FILE).read_bytes() == b"episodes"
    assert (target.run_directory(filled.run_id) / "log.txt").read_text() == "said\n"
    db.close()


def read_run_ids(db: Database) -> list[str]:
    with db.read() as conn:
        return list(conn.execute(select(metadata.tables["runs"].c.id)).scalars())


def test_a_run_that_was_trained_then_is_queued_and_its_old_attempt_refused(
    filled: Claim, settings: Settings, tmp_path: Path
) -> None:
    backup(settings, tmp_path / "kept")
    restore(settings, tmp_path / "kept", overwrite=True)

    db = open_database(settings)
    assert get_run(db, filled.run_id).state is RunState.QUEUED
    assert "restored from a backup" in (list_events(db, filled.run_id)[-1].detail or "")
    again = claim_next(db)
    assert (again.run_id, again.attempt) == (filled.run_id, 2)
    assert again.fence > filled.fence + 1
    with pytest.raises(StaleFence):
        log(db, filled, 8)
    log(db, again, 6)
    assert read_metrics(db, filled.run_id).step == [1, 2, 3, 4, 5, 6]
    launch(db, order(seeds=(9,)))
    db.close()


def test_a_store_that_is_used_is_not_overwritten_unless_asked(
    db: Database, filled: Claim, settings: Settings, tmp_path: Path
) -> None:
    backup(settings, tmp_path / "kept")
    before = rows_of(settings)
    launch(db, order(seeds=(1, 2)))

    with pytest.raises(WouldOverwrite, match="holds runs already"):
        restore(settings, tmp_path / "kept")
    assert restore(settings, tmp_path / "kept", overwrite=True).runs == 3
    assert rows_of(settings) == before


@pytest.mark.parametrize("engine", ["sqlite"], scope="module")
class TestOnOneEngine:
    """What does not hang on the engine."""

    def test_a_backup_can_be_compressed(self, filled: Claim, settings: Settings, tmp_path: Path) -> None:
        backup(settings, tmp_path / "kept.tar.gz")

        assert restore(settings, tmp_path / "kept.tar.gz", overwrite=True).runs == 3

    def test_a_worker_at_work_keeps_a_store_from_being_replaced(
        self, db: Database, settings: Settings, tmp_path: Path
    ) -> None:
        backup(settings, tmp_path / "kept")
        register_worker(db, "here", 123, 1)

        with pytest.raises(WouldOverwrite, match=r"A worker is alive on here .process 123"):
            restore(settings, tmp_path / "kept", overwrite=True)

    def test_a_backup_is_not_overwritten_unless_asked(self, filled: Claim, settings: Settings, tmp_path: Path) -> None:
        backup(settings, tmp_path / "kept")

        with pytest.raises(WouldOverwrite, match="add --overwrite"):
            backup(settings, tmp_path / "kept")
        assert backup(settings, tmp_path / "kept", overwrite=True).runs == 3
        assert sorted(path.name for path in tmp_path.iterdir() if "kept" in path.name) == ["kept"]

    @pytest.mark.parametrize(
        ("limit", "name"), [(LARGE // 2, "kept"), (LARGE + 2**16, "kept.tar")], ids=["copy", "pack"]
    )
    def test_a_backup_that_does_not_fit_is_told_in_a_sentence_and_leaves_nothing(
        self, db: Database, filled: Claim, settings: Settings, tmp_path: Path, limit: int, name: str
    ) -> None:
        write(db, settings, filled, "policy-latest.pt", b"0" * LARGE)

        with no_file_longer_than(limit), pytest.raises(DiskTooFull, match=f"no room for the backup {name} in"):
            backup(settings, tmp_path / name)
        assert [path.name for path in tmp_path.iterdir() if "kept" in path.name] == []

    def test_a_backup_that_was_killed_while_it_replaced_another_is_no_hindrance(
        self, settings: Settings, tmp_path: Path
    ) -> None:
        backup(settings, tmp_path / "kept")
        (tmp_path / ".kept.replaced" / "runs").mkdir(parents=True)

        backup(settings, tmp_path / "kept", overwrite=True)
        assert sorted(path.name for path in tmp_path.iterdir() if "kept" in path.name) == ["kept"]

    def test_a_restore_that_was_killed_is_made_again(self, filled: Claim, settings: Settings, tmp_path: Path) -> None:
        backup(settings, tmp_path / "kept")
        kill_restore(settings, filled.run_id)

        assert restore(settings, tmp_path / "kept", overwrite=True).runs == 3
        assert policy_of(settings, filled) == b"best of the second"
        assert [path.name for path in settings.home.iterdir() if path.name.startswith(".runs")] == []

    def test_a_restore_that_does_not_fit_brings_back_what_a_killed_one_had_set_aside(
        self, db: Database, filled: Claim, settings: Settings, tmp_path: Path
    ) -> None:
        write(db, settings, filled, "policy-latest.pt", b"0" * LARGE)
        backup(settings, tmp_path / "kept")
        write(db, settings, filled, "policy-best.pt", b"best since then")
        kill_restore(settings, filled.run_id)

        with no_file_longer_than(LARGE // 2), pytest.raises(DiskTooFull, match="no room for what is restored"):
            restore(settings, tmp_path / "kept", overwrite=True)
        assert policy_of(settings, filled) == b"best since then"

    def test_what_is_no_backup_is_never_replaced(self, settings: Settings, tmp_path: Path) -> None:
        (tmp_path / "thesis").mkdir()
        (tmp_path / "thesis" / "chapter-1.tex").touch()

        with pytest.raises(WouldOverwrite, match="is no backup; choose another name"):
            backup(settings, tmp_path / "thesis", overwrite=True)

    def test_a_damaged_file_is_named_and_left_out(self, filled: Claim, settings: Settings, tmp_path: Path) -> None:
        (settings.run_directory(filled.run_id) / "policy-best.pt").write_bytes(b"flipped bits")

        report = backup(settings, tmp_path / "kept")

        (sentence,) = report.left_out
        assert f"policy-best.pt of run {filled.run_id} is not what was registered" in sentence
        assert not (tmp_path / "kept" / "runs" / filled.run_id / "policy-best.pt").exists()

    def test_a_damaged_backup_changes_nothing(self, filled: Claim, settings: Settings, tmp_path: Path) -> None:
        backup(settings, tmp_path / "kept")
        (tmp_path / "kept" / "runs" / filled.run_id / "checkpoint.pt").write_bytes(b"cycle 6")
        (tmp_path / "empty").mkdir()

        with pytest.raises(BadFile, match=r"checkpoint.pt in .* is damaged"):
            restore(Settings(tmp_path / "empty", f"sqlite:///{tmp_path}/empty/sldr.db"), tmp_path / "kept")
        assert not (tmp_path / "empty" / "runs").exists()

    def test_a_backup_that_was_broken_off_is_told_from_a_whole_one(
        self, filled: Claim, settings: Settings, tmp_path: Path
    ) -> None:
        backup(settings, tmp_path / "kept")
        (tmp_path / "kept" / LIST_FILE).unlink()

        with pytest.raises(BadFile, match="is no whole backup"):
            restore(settings, tmp_path / "kept", overwrite=True)

    def test_a_file_that_is_no_archive_is_named(self, settings: Settings, tmp_path: Path) -> None:
        (tmp_path / "kept.tar").write_text("no tar")

        with pytest.raises(BadFile, match=r"kept.tar cannot be unpacked"):
            restore(settings, tmp_path / "kept.tar")

    def test_a_backup_of_a_newer_program_is_named(self, settings: Settings, tmp_path: Path) -> None:
        backup(settings, tmp_path / "kept")
        contents = json.loads((tmp_path / "kept" / LIST_FILE).read_text())
        (tmp_path / "kept" / LIST_FILE).write_text(json.dumps({**contents, "format": 99, "version": "9.0"}))

        with pytest.raises(BadFile, match=r"made by version 9\.0, which is newer"):
            restore(settings, tmp_path / "kept")

    def test_a_backup_is_a_data_directory(self, filled: Claim, settings: Settings, tmp_path: Path) -> None:
        backup(settings, tmp_path / "kept")
        unpacked = Settings(tmp_path / "kept", f"sqlite:///{tmp_path}/kept/sldr.db")

        db = open_database(unpacked)
        assert {row.name for row in list_files(db, filled.run_id)} == {"checkpoint.pt", "policy-best.pt"}
        assert all(FileStorage(unpacked).bring(row) for row in list_files(db, filled.run_id))
        db.close()

    def test_what_was_told_before_the_backup_is_not_told_again(
        self, db: Database, settings: Settings, tmp_path: Path
    ) -> None:
        add_webhook(db, "https://a.example/", ["run_failed"])
        launch(db, order())
        finish(db, claim_next(db), Failed("It broke.", retry=False))
        assert plan_deliveries(db, body_of) == 1
        backup(settings, tmp_path / "kept")
        restore(settings, tmp_path / "kept", overwrite=True)

        restored = open_database(settings)
        assert plan_deliveries(restored, body_of) == 0
        restored.close()
