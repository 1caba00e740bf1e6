"""Which names the server answers to."""

from __future__ import annotations

import socket

import pytest
from live_api import Service, problem_fields
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from backend.api.hosts import HOSTS_VARIABLE, HostRule, load_host_rule


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1:8000", "[::1]:8000", "LOCALHOST:1"])
def test_names_of_this_machine_are_ours(host: str):
    assert HostRule().is_ours(host)


@pytest.mark.parametrize(
    "host", ["", "evil.example", "127.0.0.1.evil.example", "10.0.0.7:8000", "[::1", "localhost.evil.example:8000"]
)
def test_every_other_name_is_not(host: str):
    assert not HostRule().is_ours(host)


def test_the_bound_name_is_ours():
    assert HostRule(bound="Lab-3").is_ours("lab-3:8000")


def test_bound_to_every_address_plain_addresses_are_ours_and_names_are_not():
    rule = HostRule(bound="0.0.0.0")
    assert rule.is_ours("10.0.0.7:8000")
    assert rule.is_ours("[fe80::1]")
    assert not rule.is_ours("evil.example")


def test_the_environment_allows_further_names(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv(HOSTS_VARIABLE, "sldr.lab, Box ")
    rule = load_host_rule("127.0.0.1")
    assert rule.is_ours("sldr.lab:443")
    assert rule.is_ours("box")
    assert not rule.is_ours("sldr")


@pytest.mark.parametrize("path", ["/api/runs", "/", "/healthz"])
def test_a_request_for_another_name_is_refused_in_words(unused_service: Service, path: str):
    answer = unused_service.client.get(path, headers={"host": "evil.example"})
    assert answer.status_code == 403
    assert problem_fields(answer) == [None]
    assert "'evil.example'" in answer.json()["problems"][0]["message"]


def test_a_websocket_for_another_name_is_refused(unused_service: Service):
    # The address is the server's, the name is not: what a rebound name looks like.
    host, port = unused_service.client.base_url.host, unused_service.client.base_url.port
    assert port is not None
    with socket.create_connection((host, port)) as line, pytest.raises(InvalidStatus, match="403"):
        connect(f"ws://evil.example:{port}/viewer/token/", sock=line, proxy=None)
