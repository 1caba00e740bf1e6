"""Studies through the API: previewed, launched, changed, and what it says of those that cannot work."""

from __future__ import annotations

import json
from typing import Any

import pytest
from live_api import Service, problem_fields

from backend.store.outcomes import Failed
from backend.store.queue import finish

SPEC = {"tasks": ["FetchPush"], "methods": ["her", "her-sldr"], "seeds": [0, 1], "preset": "smoke"}
JSON = {"content-type": "application/json"}


def create(service: Service, name: str = "first", **changes: Any) -> dict[str, Any]:
    answer = service.client.post("/api/studies", json={"name": name, "spec": SPEC | changes})
    assert answer.status_code == 201, answer.text
    return answer.json()


def test_a_preview_shows_every_run_and_queues_nothing(unused_service: Service):
    answer = unused_service.client.post("/api/studies/preview", json={"spec": SPEC})
    assert answer.status_code == 200, answer.text
    preview = answer.json()
    assert [(place["method"], place["seed"], place["standing"]) for place in preview["places"]] == [
        ("her", 0, "new"),
        ("her", 1, "new"),
        ("her-sldr", 0, "new"),
        ("her-sldr", 1, "new"),
    ]
    assert preview["locomotion"] == [{"task": "FetchPush", "run_id": None, "zoo_success": None}]
    assert preview["queued"] == 5
    assert unused_service.get("/api/runs")["total"] == 0


def test_a_preview_says_that_nobody_knows_the_time_and_what_the_disk_needs(unused_service: Service):
    estimate = unused_service.client.post("/api/studies/preview", json={"spec": SPEC}).json()["estimate"]
    assert (estimate["training_s"], estimate["until_done_s"], estimate["unknown_runs"]) == (None, None, 5)
    assert 0 < estimate["disk_bytes"] < estimate["disk_free_bytes"]


def test_a_study_is_launched_once_and_read_as_a_matrix(service: Service):
    outcome = create(service)
    assert (outcome["queued"], outcome["joined"]) == (5, 0)
    study = service.get(f"/api/studies/{outcome['study_id']}")
    assert (study["name"], study["size"], study["states"]) == ("first", 4, {"queued": 2, "blocked": 2})
    assert [(cell["task"], cell["method"], len(cell["runs"])) for cell in study["cells"]] == [
        ("FetchPush", "her", 2),
        ("FetchPush", "her-sldr", 2),
    ]
    assert [run["task"] for run in study["locomotion"]] == ["FetchPush"]
    (listed,) = service.get("/api/studies")["studies"]
    assert listed["id"] == outcome["study_id"]
    assert listed["spec"] == SPEC | {"overrides": {}, "variants": [], "locomotion": "zoo"}


def test_the_same_request_twice_queues_nothing_twice(service: Service):
    create(service)
    answer = service.client.post("/api/studies", json={"name": "first", "spec": SPEC})
    assert answer.status_code == 409
    assert "already; choose another name" in answer.json()["problems"][0]["message"]
    assert create(service, "second")["joined"] == 4
    assert service.get("/api/runs")["total"] == 5


def test_a_study_is_changed_extended_filled_deleted_and_brought_back(service: Service):
    path = f"/api/studies/{create(service)['study_id']}"
    assert service.client.patch(path, json={"name": "better", "note": "So it goes."}).status_code == 204
    assert service.client.post(f"{path}/extend", json={"seeds": [2], "methods": ["ddpg"]}).json()["queued"] == 5
    assert service.client.post(f"{path}/fill").json()["queued"] == 0
    assert service.client.delete(path).status_code == 204
    assert service.get("/api/studies")["studies"] == []
    assert service.client.post(f"{path}/fill").status_code == 409
    assert service.client.post(f"{path}/restore").status_code == 204
    study = service.get(path)
    assert (study["name"], study["note"], study["spec"]["seeds"]) == ("better", "So it goes.", [0, 1, 2])


