"""Objects and goals that are put by hand stay where the task can have them."""

from __future__ import annotations

import numpy as np
import pytest

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
HALF_TURN = (0.0, 0.0, 0.0, 2.0)


def open_scene(inspect, task, seed=0):
    inspected = inspect(task)
    envs = inspected.make_envs(1)
    return inspected.placing(envs), inspected.starts(task, envs).draw(seed, [0]).start


def test_an_object_is_put_on_the_table_and_not_into_it(inspect):
    placing, start = open_scene(inspect, "FetchPush")
    low, high = placing.bounds()
    put = placing.put_object(start, (1.3, 9.0, -1.0), HALF_TURN)
    position, quaternion = placing.object_pose(put)
    assert position.tolist() == [1.3, high[1], low[2]]
    assert quaternion.tolist() == [0.0, 0.0, 0.0, 1.0]
    assert low[2] == placing.object_pose(start)[0][2]
    assert np.array_equal(put.goal, start.goal)


def test_a_goal_on_the_table_stays_on_it_and_one_in_the_air_does_not(inspect):
    placing, start = open_scene(inspect, "FetchPush")
    assert placing.put_goal(start, (1.3, 0.7, 0.6), UPRIGHT).goal[0].tolist() == [1.3, 0.7, start.goal[0, 2]]
    placing, start = open_scene(inspect, "FetchPickAndPlace")
    assert placing.put_goal(start, (1.3, 0.7, 0.6), UPRIGHT).goal[0].tolist() == [1.3, 0.7, 0.6]


def test_a_chain_s_goal_moves_as_a_whole_and_is_lifted_out_of_the_table(inspect):
    placing, start = open_scene(inspect, "FetchTuple5")
    goal = placing.put_goal(placing.put_shape(start, 0), (1.2, 0.7, 0.0), UPRIGHT).goal[0].reshape(5, 3)
    assert goal[:, 2].min() == pytest.approx(placing.rest[2], abs=1e-6)
    assert (goal - goal[0])[:, [0, 2]] == pytest.approx(
        np.array([(0, 0), (0, -0.05), (0, -0.1), (0.05, -0.1), (0.1, -0.1)])
    )
    assert goal[0, :2].tolist() == [1.2, 0.7]


def test_a_chain_s_goal_that_was_lifted_can_be_put_down_again(inspect):
    placing, start = open_scene(inspect, "FetchTuple3")
    lifted = placing.put_goal(start, (1.2, 0.7, 0.9), UPRIGHT)
    lowered = placing.put_goal(lifted, (1.2, 0.7, 0.0), UPRIGHT)
    assert lifted.goal[0, 2::3].min() > placing.rest[2] + 0.1
    assert lowered.goal[0, 2::3].min() == pytest.approx(placing.rest[2], abs=1e-6)


def test_what_of_a_pose_is_not_scored_follows_the_object(inspect):
    placing, start = open_scene(inspect, "HandBlockRotate")
    put = placing.put_object(start, placing.rest + 0.02, UPRIGHT)
    assert put.goal[0, :3] == pytest.approx(placing.rest + 0.02)
    assert np.array_equal(put.goal[0, 3:], start.goal[0, 3:])
    turned = placing.put_goal(start, (9.0, 9.0, 9.0), HALF_TURN)
    assert np.array_equal(turned.goal[0, :3], start.goal[0, :3])
    assert turned.goal[0, 3:].tolist() == [0.0, 0.0, 0.0, 1.0]


def test_a_goal_in_the_hand_that_scores_places_moves_and_does_not_turn(inspect):
    placing, start = open_scene(inspect, "HandBlockTranslate")
    moved = placing.put_goal(start, placing.rest + np.array([0.01, 0.0, 0.5]), HALF_TURN)
    assert moved.goal[0, :3] == pytest.approx(placing.rest + np.array([0.01, 0.0, 0.1]))
    assert np.array_equal(moved.goal[0, 3:], start.goal[0, 3:])
