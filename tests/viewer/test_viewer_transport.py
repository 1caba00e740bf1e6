"""The clock of a 3D view obeys its commands, and refuses those that make no sense."""

from __future__ import annotations

import json

import pytest

from worker.viewer.commands import BadCommand, read_command
from worker.viewer.transport import Transport


def tell(transport: Transport, **command) -> Transport:
    transport.obey(read_command(json.dumps(command)))
    return transport


def test_a_second_moves_it_by_a_second_s_steps():
    transport = Transport(steps=100)
    for _ in range(30):
        transport.advance(1 / 30)
    assert transport.step == pytest.approx(25, abs=1)


@pytest.mark.parametrize("stop", [{"do": "pause"}, {"do": "toggle"}, {"do": "step", "by": 0}])
def test_it_stands_still_when_told(stop):
    transport = tell(Transport(steps=50), **stop)
    transport.advance(5.0)
    assert (transport.step, transport.share) == (0, 0.0)


def test_seeking_shows_a_step_exactly_and_playing_goes_on_from_there():
    transport = Transport(steps=50)
    transport.advance(0.05)
    tell(transport, do="seek", step=20)
    assert (transport.step, transport.share) == (20, 0.0)
    transport.advance(0.081)
    assert transport.step == 22


def test_stepping_stops_at_the_ends():
    transport = tell(Transport(steps=5), do="seek", step=5)
    assert tell(transport, do="step", by=1).step == 5
    assert tell(transport, do="step", by=-2).step == 3
    assert not transport.is_playing


def test_a_loop_begins_again_after_a_moment():
    transport = tell(tell(Transport(steps=2), do="loop", on=True), do="seek", step=2)
    transport.advance(0.1)
    assert transport.step == 2
    transport.advance(1.0)
    assert transport.step == 0


def test_without_a_loop_it_tells_that_it_has_ended():
    transport = tell(Transport(steps=2), do="seek", step=2)
    assert not transport.has_ended
    transport.advance(1.0)
    assert transport.has_ended


def test_a_recording_stops_at_its_end_and_plays_again_from_its_start():
    transport = tell(Transport(steps=2, stops_at_end=True), do="seek", step=2)
    transport.advance(1.0)
    assert (transport.step, transport.is_playing) == (2, False)
    assert tell(transport, do="play").step == 0


def test_speed_changes_the_pace():
    transport = tell(Transport(steps=100), do="speed", speed=0.1)
    transport.advance(0.81)
    assert transport.step == 2


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        ({"do": "seek"}, 'needs "step"'),
        ({"do": "seek", "step": 51}, "a whole number from 0 to 50, got 51"),
        ({"do": "seek", "step": True}, "a whole number"),
        ({"do": "seek", "step": 1.5}, "a whole number"),
        ({"do": "speed", "speed": 9}, "a number from 0.1 to 4"),
        ({"do": "loop", "on": "yes"}, "true or false"),
    ],
)
def test_a_wrong_value_is_named(command, sentence):
    with pytest.raises(BadCommand, match=sentence):
        tell(Transport(steps=50), **command)


@pytest.mark.parametrize("text", ["", "nope", "[]", '{"do": 1}', '{"step": 2}', "[" * 60_000])
def test_what_is_no_command_is_refused(text):
    with pytest.raises(BadCommand, match="A command has to be"):
        read_command(text)


@pytest.mark.parametrize(
    "parts", ["[1e999, 0, 0]", "[NaN, 0, 0]", f"[{'9' * 400}, 0, 0]", "[1e7, 0, 0]", "[0, 0]", "3"]
)
def test_a_vector_of_odd_numbers_is_refused(parts):
    command = read_command(f'{{"do": "goal", "goal": {parts}}}')
    with pytest.raises(BadCommand, match="has to be a list of 3 numbers from"):
        command.vector("goal", 3)


@pytest.mark.parametrize("odd", ["NaN", "1e999", "[1]", "{}"])
def test_an_id_that_cannot_be_sent_back_is_refused(odd):
    with pytest.raises(BadCommand, match='"id" of the command "pause" has to be a number or a text'):
        _ = read_command(f'{{"do": "pause", "id": {odd}}}').id


def test_what_is_refused_is_told_in_short():
    with pytest.raises(BadCommand) as refused:
        read_command(f'{{"do": "goal", "goal": {"[" * 900 + "]" * 900}}}').vector("goal", 3)
    assert len(str(refused.value)) < 200
