"""Actions as arrows: a push as it is, a turn about its axis in the world."""

from __future__ import annotations

import numpy as np
import pytest

from worker.viewer.arrows import push_and_turn

UPRIGHT = np.array([[1.0, 0.0, 0.0, 0.0]])


def test_a_push_is_the_first_three_entries():
    push, turn = push_and_turn(np.array([0.5, -1.0, 0.25, 0, 0, 0, 0]), UPRIGHT)
    assert push[0] == pytest.approx([0.5, -1.0, 0.25])
    assert turn[0] == pytest.approx([0, 0, 0])


def test_a_turn_of_an_upright_object_is_about_the_axis_of_its_entry():
    _, turn = push_and_turn(np.array([0, 0, 0, 0, 0, 0, 1.0]), UPRIGHT)
    # 0.05 in z of (1, 0, 0, 0.05): a turn by 2 atan(0.05), a full turn counting as 0.1 rad.
    assert turn[0] == pytest.approx([0, 0, np.sin(np.arctan(0.05)) / 0.05], abs=1e-9)


def test_a_turn_is_told_in_the_world_s_axes():
    quarter = np.array([[np.cos(np.pi / 4), np.sin(np.pi / 4), 0.0, 0.0]])  # turned by 90 degrees about x
    # The quaternion's change that a turn about the world's z makes: (0, 0, 0, 1) * q.
    change = 1.0 * np.array([0.0, 0.0, np.sin(np.pi / 4), np.cos(np.pi / 4)])
    _, turn = push_and_turn(np.concatenate([[0, 0, 0], change]), quarter)
    assert turn[0] == pytest.approx([0, 0, 1], abs=2e-3)


def test_the_two_ends_of_a_chain_have_an_arrow_each():
    push, turn = push_and_turn(np.arange(14.0), np.repeat(UPRIGHT, 2, axis=0))
    assert push.tolist() == [[0, 1, 2], [7, 8, 9]]
    assert turn.shape == (2, 3)
