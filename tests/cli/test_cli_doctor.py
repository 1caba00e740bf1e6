"""`sldr doctor`: each look on its own, and the command as typed."""

from __future__ import annotations

import errno
import json
import socket
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import NoReturn

import pytest
from command_line import run, use

from backend.api.server_mark import marked
from backend.store.database import Database, open_database
from backend.store.inspection import StoreState, inspect_store
from backend.store.settings import Settings, sqlite_url
from backend.store.workers import register_worker, set_draining
from worker.doctor import machine
from worker.doctor.data import describe_store, look_at_files, look_at_home, look_at_store, look_at_workers
from worker.doctor.installation import compare_versions, look_at_page, look_at_versions
from worker.doctor.machine import describe_disk, describe_gpus, look_at_gpu, look_at_port, look_at_renderer
from worker.machine import DriverSilent, Gpu


def test_versions_here_are_those_that_were_tested():
    assert look_at_versions().standing == "ok"


def test_other_and_missing_versions_are_named():
    def installed(name: str) -> str:
        if name == "gone":
            raise PackageNotFoundError(name)
        return {"torch": "2.13.0+cpu", "numpy": "2.0.0"}[name]

    assert compare_versions(["torch==2.13.0"], installed).standing == "ok"
    other = compare_versions(["torch==2.13.0", "numpy==2.4.6", "gone==1; extra == 'test'"], installed)
    assert (other.standing, "numpy 2.0.0 instead of 2.4.6" in other.told) == ("poor", True)
    missing = compare_versions(["gone[x]==1", "numpy==2.4.6"], installed)
    assert (missing.standing, missing.told) == ("wrong", "Packages are missing: gone.")


def test_a_page_that_is_not_built_is_missed(tmp_path: Path):
    assert look_at_page(tmp_path / "index.html").standing == "wrong"
    (tmp_path / "index.html").touch()
    assert look_at_page(tmp_path / "index.html").standing == "ok"


@pytest.mark.parametrize(
    ("free", "nodes", "standing"),
    [
        (10**8, None, "wrong"),
        (10**10, None, "poor"),
        (10**11, None, "ok"),
        (10**11, 500, "poor"),
        (10**11, 10**6, "ok"),
    ],
)
def test_room_on_the_disk_is_judged(free: int, nodes: int | None, standing: str):
    found = describe_disk(Path("/data"), free, 10**12, nodes)
    assert found.standing == standing
    assert bool(found.mend) == (standing != "ok")


@pytest.mark.parametrize(
    ("gpus", "torch", "driver", "standing"),
    [
        ([Gpu("0", "H100")], "2.13.0", True, "ok"),
        ([], "2.13.0+cpu", False, "ok"),
        ([], "2.13.0+cpu", True, "poor"),
        ([], "2.13.0", True, "poor"),
    ],
)
def test_a_driver_without_use_is_pointed_out(gpus: list[Gpu], torch: str, driver: bool, standing: str):
    assert describe_gpus(gpus, torch, driver).standing == standing


@pytest.mark.parametrize("visible", ["", "MIG-4ad5e0"])
def test_the_variable_that_hides_cards_is_named(visible: str):
    assert f"CUDA_VISIBLE_DEVICES is '{visible}'" in describe_gpus([], "2.13.0", True, visible).told


def test_a_driver_that_does_not_answer_is_told(monkeypatch: pytest.MonkeyPatch):
    def ask_in_vain() -> list[Gpu]:
        raise DriverSilent("The NVIDIA driver does not answer.")

    monkeypatch.setattr(machine, "ask_for_gpus", ask_in_vain)
    found = look_at_gpu()
    assert (found.standing, found.told) == ("poor", "The NVIDIA driver does not answer.")


def test_a_renderer_that_fails_or_hangs_is_told(monkeypatch: pytest.MonkeyPatch):
    assert look_at_renderer((sys.executable, "-c", "")).standing == "ok"
    failed = look_at_renderer((sys.executable, "-c", "raise OSError('libEGL is not there')"))
    assert (failed.standing, "libEGL is not there" in failed.told) == ("poor", True)
    assert "apt-get install" in failed.mend
    monkeypatch.setattr(machine, "DRAWN_WITHIN_S", 0.05)
    assert look_at_renderer((sys.executable, "-c", "import time; time.sleep(60)")).standing == "wrong"


