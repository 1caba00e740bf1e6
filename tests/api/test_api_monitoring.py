"""`/healthz`, `/metrics`, and the log: what a monitor sees, and labels that nobody can multiply."""

from __future__ import annotations

import json
import logging
from pathlib import Path
from typing import IO

import pytest
from live_api import Service
from prometheus_client.parser import text_string_to_metric_families

from backend.api.request_meter import route_label
from backend.logs import HumanLines, JsonLines, about, load_style, start_logging
from backend.store.actions import request_cancel
from backend.store.tables import SCHEMA_REVISION
from sldr_core.errors import InvalidConfig

Samples = dict[tuple[str, frozenset[tuple[str, str]]], float]


def scrape(service: Service) -> Samples:
    """Return every sample by its name and labels, as a monitor reads them."""
    answer = service.client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=")
    return {
        (sample.name, frozenset(sample.labels.items())): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


def gauge(samples: Samples, name: str, **labels: str) -> float:
    return samples[name, frozenset(labels.items())]


def test_a_monitor_sees_runs_workers_and_queue(service: Service):
    run_ids = service.launch(seeds=(0, 1, 2))
    request_cancel(service.database, run_ids[2])
    service.claim()
    samples = scrape(service)
    states = {state: gauge(samples, "sldr_runs", state=state) for state in ("queued", "running", "cancelled", "failed")}
    assert states == {"queued": 1.0, "running": 1.0, "cancelled": 1.0, "failed": 0.0}
    assert (gauge(samples, "sldr_workers"), gauge(samples, "sldr_slots"), gauge(samples, "sldr_slots_busy")) == (
        1,
        1,
        1,
    )
    assert 0.0 < gauge(samples, "sldr_queue_age_seconds") < 600.0


def test_an_empty_queue_has_no_age(service: Service):
    assert gauge(scrape(service), "sldr_queue_age_seconds") == 0.0


def test_requests_are_timed_by_route_and_kind_of_answer(service: Service):
    for path in ("/api/runs/one", "/api/runs/two", "/nowhere/1", "/nowhere/2", "/api/no-such-thing"):
        service.client.get(path)
    service.client.request("BREW", "/api/runs")
    name = "sldr_http_request_duration_seconds_count"
    counts = {labels: value for (found, labels), value in scrape(service).items() if found == name}
    of_run = frozenset({("method", "GET"), ("route", "/api/runs/{run_id}"), ("answer", "4xx")})
    assert counts[of_run] == 2.0
    assert {dict(labels)["method"] for labels in counts} == {"GET", "other"}
    assert not any("nowhere" in dict(labels)["route"] for labels in counts)


def test_only_routes_are_labels():
    assert route_label({"type": "http", "path": "/api/runs/made-up"}) == "page"


def test_health_names_store_and_tables(service: Service):
    health = service.get("/healthz")
    assert (health["store"], health["schema_revision"], health["worker_seen_at"]) == ("sqlite", SCHEMA_REVISION, None)
    service.launch()
    service.claim()
    assert service.get("/healthz")["worker_seen_at"] is not None


def test_every_request_has_an_id_of_its_own(service: Service):
    ids = {service.client.get("/healthz").headers["x-request-id"] for _ in range(3)}
    assert len(ids) == 3


def record(message: str, *arguments: object) -> logging.LogRecord:
    return logging.LogRecord("sldr.worker", logging.WARNING, __file__, 1, message, arguments, None)


def test_lines_say_what_they_are_about():
    with about(run_id="abc", attempt=2):
        with about(request_id="r"):
            assert (
                HumanLines()
                .format(record("Run %s: lost.", "abc"))
                .endswith(" Run abc: lost. [run_id=abc attempt=2 request_id=r]")
            )
        line = json.loads(JsonLines("worker").format(record('Run %s: \n"lost".', "abc")))
    assert line.pop("at").endswith("+00:00")
    assert line == {
        "level": "warning",
        "role": "worker",
        "logger": "sldr.worker",
        "message": 'Run abc: \n"lost".',
        "run_id": "abc",
        "attempt": 2,
    }
    assert HumanLines().format(record("Done.")).endswith(" Done.")


def test_a_traceback_is_a_field():
    try:
        raise ValueError("broke")
    except ValueError as err:
        failed = logging.LogRecord("a", logging.ERROR, __file__, 1, "Bad.", (), (type(err), err, err.__traceback__))
    assert "ValueError: broke" in json.loads(JsonLines("api").format(failed))["error"]


def test_files_rotate_and_are_shared_by_no_two_processes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    root = logging.getLogger()
    before, level = list(root.handlers), root.level
    monkeypatch.setattr("backend.logs.LARGEST_FILE", 200)
    monkeypatch.setattr("backend.logs.KEPT_FILES", 2)
    locks: list[IO[str]] = []
    monkeypatch.setattr("backend.logs._held", locks)
    try:
        first = start_logging("worker", tmp_path, "json")
        second = start_logging("worker", tmp_path, "human")
        for number in range(20):
            root.info("line %d", number)
        logging.getLogger("httpx").info("HTTP Request: POST https://chat.example.org/hooks/secret")
    finally:
        for added in [handler for handler in root.handlers if handler not in before]:
            root.removeHandler(added)
            added.close()
        for lock in locks:
            lock.close()
        root.setLevel(level)
    assert (first.name, second.name) == ("worker.log", "worker-2.log")
    assert {path.name for path in tmp_path.glob("worker.log*")} == {"worker.log", "worker.log.1", "worker.log.2"}
    assert json.loads(first.read_text().splitlines()[-1])["message"] == "line 19"
    assert not any("secret" in path.read_text() for path in tmp_path.glob("*.log*"))


def test_a_format_that_does_not_exist_is_refused(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SLDR_LOG_FORMAT", "xml")
    with pytest.raises(InvalidConfig, match="'xml' is no format of logs; write human or json"):
        load_style()
