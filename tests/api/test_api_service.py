"""Health, workers, pages, errors: what is true of the whole service."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from live_api import Service, problem_fields, serving_client

from backend.api.app import create_app
from backend.api.schema import schema_text
from backend.store.database import Database
from backend.store.settings import Settings
from backend.store.viewer_sessions import beat_host
from backend.store.workers import register_worker

BROWSER = {"accept": "text/html,application/xhtml+xml"}


def test_health_is_degraded_while_nobody_trains_or_shows(unused_service: Service):
    health = unused_service.get("/healthz")
    assert (health["status"], health["workers_alive"], health["viewer_alive"]) == ("degraded", 0, False)


def test_health_is_ok_with_a_worker_and_a_viewer(service: Service):
    register_worker(service.database, "here", 1, 1)
    beat_host(service.database, "host", 2)
    assert service.get("/healthz")["status"] == "ok"


@pytest.mark.parametrize("path", ["/api", "/api/", "/api/nope", "/api/runs/x/nope"])
def test_unknown_addresses_of_the_api_are_json_even_for_browsers(unused_service: Service, path: str):
    answer = unused_service.client.get(path, headers=BROWSER)
    assert answer.status_code == 404
    assert problem_fields(answer) == [None]


def test_a_wrong_verb_is_answered_in_words(unused_service: Service):
    answer = unused_service.client.delete("/api/runs")
    assert answer.status_code == 405
    assert answer.json()["problems"][0]["message"] == "DELETE is not possible on /api/runs."


def test_without_a_built_page_a_browser_reads_how_to_build_it(unused_service: Service):
    answer = unused_service.client.get("/", headers=BROWSER)
    assert answer.status_code == 503
    assert "make web" in answer.text


def test_the_built_page_answers_its_own_addresses(settings: Settings, built_page: Path):
    (built_page / "assets").mkdir(parents=True)
    (built_page / "index.html").write_text("<title>SLDR</title>")
    (built_page / "assets" / "app-1a2b.js").write_text("1;")
    with serving_client(create_app(settings, built_page)) as client:
        run_page = client.get("/runs/abc", headers=BROWSER)
        script = client.get("/assets/app-1a2b.js")
        missing = client.get("/assets/old.js")
        unknown = client.get("/api/nope", headers=BROWSER)
    assert (run_page.text, run_page.headers["cache-control"]) == ("<title>SLDR</title>", "no-cache")
    assert "immutable" in script.headers["cache-control"]
    assert (missing.status_code, problem_fields(missing)) == (404, [None])
    assert (unknown.status_code, problem_fields(unknown)) == (404, [None])


def test_an_unexpected_error_is_logged_and_shows_no_traceback(
    unused_service: Service, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
):
    def fail(database: Database) -> None:
        raise RuntimeError("secret detail")

    monkeypatch.setattr("backend.store.workers.list_workers", fail)
    answer = unused_service.client.get("/api/workers")
    mark = answer.json()["problems"][0]["message"].split()[-1].rstrip(".")
    assert answer.status_code == 500
    assert "secret detail" not in answer.text
    assert mark in caplog.text
    assert "secret detail" in caplog.text


def test_the_signing_secret_is_readable_by_its_owner_only(unused_service: Service):
    path = unused_service.settings.secret_path
    assert path.stat().st_mode & 0o777 == 0o600
    assert len(path.read_bytes()) == 32


def test_the_api_loads_no_heavy_package_and_stays_small():
    program = (
        "import json, sys, psutil, backend.api.__main__;"
        "heavy = ['torch', 'mujoco', 'mjbatch', 'viser', 'rerun', 'gymnasium', 'ray', 'matplotlib'];"
        "loaded = [name for name in heavy if name in sys.modules];"
        "print(json.dumps([loaded, psutil.Process().memory_info().rss / 1e6]))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    loaded, megabytes = json.loads(done.stdout)
    assert loaded == []
    assert megabytes < 180


def test_the_schema_is_written_the_same_each_time(tmp_path: Path, settings: Settings):
    path = tmp_path / "new" / "schema.json"
    subprocess.run([sys.executable, "-m", "backend.api.schema", str(path)], check=True)
    assert path.read_text() == schema_text(settings)


def test_every_operation_has_a_name_of_its_own(unused_service: Service):
    schema = unused_service.get("/api/openapi.json")
    operations = [spec["operationId"] for path in schema["paths"].values() for spec in path.values()]
    assert "create_launch" in operations
    assert len(set(operations)) == len(operations)
