"""`sldr backup` and `sldr restore`, as typed."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run, use

from backend.store.database import Database, open_database
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim
from backend.store.runs import get_run
from backend.store.settings import Settings, sqlite_url


@pytest.fixture
def run_id(db: Database, settings: Settings, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return a run in the store that the environment names."""
    use(settings, monkeypatch)
    return launch(db, LaunchOrder("FetchPush", "manipulation", "her", [0], "smoke"))[0]


def test_what_was_backed_up_is_restored(
    capsys: pytest.CaptureFixture[str], run_id: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    code, out, err = run(capsys, "backup", str(tmp_path / "kept.tar"))
    assert (code, err) == (0, "")
    assert out.startswith(f"{tmp_path}/kept.tar: 1 runs, 1 files, ")
    elsewhere = Settings(tmp_path / "elsewhere", sqlite_url(tmp_path / "elsewhere"))
    use(elsewhere, monkeypatch)

    code, out, err = run(capsys, "restore", str(tmp_path / "kept.tar"))
    assert (code, err) == (0, "")
    assert out.startswith("Restored 1 runs and 0 files of 20")

    copy = open_database(elsewhere)
    assert get_run(copy, run_id).task == "FetchPush"
    copy.close()


def test_a_second_restore_is_refused_in_one_sentence(capsys: pytest.CaptureFixture[str], run_id: str, tmp_path: Path):
    run(capsys, "backup", str(tmp_path / "kept.tar"))
    code, out, err = run(capsys, "restore", str(tmp_path / "kept.tar"))
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert "replace everything with --overwrite" in err


def test_what_is_missing_in_a_backup_is_named_and_told_by_the_exit_code(
    capsys: pytest.CaptureFixture[str], db: Database, run_id: str, tmp_path: Path
):
    held = claim(db, "worker-1")
    assert held is not None
    register_file(db, held, "policy-best.pt", "policy", f"runs/{run_id}/policy-best.pt", 3, "0" * 64)
    code, out, err = run(capsys, "backup", str(tmp_path / "kept"))
    assert code == 1
    assert "1 runs" in out
    assert err == f"sldr: Left out: {tmp_path}/runs/{run_id}/policy-best.pt is gone.\n"


@pytest.mark.parametrize("engine", ["postgresql"], scope="module")
def test_a_store_out_of_reach_is_told_in_one_sentence(
    capsys: pytest.CaptureFixture[str], settings: Settings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    use(settings, monkeypatch)
    monkeypatch.setenv("SLDR_DATABASE_URL", "postgresql+psycopg://sldr@127.0.0.1:1/sldr")
    code, out, err = run(capsys, "backup", str(tmp_path / "kept"))
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert "cannot be used just now" in err


@pytest.mark.parametrize(
    ("variable", "address"), [("SLDR_DATABASE_URL", "mysql://localhost/sldr"), ("SLDR_FILES_URL", "nowhere://sldr")]
)
def test_an_address_that_cannot_work_keeps_the_service_from_starting(
    capsys: pytest.CaptureFixture[str],
    free_port: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    variable: str,
    address: str,
):
    monkeypatch.setenv("SLDR_HOME", str(tmp_path))
    monkeypatch.setenv(variable, address)
    code, out, err = run(capsys, "serve", "--port", str(free_port))
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert variable in err
