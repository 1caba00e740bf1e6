"""The typed client against a service that really listens: what it asks, what it answers, how it fails."""

from __future__ import annotations

import fcntl
import hashlib
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import httpx
import numpy as np
import pytest
from live_api import Service

from backend.api.app import create_app
from backend.api.server_mark import local_url, marked
from backend.client import BadAnswer, Client, ClientError, NotReachable, NotThere, StillGoing, Unfit
from backend.client.access import BadUrl, find_local_server, find_token, find_url
from backend.client.connection import Connection
from backend.client.curves import MetricBatch, join_batches
from backend.client.records import comparisons, runs, service, studies
from backend.figures.drawing import DRAWING_S
from backend.store.files import register_file
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Failed
from backend.store.queue import finish
from backend.store.settings import Settings, sqlite_url
from sldr_core.records import Step

PLAIN: dict[str, Any] = {"task": "FetchPush", "method": "her", "preset": "smoke"}


@pytest.fixture
def client(service: Service) -> Iterator[Client]:
    """Return a client of an empty service."""
    token = service.client.headers.get("Authorization", "").removeprefix("Bearer ")
    with Client(str(service.client.base_url), token or None) as client:
        yield client


def test_runs_are_launched_found_and_ended(client: Client, service: Service):
    planned = client.runs.plan(**PLAIN, seeds=[0, 1])
    assert [(run.phase, run.seed, run.reused_run_id) for run in planned] == [
        ("manipulation", 0, None),
        ("manipulation", 1, None),
    ]
    launched = client.runs.launch(**PLAIN, seeds=[0, 1], settings={"loop": {"batch_size": 32}})
    assert client.runs.get(launched[0]).config["loop"]["batch_size"] == 32
    assert [run.seed for run in client.runs.find(task="FetchPush", state=["queued", "running"])] == [1, 0]
    assert client.runs.find(task="FetchSlide") == []
    client.runs.tag(launched, add=["mine"])
    client.runs.note(launched[0], "as in the talk")
    assert client.runs.get(launched[0].id).notes == "as in the talk"
    assert [run.id for run in client.runs.find(tag="mine", limit=1)] == [launched[1].id]
    assert [(result.run_id, result.done) for result in client.runs.cancel(launched)] == [
        (run.id, True) for run in launched
    ]
    seen: list[str] = []
    ended = client.runs.wait(launched, timeout_s=60.0, on_change=lambda run: seen.append(run.state))
    assert (seen, [run.state for run in ended]) == (["cancelled"] * 2, ["cancelled"] * 2)
    assert [event.event for event in client.runs.events(launched[0])] == ["created", "cancelled"]


