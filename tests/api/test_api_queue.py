"""The queue through the API: its order, what changes it, and who trains."""

from __future__ import annotations

import pytest
from live_api import Service, problem_fields

from backend.store.workers import Machine, register_worker


def waiting(service: Service) -> list[str]:
    """Return the ids of the queue's runs, in their order."""
    return [entry["run"]["id"] for entry in service.get("/api/queue")["entries"]]


def test_the_queue_tells_places_and_what_is_waited_for(service: Service):
    locomotion_id, run_id = service.launch(method="her-sldr")
    first, second = service.get("/api/queue")["entries"]
    assert (first["run"]["id"], first["position"], first["starts_at"]) == (locomotion_id, 1, None)
    assert (second["run"]["id"], second["run"]["state"]) == (run_id, "blocked")
    assert locomotion_id in second["waits_for"]


def test_of_a_long_queue_the_first_are_sent_and_all_are_counted(service: Service):
    first, *_ = service.launch(seeds=(0, 1, 2))
    queue = service.get("/api/queue", params={"limit": 1})
    assert [entry["run"]["id"] for entry in queue["entries"]] == [first]
    assert queue["total"] == 3


def test_what_runs_stands_first_and_has_started(service: Service):
    ids = service.launch(seeds=(0, 1))
    service.claim()
    first, _ = service.get("/api/queue")["entries"]
    assert (first["run"]["id"], first["position"]) == (ids[0], None)
    assert first["starts_at"] is not None


def test_a_run_is_moved_before_another_and_to_the_end(service: Service):
    first, second, third = service.launch(seeds=(0, 1, 2))
    assert service.client.post(f"/api/runs/{third}/move", json={"before": first}).status_code == 204
    assert waiting(service) == [third, first, second]
    assert service.client.post(f"/api/runs/{third}/move", json={"before": None}).status_code == 204
    assert waiting(service) == [first, second, third]


def test_runs_launched_at_different_times_can_be_moved_while_no_worker_is_there(service: Service):
    [first], [second] = service.launch(seeds=(0,)), service.launch(seeds=(1,))
    service.client.post(f"/api/runs/{second}/move", json={"before": first})
    assert waiting(service) == [second, first]


def test_a_run_that_trains_has_no_place_to_change(service: Service):
    first, second = service.launch(seeds=(0, 1))
    service.claim()
    answer = service.client.post(f"/api/runs/{first}/move", json={"before": second})
    assert answer.status_code == 409
    assert problem_fields(answer) == [None]


def test_moving_what_is_not_there_is_not_found(service: Service):
    [run_id] = service.launch()
    assert service.client.post("/api/runs/nope/move", json={"before": None}).status_code == 404
    assert service.client.post(f"/api/runs/{run_id}/move", json={"before": "nope"}).status_code == 404


def test_a_higher_priority_comes_first(service: Service):
    first, second = service.launch(seeds=(0, 1))
    answer = service.client.put("/api/runs/priority", json={"run_ids": [second], "priority": 5})
    assert answer.status_code == 204
    assert waiting(service) == [second, first]
    assert service.get(f"/api/runs/{second}")["priority"] == 5


def test_no_run_gets_a_priority_if_one_does_not_exist(service: Service):
    [run_id] = service.launch()
    answer = service.client.put("/api/runs/priority", json={"run_ids": [run_id, "nope"], "priority": 5})
    assert answer.status_code == 404
    assert service.get(f"/api/runs/{run_id}")["priority"] == 0


@pytest.mark.parametrize("priority", [101, -101, 1.5, True, "7", None])
def test_a_priority_that_does_not_exist_is_named(unused_service: Service, priority: object):
    answer = unused_service.client.put("/api/runs/priority", json={"run_ids": ["a"], "priority": priority})
    assert answer.status_code == 422
    assert problem_fields(answer) == ["priority"]


def test_workers_are_listed_with_what_they_have_and_do(service: Service):
    machine = Machine(cores=16, processor="EPYC", gpu="H200", memory_total=32_000_000_000)
    register_worker(service.database, "box-3", 4711, 2, machine)
    [run_id] = service.launch()
    service.claim()
    idle, busy = service.get("/api/workers")["workers"]
    assert (idle["host"], idle["cores"], idle["processor"], idle["gpu"]) == ("box-3", 16, "EPYC", "H200")
    assert idle["running"] == []
    assert busy["running"] == [{"id": run_id, "task": "FetchPush", "phase": "manipulation", "method": "her", "seed": 0}]
    assert (busy["slots"], busy["alive"], busy["draining"]) == (1, True, False)


def test_a_worker_is_drained_and_takes_runs_again(service: Service):
    worker_id = register_worker(service.database, "box-3", 4711, 2)
    for draining in (True, False):
        answer = service.client.put(f"/api/workers/{worker_id}/draining", json={"draining": draining})
        assert answer.status_code == 204
        assert service.get("/api/workers")["workers"][0]["draining"] is draining


def test_draining_nobody_is_not_found(unused_service: Service):
    answer = unused_service.client.put("/api/workers/nope/draining", json={"draining": True})
    assert answer.status_code == 404
    assert "'nope'" in answer.json()["problems"][0]["message"]
