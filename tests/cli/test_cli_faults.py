"""What goes wrong around a command - the data directory, the store, the disk, the reader - is told in one sentence."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import run, use

from backend.store.settings import Settings, sqlite_url
from sldr_core.errors import DiskTooFull
from worker.cli.commands import export

PATIENCE_S = 120.0
AWAY = "postgresql+psycopg://sldr@127.0.0.1:1/sldr"


def ended(arguments: list[str], settings: Settings) -> subprocess.CompletedProcess[str]:
    """Run a program of the service in a process of its own, to its end."""
    return subprocess.run(
        [sys.executable, "-m", *arguments],
        env={**os.environ, **settings.as_environment()},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


@pytest.mark.parametrize("program", ["worker", "worker.viewer"])
def test_a_data_directory_that_cannot_be_made_is_named(program: str, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    home = tmp_path / "file" / "home"

    done = ended([program], Settings(home, sqlite_url(tmp_path)))

    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert f"{home / 'logs'}: Not a directory." in done.stderr


def test_a_viewer_whose_store_is_away_says_so(tmp_path: Path) -> None:
    done = ended(["worker.viewer"], Settings(tmp_path, AWAY))

    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert done.stderr.startswith("The store cannot be used just now: ")


def test_a_port_that_there_cannot_be_is_refused_by_the_viewer(tmp_path: Path) -> None:
    done = ended(["worker.viewer", "--policy", "policy.pt", "--port", "70000"], Settings(tmp_path, AWAY))

    assert (done.returncode, done.stderr) == (2, "port: it must be between 0 and 65535, got 70000\n")


def test_a_damaged_store_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "sldr.db").write_bytes(b"no database" * 100)
    use(Settings(tmp_path, sqlite_url(tmp_path)), monkeypatch)

    code, out, err = run(capsys, "runs")

    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert "The store is damaged (file is not a database)" in err


def test_a_full_disk_leaves_the_figure_that_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fill_up(path: Path, content: bytes) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    out = tmp_path / "figure.csv"
    out.write_text("the old one")
    monkeypatch.setattr(Path, "write_bytes", fill_up)

    with pytest.raises(DiskTooFull, match=r"There is no room for .*figure\.csv"):
        export._write(out, b"the new one")
    assert out.read_text() == "the old one"


@pytest.mark.parametrize("words", [["list", "models", "--json"], ["launch", "--help"], ["--help"]])
def test_whoever_reads_no_further_is_not_told_of_it(words: list[str], tmp_path: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "worker.cli", *words],
        env={**os.environ, **Settings(tmp_path, sqlite_url(tmp_path)).as_environment()},
        stdout=writer,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    os.close(writer)

    assert (done.returncode, done.stderr) == (141, "")


def test_a_full_disk_behind_what_is_printed_is_told_in_a_sentence(tmp_path: Path) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "worker.cli", "list", "models", "--json"],
            env={**os.environ, **Settings(tmp_path, sqlite_url(tmp_path)).as_environment()},
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )

    assert (done.returncode, done.stderr) == (
        2,
        "sldr: What it says could not be written out (No space left on device).\n",
    )
