"""Successes, times and failures against plain loops and hand-worked numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from sldr_core.config import find_task
from sldr_core.demonstrations import list_failures, steps_to_goal, summarise
from sldr_core.demonstrations.outcomes import NEVER


def plain_steps_to_goal(reached: np.ndarray) -> list[int]:
    steps = []
    for row in reached.tolist():
        moment = NEVER
        for step in range(len(row) - 1, -1, -1):
            if not row[step]:
                break
            moment = step
        steps.append(moment)
    return steps


def test_the_time_to_goal_is_when_it_is_met_for_good():
    reached = np.random.default_rng(0).random((200, 6)) < 0.7
    reached[0], reached[1] = True, False
    assert steps_to_goal(reached).tolist() == plain_steps_to_goal(reached)


def test_a_summary_counts_ends_and_takes_the_median_of_the_successful():
    reached = np.array([[0, 0, 1, 1], [0, 1, 1, 1], [0, 1, 1, 0], [1, 1, 1, 1]], dtype=np.bool_)
    summary = summarise(reached)
    assert (summary.episodes, summary.successes) == (4, 3)
    assert summary.median_s == pytest.approx(0.04)
    assert (summary.low, summary.high) == pytest.approx((0.3006, 0.9544), abs=1e-4)  # Wilson, worked by hand


def test_there_is_no_time_to_goal_without_a_success():
    assert summarise(np.zeros((3, 4), dtype=np.bool_)).median_s is None


def test_failures_are_all_that_ended_away_from_their_goals_the_farthest_first(push_fan):
    task = find_task("FetchPush")
    failures = list_failures(task, push_fan, most=1000)
    apart = np.linalg.norm(push_fan.achieved[:, -1] - push_fan.start.goal, axis=1)
    expected = [index for index in np.argsort(-apart, kind="stable").tolist() if apart[index] >= 0.05]
    assert [failure.index for failure in failures] == expected
    assert [failure.gaps["distance"] for failure in failures] == pytest.approx(apart[expected])
    for failure in failures:
        assert (failure.ending == "left") == bool(push_fan.reached[failure.index].any())
        assert failure.goal == tuple(push_fan.start.goal[failure.index])
    assert [failure.index for failure in list_failures(task, push_fan, most=2)] == expected[:2]


def test_a_fan_without_failures_has_none_to_list(push_fan):
    all_reached = replace(push_fan, reached=np.ones_like(push_fan.reached))
    assert list_failures(find_task("FetchPush"), all_reached, most=5) == []
