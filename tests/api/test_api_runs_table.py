"""The runs table through the API: columns, groups, CSV, tags, notes and saved views."""

from __future__ import annotations

import csv
import io
from typing import Any

import pytest
from live_api import Service, problem_fields
from test_api_runs import step

from backend.store.metrics import MetricPoint, append_metrics
from backend.store.progress import Progress


def train(service: Service, *scores: float) -> str:
    """Let the next run log a score in every cycle; return its id."""
    held = service.claim()
    points = [MetricPoint(step(cycle), {"test/score": score}) for cycle, score in enumerate(scores, start=1)]
    progress = Progress(1, 2, 400, 8, 16, 0.5, scores[-1], max(scores), None, None, None)
    append_metrics(service.database, held, points, progress)
    return held.run_id


def rows_of(service: Service, path: str, **params: Any) -> list[dict[str, str]]:
    answer = service.client.get(path, params=params)
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/csv")
    return list(csv.DictReader(io.StringIO(answer.text)))


def test_columns_come_beside_the_runs_and_sort_them(service: Service):
    ids = service.launch(seeds=(0, 1, 2))
    train(service, 0.5, 1.0, 0.25)
    train(service, 0.75)
    params = {"column": ["test/score:best", "test/score:mean2"], "sort": "test/score:last", "descending": True}
    page = service.get("/api/runs", params=params)
    assert [run["id"] for run in page["runs"]] == [ids[1], ids[0], ids[2]]
    assert page["values"] == [[0.75, 0.75], [1.0, 0.625], [None, None]]
    assert service.get("/api/metric-names") == {"names": ["test/score"]}


def test_a_page_can_be_jumped_to(service: Service):
    ids = service.launch(seeds=(0, 1, 2))
    page = service.get("/api/runs", params={"offset": 2, "limit": 2})
    assert ([run["id"] for run in page["runs"]], page["total"]) == ([ids[0]], 3)


@pytest.mark.parametrize(
    ("params", "field"),
    [
        ({"column": "loss"}, "column"),
        ({"sort": "a/b:mean99"}, "sort"),
        ({"seed_from": -1}, "seed_from"),
        ({"success_to": 1.5}, "success_to"),
        ({"offset": -1}, "offset"),
    ],
)
def test_what_cannot_work_is_named(unused_service: Service, params: dict[str, Any], field: str):
    answer = unused_service.client.get("/api/runs", params=params)
    assert (answer.status_code, problem_fields(answer)) == (422, [field])


def test_groups_have_a_spread(service: Service):
    service.launch(seeds=(0, 1, 4))
    for score in (0.2, 0.4):
        train(service, score)
    answer = service.get("/api/run-groups", params={"by": ["task", "settings"], "metric": "test/score:last"})
    [group] = answer["groups"]
    assert (answer["total"], group["runs"], group["seeds"]) == (3, 3, [0, 1, 4])
    assert group["states"] == {"queued": 1, "running": 2}
    assert group["spread"] == pytest.approx({"n": 2, "lower": 0.25, "median": 0.3, "upper": 0.35})
    narrowed = service.get("/api/runs", params={"settings": group["keys"]["settings"]})
    assert narrowed["total"] == 3


def test_groups_are_by_something_that_exists(unused_service: Service):
    assert unused_service.client.get("/api/run-groups", params={"by": ["seed"]}).status_code == 422
    assert unused_service.client.get("/api/run-groups").status_code == 422


def test_the_csv_holds_the_table_and_no_formulas(service: Service):
    ids = service.launch(seeds=(0, 1))
    train(service, 0.1, 1 / 3)
    assert service.client.post("/api/runs/tags", json={"run_ids": ids[:1], "add": ["=1+1", "b"]}).status_code == 204
    service.client.put(f"/api/runs/{ids[0]}/notes", json={"notes": 'says "hm",\nand more'})
    rows = rows_of(service, "/api/runs.csv", column="test/score:last", sort="seed", descending=False)
    assert [row["id"] for row in rows] == ids
    assert (float(rows[0]["test/score:last"]), rows[1]["test/score:last"]) == (1 / 3, "")
    assert (rows[0]["tags"], rows[0]["notes"]) == ("'=1+1, b", 'says "hm",\nand more')
    [group] = rows_of(service, "/api/run-groups.csv", by="method", metric="test/score:best")
    assert (group["method"], group["runs"], group["seeds"]) == ("her", "2", "0 1")
    assert float(group["test/score:best median"]) == 1 / 3


def test_tags_narrow_the_table(service: Service):
    ids = service.launch(seeds=(0, 1, 2))
    service.client.post("/api/runs/tags", json={"run_ids": ids[:2], "add": ["good"]})
    service.client.post("/api/runs/tags", json={"run_ids": ids[:1], "add": ["new"], "remove": ["good"]})
    assert service.get("/api/tags")["tags"] == [{"tag": "good", "runs": 1}, {"tag": "new", "runs": 1}]
    assert service.get("/api/runs", params={"any_tag": ["good", "new"]})["total"] == 2
    assert service.get("/api/runs", params={"no_tag": "good"})["total"] == 2
    assert service.get(f"/api/runs/{ids[0]}")["tags"] == ["new"]


def test_tags_and_notes_that_cannot_be_are_refused(service: Service):
    [run_id] = service.launch()
    refused = service.client.post("/api/runs/tags", json={"run_ids": [run_id], "add": ["a,b"]})
    assert (refused.status_code, problem_fields(refused)) == (422, ["add"])
    assert service.client.post("/api/runs/tags", json={"run_ids": ["nope"], "add": ["a"]}).status_code == 404
    assert service.client.put(f"/api/runs/{run_id}/notes", json={"notes": "x" * 10_001}).status_code == 422
    assert service.client.put("/api/runs/nope/notes", json={"notes": "x"}).status_code == 404


def test_notes_come_back_as_they_were_written(service: Service):
    [run_id] = service.launch()
    service.client.put(f"/api/runs/{run_id}/notes", json={"notes": "<script>alert(1)</script>"})
    answer = service.client.get(f"/api/runs/{run_id}")
    assert answer.json()["notes"] == "<script>alert(1)</script>"
    assert answer.headers["content-type"] == "application/json"


def test_views_are_saved_for_everyone(service: Service):
    saved = service.client.post("/api/views", json={"name": "Best", "search": "sort=success"})
    assert saved.status_code == 201
    view = saved.json()
    again = service.client.post("/api/views", json={"name": "Best", "search": ""})
    assert (again.status_code, "called 'Best' already" in again.text) == (409, True)
    renamed = service.client.patch(f"/api/views/{view['id']}", json={"name": "The best"})
    assert (renamed.json()["name"], renamed.json()["search"]) == ("The best", "sort=success")
    assert [found["name"] for found in service.get("/api/views")["views"]] == ["The best"]
    assert service.client.delete(f"/api/views/{view['id']}").status_code == 204
    assert service.client.delete(f"/api/views/{view['id']}").status_code == 404