def test_a_study_may_grow_as_long_as_it_is_not_too_large(service: Service):
    path = f"/api/studies/{create(service)['study_id']}"
    for first in (100, 200):
        added = service.client.post(f"{path}/extend", json={"seeds": list(range(first, first + 90))})
        assert added.status_code == 200
    assert len(service.get(path)["spec"]["seeds"]) == 2 + 180
    assert len(service.get("/api/studies")["studies"][0]["spec"]["seeds"]) == 2 + 180


def test_a_variant_is_added(service: Service):
    changes = {"methods": ["her"], "variants": [{"name": "base", "overrides": {}}]}
    path = f"/api/studies/{create(service, **changes)['study_id']}"
    added = {"variants": [{"name": "low", "overrides": {"agent": {"gamma": 0.9}}}]}
    assert service.client.post(f"{path}/extend", json=added).json()["queued"] == 2
    assert [cell["variant"] for cell in service.get(path)["cells"]] == ["base", "low"]


def test_failed_runs_are_tried_again(service: Service):
    path = f"/api/studies/{create(service)['study_id']}"
    held = service.claim()
    finish(service.database, held, Failed("The numbers diverged.", retry=False))
    results = service.client.post(f"{path}/retry", json={}).json()["results"]
    assert [(result["run_id"], result["done"]) for result in results] == [(held.run_id, True)]
    assert service.client.post(f"{path}/retry", json={"cancelled": True}).json()["results"] == []


def test_the_templates_can_be_previewed_as_they_are(unused_service: Service):
    templates = unused_service.get("/api/studies/templates")["templates"]
    paper = next(template for template in templates if template["name"] == "paper")
    preview = unused_service.client.post("/api/studies/preview", json={"spec": paper["spec"]}).json()
    assert len(preview["places"]) == 13 * 7 * 5
    # rotation and translation of three hand objects, three tasks of one object on a table, two chains, and the stacks
    # share the model of FetchPickAndPlace
    assert len({run["task"] for run in preview["locomotion"]}) == len(preview["locomotion"]) == preview["queued"] - 455


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"tasks": ["FetchPus"]}, "task"),
        ({"methods": ["herr"]}, "method"),
        ({"preset": "huge"}, "preset"),
        ({"tasks": []}, "spec.tasks"),
        ({"seeds": [-1]}, "spec.seeds.0"),
        ({"seeds": [True]}, "spec.seeds.0"),
        ({"seeds": [3, 3]}, "seeds"),
        ({"seeds": list(range(2001))}, "spec.seeds"),
        ({"overrides": {"loop": {"batch_size": -5}}}, "loop.batch_size"),
        ({"overrides": {"seed": 5}}, "seed"),
        ({"overrides": {"loop": 5}}, "loop"),
        ({"variants": [{"name": "a", "overrides": {"loop": 5}}]}, "loop"),
        ({"variants": [{"name": "a", "overrides": {}}, {"name": "b", "overrides": {}}]}, "variants"),
        ({"colour": "red"}, "spec.colour"),
    ],
)
def test_a_study_that_cannot_work_names_the_field(unused_service: Service, change: dict[str, Any], field: str):
    content = json.dumps({"spec": SPEC | change})
    answer = unused_service.client.post("/api/studies/preview", content=content, headers=JSON)
    assert answer.status_code == 422, answer.text
    assert field in problem_fields(answer)


@pytest.mark.parametrize("path", ["", "/fill", "/restore", "/retry", "/extend"])
def test_a_study_that_does_not_exist_is_named(unused_service: Service, path: str):
    body = {"/retry": {}, "/extend": {"seeds": [1]}}.get(path)
    method = "POST" if path else "GET"
    answer = unused_service.client.request(method, f"/api/studies/nope{path}", json=body)
    assert answer.status_code == 404
    assert answer.json()["problems"][0]["message"] == "There is no study 'nope'."
