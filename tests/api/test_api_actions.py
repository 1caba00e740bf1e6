"""What can be asked of runs through the API, one or many at once."""

from __future__ import annotations

from typing import Any

import pytest
from live_api import Service, problem_fields

from backend.api.queue_schemas import MOST_RUNS
from backend.store.outcomes import Succeeded
from backend.store.queue import finish


def act(service: Service, action: str, *run_ids: str) -> list[tuple[bool, str]]:
    """Ask for an action; return what became of it, and the message, run by run."""
    answer = service.client.post("/api/runs/actions", json={"action": action, "run_ids": run_ids})
    assert answer.status_code == 200, answer.text
    results = answer.json()["results"]
    assert [result["run_id"] for result in results] == list(run_ids)
    return [(result["done"], result["message"]) for result in results]


def state_of(service: Service, run_id: str) -> str:
    """Return a run's state."""
    return service.get(f"/api/runs/{run_id}")["state"]


def test_a_waiting_run_is_cancelled_at_once(service: Service):
    [run_id] = service.launch()
    assert act(service, "cancel", run_id)[0][0]
    assert state_of(service, run_id) == "cancelled"


def test_a_running_run_is_asked_to_end(service: Service):
    [run_id] = service.launch()
    service.claim()
    act(service, "cancel", run_id)
    run = service.get(f"/api/runs/{run_id}")
    assert (run["state"], run["cancel_requested"]) == ("running", True)


def test_a_running_run_is_asked_to_pause(service: Service):
    [run_id] = service.launch()
    service.claim()
    act(service, "pause", run_id)
    run = service.get(f"/api/runs/{run_id}")
    assert (run["state"], run["pause_requested"]) == ("running", True)


def test_a_paused_run_goes_on(service: Service):
    [run_id] = service.launch()
    act(service, "pause", run_id)
    assert state_of(service, run_id) == "paused"
    act(service, "resume", run_id)
    assert state_of(service, run_id) == "queued"


def test_a_cancelled_run_is_tried_again(service: Service):
    [run_id] = service.launch()
    act(service, "cancel", run_id)
    act(service, "retry", run_id)
    assert state_of(service, run_id) == "queued"


def test_a_run_that_does_not_allow_it_says_why_and_keeps_no_other_from_it(service: Service):
    [ended] = service.launch()
    finish(service.database, service.claim(), Succeeded(success_rate=1.0))
    [waiting] = service.launch(seeds=(1,))
    refused, done, unknown = act(service, "cancel", ended, waiting, "nope")
    assert not refused[0]
    assert "succeeded" in refused[1]
    assert done[0]
    assert unknown == (False, "There is no run 'nope'.")
    assert state_of(service, waiting) == "cancelled"


def test_a_deleted_run_leaves_the_table_and_comes_back(service: Service):
    first, second = service.launch(seeds=(0, 1))
    act(service, "delete", first)
    assert [run["id"] for run in service.get("/api/runs")["runs"]] == [second]
    assert [run["id"] for run in service.get("/api/runs", params={"deleted": True})["runs"]] == [first]
    assert service.get(f"/api/runs/{first}")["deleted_at"] is not None
    act(service, "restore", first)
    assert service.get("/api/runs")["total"] == 2


def test_a_run_below_its_gate_says_so_and_is_released(service: Service):
    order = {
        "task": "FetchPush",
        "method": "her-sldr",
        "seeds": [0],
        "preset": "smoke",
        "overrides": {"sldr": {"gate": 0.9}},
    }
    _, run = service.client.post("/api/launches", json=order).json()["runs"]
    assert not run["is_below_gate"]
    finish(service.database, service.claim(), Succeeded(success_rate=0.5))
    held = service.get(f"/api/runs/{run['id']}")
    assert (held["state"], held["is_below_gate"]) == ("blocked", True)
    act(service, "release", run["id"])
    released = service.get(f"/api/runs/{run['id']}")
    assert (released["state"], released["is_below_gate"], released["gate_waived"]) == ("queued", False, True)


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({"action": "explode", "run_ids": ["a"]}, "action"),
        ({"action": 1, "run_ids": ["a"]}, "action"),
        ({"action": "pause", "run_ids": []}, "run_ids"),
        ({"action": "pause", "run_ids": ["a"] * (MOST_RUNS + 1)}, "run_ids"),
        ({"action": "pause", "run_ids": [7]}, "run_ids.0"),
        ({"action": "pause"}, "run_ids"),
        ({"action": "pause", "run_ids": ["a"], "force": True}, "force"),
    ],
)
def test_a_wish_that_cannot_be_meant_names_the_field(unused_service: Service, body: dict[str, Any], field: str):
    answer = unused_service.client.post("/api/runs/actions", json=body)
    assert answer.status_code == 422
    assert problem_fields(answer) == [field]


def test_another_sites_page_can_ask_for_nothing(service: Service):
    [run_id] = service.launch()
    body = {"action": "delete", "run_ids": [run_id]}
    answer = service.client.post("/api/runs/actions", json=body, headers={"origin": "http://evil.example"})
    assert answer.status_code == 403
    assert service.get("/api/runs")["total"] == 1
