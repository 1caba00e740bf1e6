"""Webhooks, notices and making room, over HTTP and as typed."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from live_api import Service, problem_fields

from backend.store.outcomes import Failed
from backend.store.queue import finish

URL = "https://chat.example.org/hooks/abc"


def fail_one(service: Service) -> str:
    service.launch()
    held = service.claim()
    service.write_file(held, "policy-epoch-0001.pt", b"weights")
    finish(service.database, held, Failed("It broke.", retry=False))
    return held.run_id


def test_a_webhook_shows_its_secret_once(service: Service):
    added = service.client.post("/api/webhooks", json={"url": URL, "events": ["run_failed", "run_failed"]})
    assert added.status_code == 201
    assert (len(added.json()["secret"]), added.json()["events"]) == (64, ["run_failed"])
    listed = service.client.get("/api/webhooks")
    assert added.json()["secret"] not in listed.text
    (webhook,) = listed.json()["webhooks"]
    tested = service.client.post(f"/api/webhooks/{webhook['id']}/test")
    assert (tested.status_code, tested.json()["state"], tested.json()["event"]) == (202, "waiting", "test")
    assert service.client.delete(f"/api/webhooks/{webhook['id']}").status_code == 204
    assert service.get("/api/webhooks") == {"webhooks": []}


@pytest.mark.parametrize("url", ["ftp://a.example", "https://u:p@a.example/", "javascript:alert(1)"])
def test_an_address_that_cannot_be_told_is_refused_at_its_field(unused_service: Service, url: str):
    answer = unused_service.client.post("/api/webhooks", json={"url": url, "events": ["run_failed"]})
    assert (answer.status_code, problem_fields(answer)) == (422, ["url"])


def test_an_open_page_hears_what_has_happened(service: Service):
    begun = datetime.now(UTC).isoformat()
    run_id = fail_one(service)
    answer = service.get("/api/notices", params={"since": begun})
    (notice,) = answer["notices"]
    assert (notice["event"], notice["subject"], notice["path"]) == ("run_failed", run_id, f"/runs/{run_id}")
    assert service.get("/api/notices", params={"since": answer["now"]})["notices"] == []
    assert service.client.get("/api/notices", params={"since": "2026-01-01T00:00:00"}).status_code == 422
    outside = service.client.get("/api/notices", params={"since": "9999-12-31T23:59:59-14:00"})
    assert (outside.status_code, problem_fields(outside)) == (422, ["since"])


def test_a_preview_says_what_applying_does(service: Service):
    run_id = fail_one(service)
    preview = service.get("/api/retention", params={"kind": ["policies", "episodes"], "older_than_days": 0})
    assert preview["kinds"] == [
        {"kind": "episodes", "files": 0, "size": 0},
        {"kind": "policies", "files": 1, "size": 7},
    ]
    assert [(run["run_id"], run["files"]) for run in preview["runs"]] == [(run_id, 1)]
    young = service.get("/api/retention", params={"kind": "policies"})
    assert (young["total_runs"], young["spared_young"]) == (0, 1)
    applied = service.client.post("/api/retention", json={"kinds": ["policies"], "older_than_days": 0})
    assert applied.json() == {"runs": 1, "files": 1, "size": 7, "left": 0}
    assert service.get(f"/api/runs/{run_id}/files") == {"files": []}
