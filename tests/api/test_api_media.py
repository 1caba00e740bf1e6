"""Videos are ordered once and found among the run's files; every run has a picture as soon as its task has."""

from __future__ import annotations

from typing import Any

import pytest
from live_api import Service, problem_fields

from backend.store.media_jobs import MadeFile, claim_media, fail_media, finish_media
from backend.store.thumbnails import plan_thumbnail

CONTENT = b"a video of a block" * 100
SOURCE = "episodes-epoch-0012.npz"


@pytest.fixture
def run_id(service: Service) -> str:
    """Return a run with a policy and recorded episodes."""
    service.launch()
    held = service.claim()
    for name in ("policy-newest.pt", SOURCE):
        service.write_file(held, name, b"numbers")
    return held.run_id


def order(service: Service, run_id: str, **changes: Any) -> Any:
    return service.client.post(f"/api/runs/{run_id}/videos", json={"epoch": 12, "number": 1, **changes})


def draw(service: Service, name: str) -> None:
    """Fill the order that waits longest, as the viewer host does."""
    job = claim_media(service.database)
    assert job is not None
    path = service.settings.run_directory(job.run_id) / name
    path.write_bytes(CONTENT)
    place = str(path.relative_to(service.settings.home))
    finish_media(service.database, job, MadeFile(place, len(CONTENT), "e" * 64))


def test_a_video_is_ordered_once_and_played_in_pieces(service: Service, run_id: str):
    first = order(service, run_id, width=320, height=240)
    assert first.status_code == 202
    video = first.json()
    assert (video["state"], video["url"], video["epoch"], video["number"]) == ("queued", None, 12, 1)
    assert video["name"] == "video-epoch-0012-episode-1-320x240.mp4"
    draw(service, video["name"])
    done = order(service, run_id, width=320, height=240).json()
    assert (done["id"], done["state"]) == (video["id"], "done")
    assert service.get(f"/api/runs/{run_id}/videos")["videos"] == [done]
    piece = service.client.get(done["url"], headers={"range": "bytes=2-6"})
    assert (piece.status_code, piece.content) == (206, CONTENT[2:7])
    assert piece.headers["content-type"] == "video/mp4"
    assert piece.headers["content-disposition"].startswith("inline")
    assert "content-encoding" not in service.client.get(done["url"]).headers


def test_the_newest_policy_can_be_filmed_without_a_recording(service: Service, run_id: str):
    video = order(service, run_id, epoch=None, number=5, format="webm").json()
    assert video["name"] == "video-newest-policy-episode-5-640x480.webm"


def test_one_that_failed_says_why_and_is_tried_again(service: Service, run_id: str):
    order(service, run_id)
    job = claim_media(service.database)
    assert job is not None
    fail_media(service.database, job, "MuJoCo cannot draw off screen here.")
    [video] = service.get(f"/api/runs/{run_id}/videos")["videos"]
    assert (video["state"], video["reason"]) == ("failed", "MuJoCo cannot draw off screen here.")
    assert order(service, run_id).json()["state"] == "queued"


@pytest.mark.parametrize(
    ("changes", "field"),
    [({"width": 330}, "width"), ({"height": 4000}, "height"), ({"format": "gif"}, "format"), ({"fps": 9}, "fps")],
)
def test_what_cannot_be_made_is_refused_at_its_field(service: Service, run_id: str, changes: Any, field: str):
    answer = order(service, run_id, **changes)
    assert answer.status_code == 422
    assert problem_fields(answer) == [field]


def test_episodes_that_were_not_recorded_are_named(service: Service, run_id: str):
    answer = order(service, run_id, epoch=13)
    assert answer.status_code == 404
    assert f"there are: {SOURCE}" in answer.json()["problems"][0]["message"]


def test_a_run_without_a_policy_cannot_be_filmed_yet(service: Service):
    [run_id] = service.launch()
    assert order(service, run_id, epoch=None).status_code == 409
    assert service.client.post("/api/runs/nobody/videos", json={}).status_code == 404


def test_a_run_without_a_thumbnail_shows_its_task(service: Service, run_id: str):
    thumbnail = f"/api/runs/{run_id}/thumbnail"
    assert service.client.get(thumbnail).status_code == 404
    service.settings.pictures_directory.mkdir()
    (service.settings.pictures_directory / "FetchPush.png").write_bytes(b"a picture")
    assert service.client.get(thumbnail, follow_redirects=True).content == b"a picture"
    plan_thumbnail(service.database)
    draw(service, "thumbnail.webp")
    answer = service.client.get(thumbnail)
    assert (answer.status_code, answer.content) == (200, CONTENT)
    assert answer.headers["content-type"] == "image/webp"
    assert answer.headers["cache-control"] == "no-cache"
