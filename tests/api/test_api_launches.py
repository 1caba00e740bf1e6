"""Launching through the API, and what it says of orders that cannot work."""

from __future__ import annotations

import csv
import io
import json
from typing import Any

import pytest
from live_api import Service, problem_fields

ORDER = {"task": "FetchPush", "method": "her-sldr", "seeds": [0, 1], "preset": "smoke"}
JSON = {"content-type": "application/json"}


def test_a_plan_shows_the_locomotion_run_first_and_queues_nothing(unused_service: Service):
    answer = unused_service.client.post("/api/launches/plan", json=ORDER)
    runs = answer.json()["runs"]
    assert [(run["phase"], run["seed"]) for run in runs] == [
        ("locomotion", 0),
        ("manipulation", 0),
        ("manipulation", 1),
    ]
    assert runs[1]["config"]["loop"]["batch_size"] == 64
    assert unused_service.get("/api/runs")["total"] == 0


def test_a_launch_queues_locomotion_and_blocks_what_needs_it(service: Service):
    answer = service.client.post("/api/launches", json=ORDER)
    assert answer.status_code == 201
    locomotion, first, second = answer.json()["runs"]
    assert (locomotion["state"], first["state"], second["state"]) == ("queued", "blocked", "blocked")
    assert first["needs"] == [locomotion["id"]]
    assert locomotion["id"] in first["reason"]


def test_a_second_launch_shares_the_locomotion_run(service: Service):
    first = service.client.post("/api/launches", json=ORDER).json()["runs"]
    plan = service.client.post("/api/launches/plan", json=ORDER | {"seeds": [7]}).json()["runs"]
    assert plan[0]["reused_run_id"] == first[0]["id"]
    assert plan[1]["reused_run_id"] is None


def test_overrides_reach_the_config_and_tell_runs_apart_in_the_table(service: Service):
    plain = service.client.post("/api/launches", json=ORDER).json()["runs"][-1]
    overrides = {"loop": {"batch_size": 32}, "compute": {"threads": 2}}
    run = service.client.post("/api/launches", json=ORDER | {"overrides": overrides}).json()["runs"][-1]
    assert service.get(f"/api/runs/{run['id']}")["config"]["loop"]["batch_size"] == 32
    changes = {run["id"]: run["changes"] for run in service.get("/api/runs")["runs"]}
    assert (changes[plain["id"]], changes[run["id"]]) == ([], ["loop.batch_size=32"])
    table = csv.DictReader(io.StringIO(service.client.get("/api/runs.csv").text))
    assert {row["id"]: row["changes"] for row in table}[run["id"]] == "loop.batch_size=32"


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"task": "FetchPus"}, "task"),
        ({"method": "herr"}, "method"),
        ({"preset": "huge"}, "preset"),
        ({"phase": "flying"}, "phase"),
        ({"seeds": []}, "seeds"),
        ({"seeds": [-1]}, "seeds.0"),
        ({"seeds": [True]}, "seeds.0"),
        ({"seeds": [3, 3]}, "seeds"),
        ({"overrides": {"loop": {"batch_size": -5}}}, "loop.batch_size"),
        ({"overrides": {"loop": {"epochs": 10**400}}}, "loop.epochs"),
        ({"overrides": {"loop": {"batch_sise": 5}}}, "loop.batch_sise"),
        ({"overrides": {"loop": 5}}, "loop"),
        ({"overrides": {"exploration": {"noise_std": 1e400}}}, "exploration.noise_std"),
        ({"overrides": {"\ud800": 1}}, "config"),
        ({"phase": "locomotion"}, "method"),
        ({"colour": "red"}, "colour"),
    ],
)
@pytest.mark.parametrize("path", ["/api/launches", "/api/launches/plan"])
def test_an_order_that_cannot_work_names_the_field(
    unused_service: Service, path: str, change: dict[str, Any], field: str
):
    answer = unused_service.client.post(path, content=json.dumps(ORDER | change), headers=JSON)
    assert answer.status_code == 422
    assert field in problem_fields(answer)


def test_a_missing_field_is_named(unused_service: Service):
    answer = unused_service.client.post("/api/launches", json={"task": "FetchPush"})
    assert set(problem_fields(answer)) == {"method", "seeds", "preset"}


def test_a_body_that_is_not_json_is_said_to_be_so(unused_service: Service):
    answer = unused_service.client.post("/api/launches", content=b"{", headers=JSON)
    assert answer.status_code == 422
    assert "not JSON" in answer.json()["problems"][0]["message"]


def test_an_unknown_task_is_answered_with_the_nearest_one(unused_service: Service):
    answer = unused_service.client.post("/api/launches", json=ORDER | {"task": "FetchPus"})
    assert "Did you mean 'FetchPush'?" in answer.json()["problems"][0]["message"]


def test_another_sites_page_cannot_launch(unused_service: Service):
    answer = unused_service.client.post("/api/launches", json=ORDER, headers={"origin": "http://evil.example"})
    assert answer.status_code == 403
    assert problem_fields(answer) == [None]
    assert unused_service.get("/api/runs")["total"] == 0


def test_our_own_page_can_launch(service: Service):
    answer = service.client.post(
        "/api/launches", json=ORDER, headers={"origin": str(service.client.base_url).rstrip("/")}
    )
    assert answer.status_code == 201
