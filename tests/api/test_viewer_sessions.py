"""Asking for 3D sessions, and the proxy that leads to them."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from html import unescape
from http import HTTPStatus
from pathlib import Path

import pytest
import viser
from live_api import Service, problem_fields
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.http11 import Request, Response
from websockets.sync.client import ClientConnection, connect
from websockets.sync.server import ServerConnection, serve
from websockets.typing import Origin, Subprotocol

from backend.api import viewer_proxy
from backend.api.tokens import TOKEN_LIFETIME, BadToken, ViewerTokens, load_secret
from backend.store import viewer_sessions
from backend.store.launches import LaunchOrder, launch

PROTOCOL = Subprotocol("viser-v1.1.1")
BROWSER = {"accept": "text/html"}


@dataclass(frozen=True)
class View:
    """A session that is ready, and the addresses that lead to it."""

    session_id: str
    url: str
    socket_url: str
    origin: Origin
    headers: dict[str, str]
    """What shows who watches."""


@contextmanager
def echo_server() -> Iterator[int]:
    """Stand in for Viser: a page over HTTP, and a websocket that says everything back."""

    def page(connection: ServerConnection, request: Request) -> Response | None:
        if request.headers.get("Upgrade") == "websocket":
            return None
        body = f"page {request.path}".encode()
        headers = Headers({"Content-Type": "text/html", "Content-Length": str(len(body))})
        return Response(HTTPStatus.OK, "OK", headers, body)

    def echo(connection: ServerConnection) -> None:
        for message in connection:
            if message == "end":
                connection.close(4001, "ended as asked")
            connection.send(message)

    with serve(
        echo, "127.0.0.1", 0, process_request=page, subprotocols=[PROTOCOL], compression=None, max_size=None
    ) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server.socket.getsockname()[1]
        server.shutdown()
        thread.join()


def open_session(service: Service, port: int) -> View:
    """Take a session from the wish to the address, as page and viewer host do."""
    service.launch()
    held = service.claim()
    service.write_file(held, "policy-newest.pt", b"policy")
    viewer_sessions.beat_host(service.database, "host", 1)
    session = service.client.post("/api/viewer-sessions", json={"kind": "live", "run_id": held.run_id}).json()
    viewer_sessions.mark_ready(service.database, session["id"], port, "the newest policy", control_port=port)
    url = service.get(f"/api/viewer-sessions/{session['id']}")["url"]
    address = str(service.client.base_url).rstrip("/")
    socket_url = address.replace("http", "ws") + url.rstrip("/")
    headers = {"Authorization": service.client.headers["Authorization"]}
    return View(session["id"], url, socket_url, Origin(address), headers)


def dial(view: View, **options: object) -> ClientConnection:
    """Connect as the 3D page does."""
    given = {"origin": view.origin, "subprotocols": [PROTOCOL], "proxy": None, "max_size": None}
    given |= {"additional_headers": view.headers} | options
    return connect(view.socket_url, **given)  # type: ignore[arg-type]


@pytest.fixture
def view(service: Service) -> Iterator[View]:
    """Return a session that the echo server serves."""
    with echo_server() as port:
        yield open_session(service, port)


def test_a_run_without_a_policy_cannot_be_watched(service: Service):
    [run_id] = service.launch()
    answer = service.client.post("/api/viewer-sessions", json={"kind": "live", "run_id": run_id})
    assert answer.status_code == 409
    assert problem_fields(answer) == ["run_id"]


def test_an_unknown_run_cannot_be_watched(unused_service: Service):
    assert (
        unused_service.client.post("/api/viewer-sessions", json={"kind": "live", "run_id": "nope"}).status_code == 404
    )


def test_a_session_needs_a_run(unused_service: Service):
    answer = unused_service.client.post("/api/viewer-sessions", json={"kind": "live"})
    assert (answer.status_code, problem_fields(answer)) == (422, ["live.run_id"])


def test_without_a_viewer_host_a_session_says_how_to_start_one(service: Service):
    service.launch()
    held = service.claim()
    service.write_file(held, "policy-newest.pt", b"policy")
    answer = service.client.post("/api/viewer-sessions", json={"kind": "live", "run_id": held.run_id})
    assert answer.status_code == 503
    assert "sldr viewer" in answer.json()["problems"][0]["message"]


def test_a_session_has_an_address_that_stays_the_same_once_it_is_ready(service: Service, view: View):
    session = service.get(f"/api/viewer-sessions/{view.session_id}")
    assert (session["state"], session["url"], session["message"]) == ("ready", view.url, "the newest policy")


@pytest.mark.parametrize("method", ["GET", "DELETE"])
def test_an_unknown_session_is_not_found(unused_service: Service, method: str):
    assert unused_service.client.request(method, "/api/viewer-sessions/nope").status_code == 404


def test_a_page_is_fetched_below_the_token(service: Service, view: View):
    assert service.client.get(f"{view.url}a/b.js").text == "page /a/b.js"
    answer = service.client.get(view.url)
    assert (answer.text, answer.headers["content-type"]) == ("page /", "text/html")
    assert answer.headers["referrer-policy"] == "no-referrer"


def test_the_address_without_its_slash_leads_to_the_page(service: Service, view: View):
    answer = service.client.get(view.url.rstrip("/"))
    assert answer.is_redirect
    assert answer.headers["location"].endswith(view.url)


def test_messages_pass_both_ways_whole_and_of_any_size(view: View):
    large = bytes(range(256)) * 4096 * 17
    with dial(view) as socket:
        socket.send("text")
        socket.send(large)
        assert socket.recv() == "text"
        assert socket.recv() == large


def test_the_subprotocol_is_passed_both_ways_and_nothing_is_compressed(view: View):
    with dial(view) as socket:
        assert socket.subprotocol == PROTOCOL
        assert socket.response is not None
        assert "Sec-WebSocket-Extensions" not in socket.response.headers


def test_the_end_of_the_server_ends_the_page_with_its_reason(view: View):
    with dial(view) as socket:
        socket.send("end")
        with pytest.raises(ConnectionClosed) as caught:
            socket.recv()
    assert caught.value.rcvd is not None
    assert (caught.value.rcvd.code, caught.value.rcvd.reason) == (4001, "ended as asked")


def test_watching_keeps_a_session_awake(service: Service, view: View):
    before = viewer_sessions.get_session(service.database, view.session_id).touched_at
    with dial(view):
        after = viewer_sessions.get_session(service.database, view.session_id).touched_at
    assert after > before


def test_closing_a_session_closes_its_view(service: Service, view: View, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(viewer_proxy, "TOUCH_INTERVAL_S", 0.05)
    with dial(view) as socket:
        assert service.client.delete(f"/api/viewer-sessions/{view.session_id}").status_code == 204
        with pytest.raises(ConnectionClosed):
            socket.recv(timeout=5)
    answer = service.client.get(view.url)
    assert answer.status_code == 404
    assert "has ended" in answer.json()["problems"][0]["message"]


@pytest.mark.parametrize("origin", [None, Origin("http://evil.example"), Origin("null")])
def test_a_page_of_another_origin_is_refused(view: View, origin: Origin | None):
    with pytest.raises(InvalidStatus) as refused:
        dial(view, origin=origin)
    assert refused.value.response.status_code == 403
    assert b"from a page of this server" in (refused.value.response.body or b"")


def test_a_wrong_token_is_refused_in_words(unused_service: Service):
    answer = unused_service.client.get("/viewer/made-up/")
    page = unused_service.client.get("/viewer/made-up/", headers=BROWSER)
    assert (answer.status_code, page.status_code) == (403, 403)
    assert answer.json()["problems"][0]["message"] in unescape(page.text)


def test_a_wrong_token_opens_no_websocket(view: View):
    stranger = View(view.session_id, view.url, f"{view.socket_url}x", view.origin, view.headers)
    with pytest.raises(InvalidStatus) as refused:
        dial(stranger)
    assert refused.value.response.status_code == 403


def test_an_expired_token_is_refused_in_words(service: Service):
    long_ago = datetime.now(UTC) - TOKEN_LIFETIME - timedelta(seconds=1)
    token = ViewerTokens(load_secret(service.settings.secret_path)).sign("session", long_ago)
    answer = service.client.get(f"/viewer/{token}/")
    assert answer.status_code == 403
    assert "expired" in answer.json()["problems"][0]["message"]


def test_a_token_of_another_server_is_not_valid():
    token = ViewerTokens(b"one").sign("session", datetime.now(UTC))
    with pytest.raises(BadToken, match="not valid"):
        ViewerTokens(b"two").read(token)


def test_the_secret_stays_the_same(tmp_path: Path):
    path = tmp_path / "new" / "secret"
    assert load_secret(path) == load_secret(path)
    assert [file.name for file in path.parent.iterdir()] == ["secret"]


def test_a_server_that_died_is_said_not_to_answer(service: Service):
    with echo_server() as port:
        view = open_session(service, port)
    answer = service.client.get(view.url)
    with pytest.raises(InvalidStatus) as refused:
        dial(view)
    assert (answer.status_code, refused.value.response.status_code) == (502, 502)
    assert "does not answer" in answer.json()["problems"][0]["message"]


def test_a_page_that_may_yet_answer_is_asked_for_again_and_one_that_has_ended_is_not(service: Service):
    with echo_server() as port:
        view = open_session(service, port)
    silent = service.client.get(view.url, headers=BROWSER)
    service.client.delete(f"/api/viewer-sessions/{view.session_id}")
    ended = service.client.get(view.url, headers=BROWSER)

    assert (silent.status_code, silent.headers["refresh"]) == (502, "2")
    assert "its machine may be busy" in silent.text
    assert (ended.status_code, "refresh" in ended.headers) == (404, False)


def test_viser_itself_is_reached_through_the_proxy(service: Service):
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    server.scene.add_icosphere("/ball", radius=0.1)
    try:
        view = open_session(service, server.get_port())
        page = service.client.get(view.url, headers={"accept-encoding": "gzip"})
        with dial(view) as socket:
            first = socket.recv(timeout=5)
    finally:
        server.stop()
    assert "<html" in page.text
    assert page.headers["content-encoding"] == "gzip"
    assert isinstance(first, bytes)


def test_commands_and_states_pass_below_the_same_token(view: View):
    control = View(view.session_id, view.url, f"{view.socket_url}/control", view.origin, view.headers)
    with dial(control) as socket:
        socket.send('{"do": "pause"}')
        assert socket.recv() == '{"do": "pause"}'


@pytest.mark.parametrize(("origin", "token_end"), [(Origin("http://evil.example"), ""), (None, "x")])
def test_commands_of_strangers_are_refused(view: View, origin: Origin | None, token_end: str):
    control = View(
        view.session_id, view.url, f"{view.socket_url}{token_end}/control", origin or view.origin, view.headers
    )
    with pytest.raises(InvalidStatus) as refused:
        dial(control, subprotocols=None)
    assert refused.value.response.status_code == 403


def test_the_request_is_kept_as_it_was_asked(service: Service):
    with echo_server() as port:
        view = open_session(service, port)
    kept = viewer_sessions.get_session(service.database, view.session_id).request
    assert kept == {"kind": "live", "policy": "newest", "episodes": 1, "beside": None}


def test_a_policy_that_the_run_has_not_got_is_named(service: Service, view: View):
    run_id = service.get(f"/api/viewer-sessions/{view.session_id}")["run_id"]
    answer = service.client.post(
        "/api/viewer-sessions", json={"kind": "live", "run_id": run_id, "policy": "policy-epoch-0007.pt"}
    )
    assert (answer.status_code, problem_fields(answer)) == (409, ["policy"])
    assert "it has newest, policy-newest.pt" in answer.json()["problems"][0]["message"]


def test_a_policy_of_another_task_cannot_stand_beside(service: Service, view: View):
    run_id = service.get(f"/api/viewer-sessions/{view.session_id}")["run_id"]
    [other] = service.launch(task="FetchSlide")
    body = {"kind": "live", "run_id": run_id, "beside": {"run_id": other}}
    answer = service.client.post("/api/viewer-sessions", json=body)
    assert (answer.status_code, problem_fields(answer)) == (409, ["beside.run_id"])
    assert f"Run {other} learns FetchSlide" in answer.json()["problems"][0]["message"]


def test_a_checkpoint_of_another_task_cannot_stand_beside(service: Service, view: View):
    run_id = service.get(f"/api/viewer-sessions/{view.session_id}")["run_id"]
    [other] = service.launch(task="FetchSlide")
    service.write_file(service.claim(), "checkpoint.pt", b"checkpoint")
    body = {"kind": "live", "run_id": run_id, "beside": {"run_id": other, "policy": "checkpoint.pt"}}
    answer = service.client.post("/api/viewer-sessions", json=body)
    assert (answer.status_code, problem_fields(answer)) == (409, ["beside.run_id"])


def inspect(service: Service, run_id: str) -> tuple[int, str]:
    """Ask for the demonstrations of a run; return the status and the sentence that refuses it."""
    answer = service.client.post("/api/viewer-sessions", json={"kind": "inspector", "run_id": run_id})
    return answer.status_code, answer.json()["problems"][0]["message"]


def test_the_demonstrations_of_an_unknown_run_are_not_found(unused_service: Service):
    status, sentence = inspect(unused_service, "nope")
    assert status == 404
    assert "nope" in sentence


def test_a_robot_s_run_has_no_demonstrations(service: Service):
    [run_id] = service.launch()
    status, sentence = inspect(service, run_id)
    assert status == 409
    assert sentence == f"In run {run_id} the robot acts; demonstrations are those of locomotion runs."


def test_before_its_first_test_a_locomotion_run_has_no_model(service: Service):
    [run_id] = launch(service.database, LaunchOrder("FetchPush", "locomotion", "her", (0,), "smoke"))
    service.write_file(service.claim(), "checkpoint.pt", b"checkpoint")
    status, sentence = inspect(service, run_id)
    assert status == 409
    assert sentence == f"Run {run_id} has no locomotion model yet; wait for its first test."


def test_no_checkpoint_can_be_chosen_for_demonstrations(service: Service):
    [run_id] = service.launch()
    body = {"kind": "inspector", "run_id": run_id, "policy": "checkpoint.pt"}
    answer = service.client.post("/api/viewer-sessions", json=body)
    assert (answer.status_code, problem_fields(answer)) == (422, ["inspector.policy"])
