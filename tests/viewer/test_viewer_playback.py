"""The clock of a 3D view: wall seconds to control steps."""

from __future__ import annotations

import pytest

from worker.viewer.playback import MAX_STEPS, Playback


@pytest.mark.parametrize(("speed", "steps"), [(0.1, 2), (1.0, 25), (4.0, 100)])
def test_a_second_has_as_many_steps_as_the_speed_says(speed, steps):
    playback = Playback()
    playback.speed = speed
    assert sum(playback.advance(1 / 30) for _ in range(30)) == pytest.approx(steps, abs=1)


def test_time_lost_in_a_stall_is_not_hurried_through():
    playback = Playback()
    assert playback.advance(60.0) == MAX_STEPS
    assert playback.advance(0.001) == 0


def test_between_two_steps_the_share_grows():
    playback = Playback()
    playback.advance(0.01)
    assert playback.share == pytest.approx(0.25)
