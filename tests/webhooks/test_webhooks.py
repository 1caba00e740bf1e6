"""Sending: only to addresses that may be told, signed, without following anyone anywhere."""

from __future__ import annotations

import hashlib
import hmac
import ipaddress
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from backend.store.database import Database
from backend.store.webhooks import Delivery, Taken, add_test, add_webhook, list_webhooks
from backend.webhooks.messages import sign, trial_body
from backend.webhooks.sender import Sender, send
from backend.webhooks.targets import TargetRefused, check_url, find_target, why_refused
from sldr_core.errors import InvalidConfig

FEW = settings(max_examples=40)
"""Of each kind of address: every one is judged in microseconds, and making them up takes longer."""
NOW = datetime(2026, 1, 1, tzinfo=UTC)


class Listener(BaseHTTPRequestHandler):
    """Hold what came, and answer as the test wants."""

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self.server.heard.append((self.path, dict(self.headers), body))  # type: ignore[attr-defined]
        self.send_response(self.server.status)  # type: ignore[attr-defined]
        self.send_header("Location", "http://127.0.0.1:1/elsewhere")
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, format: str, *args: object) -> None:
        pass


@contextmanager
def listening(status: int = 200) -> Iterator[tuple[int, list[Any]]]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), Listener)
    server.heard, server.status = [], status  # type: ignore[attr-defined]
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    try:
        yield server.server_address[1], server.heard  # type: ignore[attr-defined]
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


def taken(url: str, body: str = "{}") -> Taken:
    delivery = Delivery("d1", "w1", "test", body, "waiting", 1, None, NOW, None, NOW)
    return Taken(delivery, url, "5ec2e7")


def test_a_message_arrives_signed_under_the_name_as_written():
    with listening(204) as (port, heard):
        problem = send(taken(f"http://hooks.example:{port}/in?x=1", '{"a": 1}'), True, lambda *_: ["127.0.0.1"])
    assert problem is None
    ((path, headers, body),) = heard
    assert (path, headers["Host"], body) == ("/in?x=1", f"hooks.example:{port}", b'{"a": 1}')
    signed = f"{headers['X-SLDR-Timestamp']}.".encode() + body
    assert headers["X-SLDR-Signature"] == "sha256=" + hmac.new(b"5ec2e7", signed, hashlib.sha256).hexdigest()
    assert (headers["X-SLDR-Event"], headers["X-SLDR-Delivery"]) == ("test", "d1")


def test_a_signature_by_hand():
    # printf '1.{}' | openssl dgst -sha256 -hmac key
    assert sign("key", 1, b"{}") == "sha256=" + hmac.digest(b"key", b"1.{}", "sha256").hex()
    assert sign("key", 1, b"{}") != sign("key", 2, b"{}") != sign("kex", 2, b"{}")


@pytest.mark.parametrize("status", [301, 307, 404, 500])
def test_no_one_is_followed_and_every_refusal_is_told(status: int):
    with listening(status) as (port, heard):
        problem = send(taken(f"http://127.0.0.1:{port}/"), allow_local=True)
    assert (problem, len(heard)) == (f"The service answered with status {status}.", 1)


def test_whoever_is_away_is_told(free_port: int):
    problem = send(taken(f"http://127.0.0.1:{free_port}/"), allow_local=True)
    assert problem is not None
    assert problem.startswith("The service could not be reached")


def test_this_machine_is_not_told_unless_allowed():
    with listening() as (port, heard):
        for host in ("127.0.0.1", "localhost", "[::1]", "2130706433", "0x7f000001", "127.1", "[::ffff:127.0.0.1]"):
            problem = send(taken(f"http://{host}:{port}/"), allow_local=False)
            assert problem is not None, host
    assert heard == []


@pytest.mark.parametrize(
    "url",
    [
        "ftp://a.example/",
        "file:///etc/passwd",
        "//a.example/",
        "https://",
        "https://user:password@a.example/",
        "https://user@a.example/",
        "https://a.example:0/",
        "https://a.example:99999/",
        "https://[::1/",
        "https://a.example/\n",
        "https://a.example/ b",
        "https://a.example\\@b.example/",
        "https://ä.example/",
        "https://a.example/" + "x" * 2000,
    ],
)
def test_what_is_no_address_is_refused(url: str):
    with pytest.raises(InvalidConfig, match="url: "):
        check_url(url)


