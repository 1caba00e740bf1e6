"""Commands that ask a service instead of the store: what they print is the same."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from live_api import Service
from store_samples import SampleSize, fill_store

from backend.api.server_mark import marked
from backend.client.records.runs import RunDetail
from worker.cli import main
from worker.cli.service.server import ServerService

ONE = ("launch", "--task", "FetchPush", "--method", "her-sldr", "--preset", "smoke", "--seeds", "0-1")
STUDY = ("launch", "--study", "both", "--task", "FetchPush", "--method", "her", "--method", "ddpg", "--preset", "smoke")
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def command(service: Service, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Return a way to run a command on a machine that has no store of its own."""
    monkeypatch.setenv("SLDR_HOME", "/nonexistent")
    monkeypatch.setenv("SLDR_TOKEN", service.client.headers.get("Authorization", "").removeprefix("Bearer "))
    monkeypatch.delenv("SLDR_DATABASE_URL", raising=False)

    def run(*arguments: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as ended:
            main(arguments)
        printed = capsys.readouterr()
        assert isinstance(ended.value.code, int)
        return ended.value.code, printed.out, printed.err

    return run


@pytest.fixture
def server(service: Service) -> tuple[str, str]:
    return "--server", str(service.client.base_url).rstrip("/")


def without_ids(text: str) -> str:
    return re.sub(r"\b[0-9a-f]{12}\b", "ID", text)


def test_a_launch_prints_the_same_either_way(
    command: Run, server: tuple[str, str], service: Service, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    far = [command(*words, *server) for words in ((*ONE, "--dry-run"), ONE, (*STUDY, "--dry-run"), STUDY)]
    assert service.get("/api/runs")["total"] == 5
    monkeypatch.setenv("SLDR_HOME", str(tmp_path / "other"))
    here = [command(*words) for words in ((*ONE, "--dry-run"), ONE, (*STUDY, "--dry-run"), STUDY)]
    assert [without_ids(out) for _, out, _ in far] == [without_ids(out) for _, out, _ in here]
    assert {code for code, _, _ in (*far, *here)} == {0}
    listed = [command("runs", *options)[1] for options in (server, ())]
    assert without_ids(listed[0]) == without_ids(listed[1])
    documents = [json.loads(command("runs", "--json", *options)[1]) for options in (server, ())]
    assert set(documents[0][0]) == set(documents[1][0])
    assert [run["config"] for run in documents[0]] == [run["config"] for run in documents[1]]


def test_a_service_over_this_data_directory_is_asked_by_itself(
    command: Run, service: Service, server: tuple[str, str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("SLDR_HOME", str(service.settings.home))
    monkeypatch.setattr("worker.cli.service.store.open_database", None)  # the store itself is not opened
    with marked(service.settings, server[1]):
        assert command(*ONE)[0] == 0
    assert service.get("/api/runs")["total"] == 3


def test_waiting_tells_every_change_and_the_end(
    command: Run, server: tuple[str, str], service: Service, monkeypatch: pytest.MonkeyPatch
):
    def cancel_first(self: ServerService, run_id: str) -> RunDetail:
        run_ids = [run["id"] for run in service.get("/api/runs")["runs"]]
        service.client.post("/api/runs/actions", json={"action": "cancel", "run_ids": run_ids})
        return get_run(self, run_id)

    get_run = ServerService.get_run
    monkeypatch.setattr(ServerService, "get_run", cancel_first)
    code, out, _ = command(*ONE, "--wait", *server)
    told = [line for line in out.splitlines() if " is cancelled: " in line]
    assert (code, len(told), out.splitlines()[-1]) == (1, 3, "0 of 3 runs succeeded.")
    code, _, err = command(*ONE, "--wait", "--dry-run", *server)
    assert (code, "a dry run queues nothing" in err) == (2, True)


def test_what_a_service_refuses_is_its_own_sentence(command: Run, server: tuple[str, str], free_port: int):
    code, out, err = command("launch", "--task", "FetchPus", *server)
    assert (code, out, "Did you mean 'FetchPush'?" in err) == (2, "", True)
    code, _, err = command("runs", "--server", "nonsense")
    assert (code, "is no address of a service" in err) == (2, True)


def test_exports_come_from_the_service(command: Run, server: tuple[str, str], service: Service, tmp_path: Path):
    fill_store(service.database, SampleSize(tasks=("FetchPush",), methods=("her",), seeds=3, epochs=4))
    out = tmp_path / "curves.csv"
    assert command("export", "figure", "--out", str(out), "--x", "env_steps", *server)[0] == 0
    assert out.read_text().splitlines()[1].startswith("FetchPush")
    code, printed, _ = command("export", "tensorboard", "--out", str(tmp_path), *server)
    assert (code, len(printed.splitlines())) == (0, 3)
    assert len(list(tmp_path.glob("FetchPush/**/events.out.*"))) == 3
    code, _, err = command("export", "rerun", "0123456789ab", str(tmp_path / "run.rrd"), *server)
    assert (code, "There is no run" in err) == (2, True)
    code, _, err = command("export", "tensorboard", "--out", str(tmp_path), "--task", "FetchSlide", *server)
    assert (code, "none passes" in err) == (2, True)
    for option, name in (("--metric", "test/succes"), ("--run", "0123456789ab"), ("--method", "hre")):
        code, _, err = command("export", "figure", "--out", str(tmp_path / "none.csv"), option, name, *server)
        assert (code, f"'{name}'" in err, (tmp_path / "none.csv").exists()) == (2, True, False), err
