"""The control channel: commands in, states and answers out, and no page of another site."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from worker.viewer.control import ControlChannel, to_json

PATIENCE_S = 30.0


@pytest.fixture
def channel() -> Iterator[ControlChannel]:
    channel = ControlChannel()
    yield channel
    channel.close()


def dial(channel: ControlChannel, origin: Origin | None = None) -> ClientConnection:
    return connect(f"ws://127.0.0.1:{channel.port}/", proxy=None, origin=origin)


def test_a_new_page_is_told_the_state_and_then_each_change_once(channel):
    channel.publish({"step": 1})
    with dial(channel) as page:
        assert json.loads(page.recv(PATIENCE_S)) == {"state": {"step": 1}}
        channel.publish({"step": 1})
        channel.publish({"step": 2})
        assert json.loads(page.recv(PATIENCE_S)) == {"state": {"step": 2}}
        assert channel.pages == 1


def test_a_command_is_answered_to_the_page_that_asked(channel):
    with dial(channel) as asking, dial(channel) as other:
        asking.send('{"do": "report"}')
        [asked] = channel.take(PATIENCE_S)
        assert asked.text == '{"do": "report"}'
        asked.answer({"answer": {"step": 3}})
        assert json.loads(asking.recv(PATIENCE_S)) == {"answer": {"step": 3}}
        channel.publish({"step": 3})
        assert json.loads(other.recv(PATIENCE_S)) == {"state": {"step": 3}}


def test_without_a_message_taking_ends_by_itself(channel):
    assert channel.take(0.01) == []


def test_a_browser_cannot_reach_it_but_through_the_proxy(channel):
    with pytest.raises(InvalidStatus) as refused:
        dial(channel, Origin("http://evil.example"))
    assert refused.value.response.status_code == 403


def test_numbers_arrive_to_the_last_bit():
    values = np.random.default_rng(0).normal(size=50)
    assert json.loads(to_json({"qpos": values}))["qpos"] == values.tolist()
