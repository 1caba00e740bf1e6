"""Runs through the API: table, detail, history, attempts, curves."""

from __future__ import annotations

import pytest
from live_api import Service, problem_fields

from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Failed, HandedBack
from backend.store.progress import Progress
from backend.store.queue import finish
from sldr_core.records import Step


def step(cycle: int) -> Step:
    return Step(cycle=cycle, epoch=1, env_steps=10 * cycle, episodes=cycle, updates=4 * cycle, wall_seconds=0.5 * cycle)


def test_the_table_starts_empty(unused_service: Service):
    assert unused_service.get("/api/runs") == {"runs": [], "values": [], "next_cursor": None, "total": 0}


def test_pages_follow_each_other_newest_first(service: Service):
    ids = service.launch(seeds=(0, 1, 2))
    first = service.get("/api/runs", params={"limit": 2})
    second = service.get("/api/runs", params={"limit": 2, "cursor": first["next_cursor"]})
    assert [run["id"] for run in first["runs"] + second["runs"]] == ids[::-1]
    assert (first["total"], second["next_cursor"]) == (3, None)


def test_filters_narrow_the_table(service: Service):
    service.launch(method="her-sldr")
    assert service.get("/api/runs", params={"phase": "locomotion"})["total"] == 1
    assert service.get("/api/runs", params={"state": "blocked"})["total"] == 1
    assert service.get("/api/runs", params={"method": "ddpg"})["total"] == 0
    assert service.get("/api/runs", params={"search": "fetchpush sldr"})["total"] == 1


@pytest.mark.parametrize(
    ("params", "field"),
    [
        ({"state": "lost"}, "state.0"),
        ({"phase": "flying"}, "phase.0"),
        ({"limit": "0"}, "limit"),
        ({"limit": "many"}, "limit"),
        ({"cursor": "next"}, "cursor"),
        ({"cursor": "9" * 40}, "cursor"),
        ({"sort": "colour"}, "sort"),
    ],
)
def test_a_filter_that_cannot_work_is_named(unused_service: Service, params: dict[str, str], field: str):
    answer = unused_service.client.get("/api/runs", params=params)
    assert answer.status_code == 422
    assert problem_fields(answer) == [field]


def test_a_run_shows_its_config_progress_and_what_it_needs(service: Service):
    locomotion_id, run_id = service.launch(method="her-sldr")
    held = service.claim()
    append_metrics(service.database, held, [], Progress(1, 2, 400, 8, 16, 0.25, 0.5, 0.75, 100.0, 50.0, 3.0))
    locomotion = service.get(f"/api/runs/{locomotion_id}")
    assert locomotion["progress"]["success_rate"] == 0.5
    assert (locomotion["state"], locomotion["attempt"]) == ("running", 1)
    waiting = service.get(f"/api/runs/{run_id}")
    assert waiting["locomotion_run_id"] == locomotion_id
    assert waiting["config"]["method"] == "her-sldr"
    assert (waiting["progress"], waiting["has_policy"], waiting["has_recording"]) == (None, False, False)


def test_a_run_tells_what_there_is_to_watch(service: Service):
    service.launch()
    held = service.claim()
    service.write_file(held, "policy-newest.pt", b"policy")
    service.write_file(held, "recording-attempt-1.rrd", b"recording")
    run = service.get(f"/api/runs/{held.run_id}")
    assert (run["has_policy"], run["has_recording"]) == (True, True)


def test_the_table_is_sorted_on_the_server_across_pages(service: Service):
    ids = service.launch(seeds=(0, 1, 2))
    for success in (0.5, 0.9):
        held = service.claim()
        append_metrics(service.database, held, [], Progress(1, 2, 400, 8, 16, 0.25, success, success, None, None, None))
    params = {"sort": "success", "limit": 2}
    first = service.get("/api/runs", params=params)
    second = service.get("/api/runs", params=params | {"cursor": first["next_cursor"]})
    assert [run["id"] for run in first["runs"] + second["runs"]] == [ids[1], ids[0], ids[2]]
    oldest = service.get("/api/runs", params={"descending": False, "limit": 1})
    assert [run["id"] for run in oldest["runs"]] == ids[:1]


@pytest.mark.parametrize("part", ["", "/metrics", "/attempts", "/log", "/events", "/files", "/files/log.txt"])
def test_an_unknown_run_is_not_found(unused_service: Service, part: str):
    answer = unused_service.client.get(f"/api/runs/nope{part}")
    assert answer.status_code == 404
    assert "'nope'" in answer.json()["problems"][0]["message"]


def test_the_history_of_a_run_is_told_oldest_first(service: Service):
    [run_id] = service.launch()
    service.claim()
    events = service.get(f"/api/runs/{run_id}/events")["events"]
    assert [(event["event"], event["state"]) for event in events] == [("created", "queued"), ("claimed", "running")]


def test_curves_come_in_columns_and_go_on_from_the_cursor(service: Service):
    [run_id] = service.launch()
    held = service.claim()
    append_metrics(service.database, held, [MetricPoint(step(1), {"test/success_rate": 0.5})])
    first = service.get(f"/api/runs/{run_id}/metrics")
    append_metrics(service.database, held, [MetricPoint(step(2), {"critic/task/loss": 0.1})])
    second = service.get(f"/api/runs/{run_id}/metrics", params={"after": first["cursor"]})
    assert (first["step"], first["values"]) == ([1], {"test/success_rate": [0.5]})
    assert (second["step"], second["values"]) == ([2], {"critic/task/loss": [0.1]})
    assert service.get(f"/api/runs/{run_id}/metrics", params={"after": second["cursor"]})["step"] == []


def test_a_cursor_of_curves_below_zero_is_named(unused_service: Service):
    answer = unused_service.client.get("/api/runs/nope/metrics", params={"after": -1})
    assert problem_fields(answer) == ["after"]


def resumed_run(service: Service) -> str:
    """Return a run whose second attempt went back to cycle 2."""
    [run_id] = service.launch()
    for cycles, value in (((1, 2, 3), 0.1), ((2, 3), 0.2)):
        held = service.claim()
        points = [MetricPoint(step(cycle), {"test/success_rate": value}) for cycle in cycles]
        append_metrics(service.database, held, points)
        finish(service.database, held, HandedBack("Its worker was asked to end."))
    return run_id


def test_points_that_a_later_attempt_replaced_are_read_when_asked_for(service: Service):
    run_id = resumed_run(service)
    current = service.get(f"/api/runs/{run_id}/metrics")
    everything = service.get(f"/api/runs/{run_id}/metrics", params={"superseded": True})
    assert (current["attempt"], current["step"]) == ([1, 2, 2], [1, 2, 3])
    assert (everything["attempt"], everything["step"]) == ([1, 1, 1, 2, 2], [1, 2, 3, 2, 3])


def test_the_attempts_of_a_run_say_where_they_began_and_how_they_ended(service: Service):
    run_id = resumed_run(service)
    finish(service.database, service.claim(), Failed("The loss became NaN.", retry=False))
    attempts = service.get(f"/api/runs/{run_id}/attempts")["attempts"]
    assert [(row["attempt"], row["first_cycle"], row["outcome"], row["host"]) for row in attempts] == [
        (1, 1, "handed_back", "here"),
        (2, 2, "handed_back", "here"),
        (3, None, "failed", "here"),
    ]
    assert attempts[2]["reason"] == "The loss became NaN."