def test_a_port_is_free_taken_or_ours(free_port: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SLDR_HOME", str(tmp_path))
    assert look_at_port("127.0.0.1", free_port).standing == "ok"
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", free_port))
        taken.listen()
        found = look_at_port("127.0.0.1", free_port)
        assert (found.standing, f"--port {free_port + 1}" in found.mend) == ("wrong", True)
        with marked(Settings(tmp_path, sqlite_url(tmp_path)), f"http://127.0.0.1:{free_port}"):
            assert look_at_port("127.0.0.1", free_port).standing == "ok"


def test_a_data_directory_is_written_and_its_token_kept_private(tmp_path: Path):
    assert look_at_home(tmp_path / "new").standing == "ok"
    (tmp_path / "file").touch()
    assert look_at_home(tmp_path / "file").standing == "wrong"
    (tmp_path / "access-token").touch(mode=0o644)
    assert look_at_home(tmp_path).mend == f"chmod 600 {tmp_path / 'access-token'}"


def test_a_store_is_looked_at_and_not_changed(tmp_path: Path):
    settings = Settings(tmp_path / "home", sqlite_url(tmp_path))
    assert inspect_store(settings).revision is None
    assert list(tmp_path.iterdir()) == []
    open_database(settings).close()
    state = inspect_store(settings)
    assert (state.engine, state.revision) == ("sqlite", state.expected)


@pytest.mark.parametrize(("revision", "standing"), [(None, "ok"), ("0007", "ok"), ("0003", "poor"), ("0009", "wrong")])
def test_the_revision_of_tables_is_judged(revision: str | None, standing: str):
    assert describe_store(StoreState("sqlite", revision, "0007"), "the store").standing == standing


def test_a_drained_worker_does_not_count(db: Database, settings: Settings):
    drained, taking = (register_worker(db, "here", pid, slots=2) for pid in (1, 2))
    set_draining(db, drained, True)
    assert look_at_workers(settings).told == "1 alive, for 2 runs at once, besides 1 drained."
    set_draining(db, taking, True)
    assert look_at_workers(settings).standing == "poor"


def test_addresses_that_cannot_work_are_told(tmp_path: Path):
    assert look_at_store(Settings(tmp_path, "mysql://box/sldr")).standing == "wrong"
    away = look_at_store(Settings(tmp_path, "postgresql+psycopg://u:secret@127.0.0.1:1/sldr"))
    assert (away.standing, "secret" in away.told) == ("wrong", False)
    assert look_at_files(Settings(tmp_path, sqlite_url(tmp_path), "nonsense://place")).standing == "wrong"
    assert look_at_files(Settings(tmp_path, sqlite_url(tmp_path), f"file://{tmp_path}/shared")).standing == "ok"


def test_the_command_prints_for_people_and_programs(
    capsys: pytest.CaptureFixture[str], settings: Settings, monkeypatch: pytest.MonkeyPatch, free_port: int
):
    use(settings, monkeypatch)
    monkeypatch.setattr("worker.cli.commands.doctor.look_at_renderer", lambda: machine.ok("drawing", "It draws."))
    monkeypatch.setattr("worker.cli.commands.doctor.look_at_page", lambda: machine.wrong("page", "None.", "make web"))
    code, lines, _ = run(capsys, "doctor", "--port", str(free_port))
    assert code == 1
    assert "WRONG  page      None.\n                 To mend it: make web\n" in lines
    assert f"ok     port      Port {free_port} of 127.0.0.1 is free." in lines
    code, out, _ = run(capsys, "doctor", "--port", str(free_port), "--json")
    found = {finding["name"]: finding["standing"] for finding in json.loads(out)}
    assert (code, found["page"], found["store"], found["workers"]) == (1, "wrong", "ok", "poor")
    assert len(found) == 10


def test_an_empty_data_directory_stays_empty(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    home = tmp_path / "home"
    use(Settings(home, sqlite_url(home)), monkeypatch)
    monkeypatch.setattr("worker.cli.commands.doctor.look_at_renderer", lambda: machine.ok("drawing", "It draws."))
    _, out, _ = run(capsys, "doctor")
    assert "No worker is alive" in out
    assert not home.exists()


def test_a_look_that_breaks_down_is_a_finding_and_the_others_go_on(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def refuse(home: Path) -> NoReturn:
        raise PermissionError(errno.EACCES, "Permission denied", str(home))

    def miss() -> NoReturn:
        raise PackageNotFoundError("torch")

    (tmp_path / "sldr.db").write_bytes(b"no database" * 100)
    use(Settings(tmp_path, sqlite_url(tmp_path)), monkeypatch)
    monkeypatch.setattr("worker.cli.commands.doctor.look_at_disk", refuse)
    monkeypatch.setattr("worker.cli.commands.doctor.look_at_gpu", miss)
    monkeypatch.setattr("worker.cli.commands.doctor.look_at_renderer", lambda: machine.ok("drawing", "It draws."))
    code, out, _ = run(capsys, "doctor", "--port", "70000")
    assert code == 1
    for line in (
        f"WRONG  disk      {tmp_path}: Permission denied.",
        "WRONG  store     The store is damaged (file is not a database)",
        "WRONG  port      There is no port 70000.",
        "WRONG  GPU       Looking at it ended with PackageNotFoundError: No package metadata was found for torch.",
        "ok     drawing   It draws.",
    ):
        assert line in out