def test_ports_are_the_usual_ones_unless_named():
    assert check_url("https://a.example/x") == ("a.example", 443)
    assert check_url("http://a.example:8080") == ("a.example", 8080)


@FEW
@given(st.text(max_size=60))
def test_any_text_is_judged_without_a_stumble(url: str):
    for text in (url, f"http://{url}", f"https://a.example{url}"):
        try:
            host, port = check_url(text)
        except InvalidConfig:
            continue
        assert host
        assert 1 <= port <= 65535


LOCAL = [ipaddress.ip_network(text) for text in ("127.0.0.0/8", "169.254.0.0/16", "::1/128", "fe80::/10")]
NOBODY = [ipaddress.ip_network(text) for text in ("0.0.0.0/8", "224.0.0.0/4", "ff00::/8", "::/128")]


def within(network: Any) -> st.SearchStrategy[Any]:
    first, last = int(network.network_address), int(network.broadcast_address)
    return st.integers(first, last).map(type(network.network_address))


@FEW
@given(st.one_of([within(network) for network in LOCAL]))
def test_no_address_of_this_machine_or_its_link_may_be_told(address: Any):
    assert why_refused(address, allow_local=False) is not None
    assert why_refused(address, allow_local=True) is None


@FEW
@given(st.one_of([within(network) for network in NOBODY]))
def test_no_address_of_nobody_or_many_may_ever_be_told(address: Any):
    assert why_refused(address, allow_local=True) is not None


@FEW
@given(st.one_of([within(network) for network in (*LOCAL[:2], *NOBODY[:2])]))
def test_an_old_address_is_seen_through_every_new_dress(address: Any):
    number = int(address)
    dresses = [
        ipaddress.IPv6Address((0xFFFF << 32) | number),
        ipaddress.IPv6Address((0x2002 << 112) | (number << 80)),
        ipaddress.IPv6Address(int(ipaddress.IPv6Address("64:ff9b::")) | number),
        ipaddress.IPv6Address(number),
    ]
    for dressed in dresses:
        assert why_refused(dressed, allow_local=False) is not None, dressed


@FEW
@given(st.integers(0, 2**32 - 1).map(ipaddress.IPv4Address))
def test_other_addresses_may_be_told(address: ipaddress.IPv4Address):
    refused = [*LOCAL[:2], *NOBODY[:2]]
    assert (why_refused(address, allow_local=False) is not None) == any(address in network for network in refused)


def test_one_bad_address_behind_a_name_is_enough():
    with pytest.raises(TargetRefused, match=r"'a\.example' stands for 127\.0\.0\.1, which is this machine"):
        find_target("https://a.example/", False, lambda *_: ["93.184.216.34", "127.0.0.1"])
    with pytest.raises(TargetRefused, match=r"'a\.example' cannot be found"):
        find_target("https://a.example/", False, lambda *_: (_ for _ in ()).throw(OSError("no such host")))
    assert find_target("https://a.example/", False, lambda *_: ["10.1.2.3"]).address == "10.1.2.3"


def test_the_sender_sends_what_is_due_and_records_it(db: Database):
    with listening() as (port, heard):
        webhook = add_webhook(db, f"http://127.0.0.1:{port}/", ["run_failed"])
        add_test(db, webhook.id, trial_body())
        assert Sender(db, allow_local=True).tick() == 1
        assert Sender(db, allow_local=True).tick() == 0
    assert json.loads(heard[0][2])["text"].startswith("This is a test from SLDR")
    assert list_webhooks(db)[0].deliveries[0].state == "sent"


def test_a_started_sender_is_woken_and_ends(db: Database):
    sender = Sender(db, allow_local=True)
    with listening() as (port, heard):
        webhook = add_webhook(db, f"http://127.0.0.1:{port}/", ["run_failed"])
        add_test(db, webhook.id, trial_body())
        sender.start()
        sender.wake()
        pause = threading.Event()
        for _ in range(600):
            if list_webhooks(db)[0].deliveries[0].state == "sent":
                break
            pause.wait(0.1)
        sender.stop()
    assert len(heard) == 1