def test_long_lists_come_page_by_page(client: Client, service: Service, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("backend.client.runs.PAGE", 2)
    service.launch(seeds=tuple(range(5)))
    assert [run.seed for run in client.runs.find()] == [4, 3, 2, 1, 0]
    assert [run.seed for run in client.runs.find(limit=3)] == [4, 3, 2]


def test_metrics_come_as_arrays(client: Client, service: Service):
    (run_id,) = service.launch()
    held = service.claim()
    steps = [Step(cycle, 1, 100 * cycle, 2 * cycle, 40 * cycle, 0.5 * cycle) for cycle in (1, 2, 3)]
    values = [{"a/b": 1.5}, {"a/b": 2.5, "test/success_rate": 0.25}, {"a/b": 3.5}]
    append_metrics(service.database, held, [MetricPoint(*pair) for pair in zip(steps, values, strict=True)])
    found = client.runs.metrics(run_id)
    assert len(found) == 3
    np.testing.assert_array_equal(found.values["test/success_rate"], [np.nan, 0.25, np.nan])
    where, what = found.curve("test/success_rate", over="env_steps")
    assert (where.tolist(), what.tolist()) == ([200.0], [0.25])
    assert set(client.runs.metrics(run_id, ["a/b"]).values) == {"a/b"}
    with pytest.raises(ClientError, match="has no metric 'a/c'; it has a/b"):
        found.curve("a/c")


def test_batches_need_not_know_the_same_metrics():
    common = {"epoch": [1], "env_steps": [1], "episodes": [1], "updates": [1], "wall_seconds": [1.0]}
    first = MetricBatch(cursor=1, step=[1], values={"a": [1.0]}, **common)
    second = MetricBatch(cursor=2, step=[2], values={"b": [None]}, **common)
    joined = join_batches("r", [first, second], None)
    np.testing.assert_array_equal(joined.values["a"], [1.0, np.nan])
    np.testing.assert_array_equal(joined.values["b"], [np.nan, np.nan])


def test_files_are_checked_against_their_checksum(client: Client, service: Service, tmp_path: Path):
    (run_id,) = service.launch()
    held, content = service.claim(), b"weights" * 1000
    service.write_file(held, "damaged.pt", content)
    path = service.settings.run_directory(run_id) / "policy-best.pt"
    path.write_bytes(content)
    place, digest = str(path.relative_to(service.settings.home)), hashlib.sha256(content).hexdigest()
    register_file(service.database, held, path.name, "policy", place, len(content), digest)
    assert client.runs.download(run_id, "policy-best.pt", tmp_path).read_bytes() == content
    with pytest.raises(BadAnswer, match="came damaged"):
        client.runs.download(run_id, "damaged.pt", tmp_path / "out.pt")
    assert not (tmp_path / "out.pt").exists()
    with pytest.raises(NotThere, match=r"has no file 'policy\.pt'; it has: damaged\.pt, policy-best\.pt"):
        client.runs.download(run_id, "policy.pt")


def test_waiting_ends_where_only_a_person_can_go_on(client: Client, service: Service):
    locomotion, manipulation = client.runs.launch(task="FetchPush", method="her-sldr", preset="smoke")
    with pytest.raises(StillGoing, match=f"these runs have not ended: {locomotion.id}"):
        client.runs.wait([locomotion], timeout_s=0.0, poll_s=0.0)
    finish(service.database, service.claim(), Failed("It broke.", retry=False))
    states = [run.state for run in client.runs.wait([locomotion, manipulation], timeout_s=60.0)]
    assert states == ["failed", "blocked"]


def test_waiting_ends_at_a_paused_run_and_at_what_needs_it(client: Client, service: Service):
    outcome = client.studies.launch("one", ["FetchPush"], ["her-sldr"], [0], "smoke", locomotion="train")
    with pytest.raises(StillGoing, match="1 runs of study 'one' have not ended"):
        client.studies.wait(outcome, timeout_s=0.0, poll_s=0.0)
    [locomotion] = client.studies.get(outcome).locomotion
    [manipulation] = client.studies.get(outcome).cells[0].runs
    assert [result.done for result in client.runs.act("pause", [locomotion.run_id])] == [True]
    waited = client.runs.wait([locomotion.run_id, manipulation.run_id], timeout_s=60.0)
    assert [run.state for run in waited] == ["paused", "blocked"]
    study = client.studies.wait(outcome, timeout_s=60.0)
    assert (study.has_ended, study.states["blocked"]) == (False, 1)


def test_studies_are_launched_and_compared(client: Client, service: Service, tmp_path: Path):
    outcome = client.studies.launch("both", ["FetchPush"], ["her", "ddpg"], [0, 1], "smoke")
    assert (outcome.queued, outcome.joined) == (4, 0)
    study = client.studies.get(outcome)
    assert [(cell.method, len(cell.runs)) for cell in study.cells] == [("her", 2), ("ddpg", 2)]
    assert [found.name for found in client.studies.find()] == ["both"]
    again = client.studies.preview(study.spec)
    assert {place.standing for place in again.places} == {"joined"}
    client.runs.cancel([run.run_id for cell in study.cells for run in cell.runs])
    assert client.studies.wait(outcome, timeout_s=60.0).has_ended
    assert len(client.comparisons.curves(study=outcome.study_id).left_out) == 4
    assert client.comparisons.best(study=outcome.study_id).scores == []
    assert client.comparisons.figure(tmp_path / "best.csv", "best", study=outcome.study_id).read_text()
    with pytest.raises(ClientError, match=r"No figure ends in '\.gif'"):
        client.comparisons.figure("best.gif")


def test_refusals_are_the_services_own_sentences(client: Client):
    with pytest.raises(Unfit, match="Did you mean 'FetchPush'") as refused:
        client.runs.launch(task="FetchPus")
    assert [problem.field for problem in refused.value.problems] == ["task"]
    with pytest.raises(NotThere, match="There is no run 'gone'"):
        client.runs.get("gone")


def test_the_service_tells_of_itself(client: Client):
    assert client.health().workers_alive == 0
    assert client.workers() == []
    assert "FetchPush" in {task.name for task in client.choices().tasks}


def test_whoever_does_not_answer_is_named(free_port: int):
    pauses: list[float] = []
    connection = Connection(f"http://127.0.0.1:{free_port}", None, pauses.append)
    with pytest.raises(NotReachable, match=f"Nobody answers at http://127.0.0.1:{free_port}"):
        connection.ask(dict, "/healthz")
    assert pauses == [0.5, 1.0, 2.0]
    with pytest.raises(NotReachable):
        connection.tell(dict, "POST", "/api/launches")
    assert len(pauses) == 3


def test_a_figure_may_take_as_long_as_its_drawing_and_is_asked_for_once():
    waits: list[float] = []

    def answer(request: httpx.Request) -> httpx.Response:
        waits.append(request.extensions["timeout"]["read"])
        raise httpx.ReadTimeout("It draws.", request=request)

    connection = Connection("http://127.0.0.1:1", None, lambda pause_s: None)
    connection._http = httpx.Client(base_url="http://127.0.0.1:1", transport=httpx.MockTransport(answer))
    with pytest.raises(NotReachable, match="did not answer in time"):
        connection.ask_bytes("/api/compare/figure.svg")
    [wait] = waits
    assert wait > DRAWING_S


def test_another_program_at_the_address_is_told_apart():
    connection = Connection("http://127.0.0.1:1", None)
    connection._http = httpx.Client(
        base_url="http://127.0.0.1:1", transport=httpx.MockTransport(lambda request: httpx.Response(200, text="hello"))
    )
    with pytest.raises(BadAnswer, match="is it an SLDR service"):
        connection.ask(dict, "/healthz")


def test_a_service_is_found_while_it_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SLDR_HOME", str(tmp_path))
    monkeypatch.delenv("SLDR_URL", raising=False)
    settings = Settings(tmp_path, sqlite_url(tmp_path))
    assert (find_local_server(), find_url(None)) == (None, "http://127.0.0.1:8000")
    with marked(settings, local_url("0.0.0.0", 9001)):
        assert find_url(None) == "http://127.0.0.1:9001"
        with marked(settings, local_url("::1", 9002)):
            assert find_url(None) == "http://127.0.0.1:9001"
    assert find_local_server() is None
    settings.server_file.write_text("http://127.0.0.1:9003\n")
    assert find_local_server() is None
    with settings.server_file.open() as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        assert find_local_server() == "http://127.0.0.1:9003"
    monkeypatch.setenv("SLDR_URL", "http://box:8000/")
    assert find_url(None) == "http://box:8000"


def test_this_machines_token_goes_to_this_machine_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SLDR_HOME", str(tmp_path))
    monkeypatch.delenv("SLDR_TOKEN", raising=False)
    assert find_token(None, "http://127.0.0.1:8000") is None
    (tmp_path / "access-token").write_text("secret\n")
    assert find_token(None, "http://127.0.0.1:8000") == "secret"
    assert find_token(None, "http://[::1]:8000") == "secret"
    assert find_token(None, "http://127.0.0.1.example.org:8000") is None
    assert find_token(None, "http://box:8000") is None
    monkeypatch.setenv("SLDR_TOKEN", "other")
    assert find_token(None, "http://box:8000") == "other"
    assert find_token("given", "http://box:8000") == "given"


@pytest.mark.parametrize("url", ["box:8000", "ftp://box", "http://", "http://box:99999", "file:///etc/passwd"])
def test_an_address_that_can_be_none_is_refused(url: str):
    with pytest.raises(BadUrl, match="is no address of a service"):
        Client(url)


NAMED_OTHERWISE = {"Study": "StudySummary", "Run": "RunSummary", "Curve": "GroupCurve", "LogPiece": "LogTail"} | {
    "Column": "TableColumn",
    "Table": "PlainTable",
    "Variant": "StudyVariant",
    "Named": "PresetSummary",
}
"""What the schema calls some records."""


@pytest.fixture(scope="module")
def schemas() -> dict[str, Any]:
    """Return what the API promises of its records; it does not depend on where the data lies."""
    nowhere = Path("/nonexistent")
    return create_app(Settings(nowhere, sqlite_url(nowhere)), nowhere).openapi()["components"]["schemas"]


@pytest.mark.parametrize("module", [comparisons, runs, service, studies])
def test_records_ask_for_nothing_that_the_schema_does_not_promise(module: ModuleType, schemas: dict[str, Any]):
    records: list[type[Any]] = [
        kind
        for kind in vars(module).values()
        if isinstance(kind, type) and is_dataclass(kind) and kind.__module__ == module.__name__
    ]
    assert records
    for record in records:
        promised = schemas[NAMED_OTHERWISE.get(record.__name__, record.__name__)]
        assert {field.name for field in fields(record)} <= set(promised["properties"]), record
