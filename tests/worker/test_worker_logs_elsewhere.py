"""The log of a run goes with it from machine to machine, and what is lost or damaged of it stops no training."""

from __future__ import annotations

import errno
from collections.abc import Callable
from pathlib import Path

import pytest
from two_machines import begin, hand_over, save

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.files import LOG_FILE, FileRow, find_file, list_files
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from sldr_core.training.files import CHECKPOINT_FILE
from worker.claimed_files import ATTEMPT_FILE, send_log
from worker.file_keeper import FileKeeper


def shared_file(settings: Settings, row: FileRow) -> Path:
    assert settings.files_url is not None
    return Path(settings.files_url.removeprefix("file://")) / row.path


def test_the_log_goes_on_where_the_run_goes_on(db: Database, here: Settings, there: Settings, first: Claim) -> None:
    save(db, here, first, b"stored")
    (here.run_directory(first.run_id) / "log.txt").write_text("said here\n")
    send_log(db, here, first)
    second = hand_over(db, first)
    log = there.run_directory(first.run_id) / "log.txt"
    log.parent.mkdir(parents=True)

    with log.open("a") as written_by_the_child:
        begin(db, there, second)
        written_by_the_child.write("said there\n")

    assert log.read_text() == "said here\nsaid there\n"


@pytest.mark.parametrize("damage", [Path.unlink, lambda path: path.write_text("short")], ids=["gone", "damaged"])
def test_a_run_goes_on_without_a_log_that_is_lost(
    db: Database,
    here: Settings,
    there: Settings,
    first: Claim,
    damage: Callable[[Path], object],
    caplog: pytest.LogCaptureFixture,
) -> None:
    save(db, here, first, b"stored")
    (here.run_directory(first.run_id) / LOG_FILE).write_text("said here\n")
    send_log(db, here, first)
    damage(shared_file(here, find_file(db, first.run_id, LOG_FILE)))

    directory = begin(db, there, hand_over(db, first)).directory

    assert (directory / CHECKPOINT_FILE).read_bytes() == b"stored"
    assert "What earlier attempts have said on other machines is lost" in caplog.text


def test_a_log_that_grows_while_it_is_sent_is_one_that_others_can_read(
    db: Database, here: Settings, there: Settings, first: Claim, tmp_path: Path
) -> None:
    class Meanwhile(FileStorage):
        def keep(self, run_id: str, attempt: int, local: Path, sha256: str) -> str:
            with (tmp_path / LOG_FILE).open("a") as log:
                log.write("said meanwhile\n")
            return super().keep(run_id, attempt, local, sha256)

    (tmp_path / LOG_FILE).write_text("said here\n")
    FileKeeper(db, Meanwhile(here), first).keep_log(tmp_path / LOG_FILE)

    assert FileStorage(there).bring(find_file(db, first.run_id, LOG_FILE)).read_text() == "said here\n"
    assert sorted(path.name for path in tmp_path.glob("log*")) == [LOG_FILE]


def test_a_run_does_not_fail_for_a_log_that_cannot_be_copied(
    db: Database, here: Settings, first: Claim, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fill_up(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device", LOG_FILE)

    (tmp_path / LOG_FILE).write_text("said here\n")
    monkeypatch.setattr("shutil.copyfile", fill_up)
    FileKeeper(db, FileStorage(here), first).keep_log(tmp_path / LOG_FILE)

    assert list_files(db, first.run_id) == []


@pytest.mark.parametrize("signature", ["", "\x00"])
def test_a_directory_whose_signature_is_damaged_is_left_behind(
    db: Database, here: Settings, first: Claim, signature: str
) -> None:
    save(db, here, first, b"stored")
    directory = here.run_directory(first.run_id)
    (directory / CHECKPOINT_FILE).write_bytes(b"of nobody knows which attempt")
    (directory / ATTEMPT_FILE).write_text(signature)

    begin(db, here, hand_over(db, first))

    assert (directory / CHECKPOINT_FILE).read_bytes() == b"stored"
