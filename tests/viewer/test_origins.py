"""Viser's own port: open to the proxy and, where it is asked for, to its own page; to no page of another site."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import viser
from websockets.datastructures import Headers
from websockets.exceptions import InvalidStatus
from websockets.http11 import Request
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin, Subprotocol

from worker.viewer.origins import is_welcome
from worker.viewer.page import open_page

PATIENCE_S = 30.0


@pytest.fixture(scope="module", params=[False, True], ids=["behind the proxy", "alone"])
def is_alone(request: pytest.FixtureRequest) -> bool:
    return request.param


@pytest.fixture(scope="module")
def server(is_alone: bool) -> Iterator[viser.ViserServer]:
    server = open_page(is_alone=is_alone)
    yield server
    server.stop()


def dial(server: viser.ViserServer, origin: str | None, name: str = "127.0.0.1") -> ClientConnection:
    return connect(
        f"ws://{name}:{server.get_port()}/",
        proxy=None,
        origin=None if origin is None else Origin(origin),
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        compression=None,
    )


def test_a_program_is_let_in(server):
    with dial(server, origin=None) as proxy:
        assert proxy.recv(PATIENCE_S)


@pytest.mark.parametrize("origin", ["http://evil.example", "http://127.0.0.1:1", "null", "http://localhost"])
def test_a_page_of_another_site_is_refused(server, origin):
    with pytest.raises(InvalidStatus) as refused:
        dial(server, origin)
    assert refused.value.response.status_code == 403


@pytest.mark.parametrize("name", ["127.0.0.1", "localhost"])
def test_its_own_page_is_let_in_where_browsers_open_it(server, is_alone, name):
    origin = f"http://{name}:{server.get_port()}"
    if not is_alone:
        with pytest.raises(InvalidStatus):
            dial(server, origin, name)
        return
    with dial(server, origin, name) as page:
        assert page.recv(PATIENCE_S)


def test_a_name_that_somebody_makes_lead_here_is_refused():
    headers = Headers({"Host": "evil.example:8080", "Origin": "http://evil.example:8080", "Upgrade": "websocket"})
    assert not is_welcome(Request("/", headers), allow_own=True)
