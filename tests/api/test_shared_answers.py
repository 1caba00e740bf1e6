"""Answers that are given again: to whom, for how long, and never to whoever may not have them."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from types import SimpleNamespace
from typing import Any

import pytest
from fastapi.routing import APIRoute
from live_api import Service
from starlette.datastructures import Headers

from backend.api.access.declarations import declaration_of, needs
from backend.api.app import ROUTES
from backend.api.freshness import OLDEST_S, accepted_age
from backend.api.shared_answers import SharedAnswers
from backend.store.database import Database, open_database
from backend.store.launches import LaunchOrder, launch

PATIENT = {"cache-control": "max-age=5"}
ORDER = LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke")


@pytest.fixture
def elsewhere(service: Service) -> Iterator[Database]:
    """Return the store as another process sees it."""
    with closing(open_database(service.settings)) as database:
        yield database


def total(service: Service, **headers: str) -> int:
    """Return how many runs an answer tells of."""
    return service.get("/api/runs", headers=headers)["total"]


def test_whoever_says_nothing_gets_a_new_answer(service: Service, elsewhere: Database) -> None:
    assert total(service) == 0
    launch(elsewhere, ORDER)
    assert total(service) == 1


def test_whoever_takes_an_older_answer_gets_it_until_this_server_writes(service: Service, elsewhere: Database) -> None:
    assert total(service, **PATIENT) == 0
    launch(elsewhere, ORDER)
    assert total(service, **PATIENT) == 0, "it was made anew"
    body = {"task": "FetchPush", "phase": "manipulation", "method": "ddpg", "seeds": [0], "preset": "smoke"}
    service.client.post("/api/launches", json=body).raise_for_status()
    assert total(service, **PATIENT) == 2


def test_another_question_has_another_answer(service: Service) -> None:
    service.launch()
    assert total(service, **PATIENT) == 1
    assert service.get("/api/runs?method=ddpg", headers=PATIENT)["total"] == 0


def test_an_answer_that_is_known_is_not_sent_again(service: Service) -> None:
    service.launch()
    first = service.client.get("/api/runs")
    known = {"if-none-match": first.headers["etag"], **PATIENT}
    assert first.headers["cache-control"] == "private, no-cache"
    again = service.client.get("/api/runs", headers=known)
    assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", first.headers["etag"])
    service.launch("ddpg")
    assert service.client.get("/api/runs", headers=known).status_code == 200


def test_the_time_in_a_packed_answer_makes_no_other_answer(service: Service) -> None:
    for seed in range(4):
        service.launch(seeds=(seed,))
    first = service.client.get("/api/runs")
    assert first.headers["content-encoding"] == "gzip"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("time.time", lambda: 2_000_000_000.0)
        assert service.client.get("/api/runs").headers["etag"] == first.headers["etag"]


def test_nobody_gets_what_somebody_was_just_told(service: Service) -> None:
    service.get("/api/runs", headers=PATIENT)
    secret = service.client.headers.pop("authorization")
    assert service.client.get("/api/runs", headers=PATIENT).status_code == 401
    service.client.headers["authorization"] = secret


def test_refusals_are_not_kept(service: Service) -> None:
    answer = service.client.get("/api/runs/nope", headers=PATIENT)
    assert answer.status_code == 404
    assert "etag" not in answer.headers


def test_only_reading_what_every_role_may_read_is_shared() -> None:
    routes = [route for module in ROUTES for route in module.router.routes if isinstance(route, APIRoute)]
    shared = {
        route.path: (route.methods, declared.role)
        for route in routes
        if (declared := declaration_of(route.endpoint)) is not None and declared.is_shared
    }
    assert {"/api/runs", "/api/queue", "/api/compare", "/api/runs/{run_id}/metrics", "/healthz"} <= shared.keys()
    assert {
        path for path, (methods, role) in shared.items() if methods != {"GET"} or role not in ("viewer", None)
    } == set()
    assert not {path for path in shared if path.startswith(("/api/auth", "/api/account", "/api/webhooks"))}
    with pytest.raises(AssertionError):
        needs("operator", shared=True)


@pytest.mark.parametrize(
    ("asked", "seconds"),
    [
        ("", 0),
        ("no-cache", 0),
        ("max-age=0", 0),
        ("max-age=1", 1),
        ("no-transform, Max-Age=2", 2),
        ("max-age=3600", OLDEST_S),
        ("s-max-age=1", 0),
        ("max-age=-1", 0),
        ("max-age=1x", 0),
    ],
)
def test_how_old_an_answer_may_be(asked: str, seconds: float) -> None:
    assert accepted_age(Headers({"cache-control": asked})) == seconds


def test_a_crowd_that_asks_at_once_makes_one_answer() -> None:
    made = 0

    @needs("viewer", shared=True)
    def endpoint() -> None: ...

    async def app(scope: Any, receive: Any, send: Any) -> None:
        nonlocal made
        made += 1
        scope["endpoint"] = endpoint
        await asyncio.sleep(0.01)
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"%d" % made})

    shared = SharedAnswers(app)
    store = SimpleNamespace(writes=0)
    owner = SimpleNamespace(state=SimpleNamespace(service=SimpleNamespace(database=store)))

    async def ask() -> bytes:
        sent: list[Any] = []

        async def send(message: Any) -> None:
            sent.append(message)

        headers = [(b"cache-control", b"max-age=1")]
        scope = {"type": "http", "method": "GET", "path": "/x", "query_string": b"", "headers": headers, "app": owner}
        await shared(scope, None, send)  # type: ignore[arg-type]
        return sent[-1]["body"]

    async def crowd() -> list[bytes]:
        first = await ask()
        store.writes += 1
        return [first, *await asyncio.gather(*(ask() for _ in range(20)))]

    # In a thread of its own, as a browser of other tests may have left a loop that runs in this one.
    with ThreadPoolExecutor(max_workers=1) as thread:
        answers = thread.submit(lambda: asyncio.run(crowd())).result()
    assert answers == [b"1", *[b"2"] * 20]
