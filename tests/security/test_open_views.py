"""A 3D view that is open ends with the sign-in of whoever watches it, and with nobody else's."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import httpx
import pytest
from guarded_api import Guarded
from live_api import Service
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect
from websockets.sync.connection import Connection
from websockets.sync.server import ServerConnection, serve
from websockets.typing import Origin

from backend.api import viewer_proxy
from backend.store import viewer_sessions
from backend.store.access import accounts

CUT_WITHIN_S = 60.0
"""The view is cut off by then, even on a busy machine [s]; at work it is asked every `TOUCH_INTERVAL_S`."""


@pytest.fixture(autouse=True)
def asked_often(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ask often whether whoever watches is still signed in."""
    monkeypatch.setattr(viewer_proxy, "TOUCH_INTERVAL_S", 0.02)


@pytest.fixture(scope="module")
def view_url(api: Guarded) -> Iterator[str]:
    """Return the address of a ready 3D session, whose server says everything back."""

    def echo(connection: ServerConnection) -> None:
        for message in connection:
            connection.send(message)

    service = Service(api.programs["operator"], api.settings, api.database)
    service.launch()
    held = service.claim()
    service.write_file(held, "policy-newest.pt", b"policy")
    viewer_sessions.beat_host(api.database, "host", 1)
    wish = {"kind": "live", "run_id": held.run_id}
    session = service.client.post("/api/viewer-sessions", json=wish).raise_for_status().json()
    with serve(echo, "127.0.0.1", 0, compression=None) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        viewer_sessions.mark_ready(api.database, session["id"], server.socket.getsockname()[1], "the newest policy")
        yield service.get(f"/api/viewer-sessions/{session['id']}")["url"]
        server.shutdown()
        thread.join()


def watch(api: Guarded, view_url: str, who: dict[str, str]) -> ClientConnection:
    """Open the view's websocket, as the 3D page does."""
    address = f"{api.address.replace('http', 'ws')}{view_url}"
    return connect(address, origin=Origin(api.address), additional_headers=who, proxy=None, compression=None)


def cookies_of(browser: httpx.Client) -> dict[str, str]:
    """Return the header with which a browser shows its session."""
    return {"Cookie": "; ".join(f"{name}={value}" for name, value in browser.cookies.items())}


def goes_on(view: Connection) -> bool:
    """Tell whether messages still pass."""
    view.send("still there?")
    return view.recv(timeout=CUT_WITHIN_S) == "still there?"


def assert_cut_off(view: Connection) -> None:
    """Wait until the server has closed a view."""
    with pytest.raises(ConnectionClosed):
        view.recv(timeout=CUT_WITHIN_S)


def sign_out(api: Guarded, browser: httpx.Client) -> None:
    """Sign out in the browser that watches."""
    assert browser.post("/api/auth/sign-out").status_code == 204


def end_from_elsewhere(api: Guarded, browser: httpx.Client) -> None:
    """End the session from another browser of the same account, as after a theft."""
    [own] = [one for one in browser.get("/api/account/sessions").json()["sessions"] if one["is_this"]]
    assert api.sign_in("viewer").delete(f"/api/account/sessions/{own['id']}").status_code == 204


@pytest.mark.parametrize("end", [sign_out, end_from_elsewhere])
def test_ending_a_session_cuts_its_open_view(
    api: Guarded, view_url: str, end: Callable[[Guarded, httpx.Client], None]
) -> None:
    browser, other = api.sign_in("viewer"), api.sign_in("operator")
    with watch(api, view_url, cookies_of(browser)) as view, watch(api, view_url, cookies_of(other)) as others:
        assert goes_on(view)
        end(api, browser)
        assert_cut_off(view)
        assert goes_on(others), "somebody else's view was cut off too"


def test_revoking_a_token_cuts_the_view_of_its_program(api: Guarded, view_url: str) -> None:
    browser = api.sign_in("viewer")
    wish = {"name": "notebook", "role": "viewer", "days": 1}
    made = browser.post("/api/account/tokens", json=wish).raise_for_status().json()
    with watch(api, view_url, {"Authorization": f"Bearer {made['secret']}"}) as view:
        assert goes_on(view)
        assert browser.delete(f"/api/account/tokens/{made['token']['id']}").status_code == 204
        assert_cut_off(view)


def test_closing_an_account_cuts_all_its_views(api: Guarded, view_url: str) -> None:
    [viewer] = [one for one in accounts.list_accounts(api.database) if one.name == "viewer"]
    address = f"/api/accounts/{viewer.id}"
    with watch(api, view_url, cookies_of(api.sign_in("viewer"))) as view:
        assert goes_on(view)
        assert api.programs["admin"].patch(address, json={"disabled": True}).status_code == 200
        assert_cut_off(view)
    assert api.programs["admin"].patch(address, json={"disabled": False}).status_code == 200
