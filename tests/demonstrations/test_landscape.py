"""Slices of Q_nu against one evaluation after the other."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from mujoco_turns import product, quaternion_of

from sldr_core.demonstrations import Slice, evaluate_slice, evaluate_turns
from sldr_core.demonstrations.landscape import action_entry, moved_states

POINTS = 4


def draw_moment(inspected, seed=0):
    task = inspected.task
    rng = np.random.default_rng(seed)
    state, goal = rng.normal(size=task.object_state_size), rng.normal(size=task.goal_size)
    if task.family == "hand":
        state[9:] /= np.linalg.norm(state[9:])
    return state, goal


def value_of(nets, state, goal, action=None):
    """Return Q_nu of one state, one goal and one action, the wanted one if None."""
    state, goal = (torch.tensor(part[None], dtype=torch.float32) for part in (state, goal))
    features = nets.features(state, goal)
    chosen = nets.action(features) if action is None else torch.tensor(action[None], dtype=torch.float32)
    return float(nets.value(features, chosen)[0])


def wanted(nets, state, goal):
    state, goal = (torch.tensor(part[None], dtype=torch.float32) for part in (state, goal))
    return nets.action(nets.features(state, goal))[0].numpy()


@pytest.mark.parametrize("task", ["FetchPush", "FetchTuple3"])
@pytest.mark.parametrize("kind", ["position", "goal"])
def test_a_slice_of_places_on_the_table(inspect, task, kind):
    inspected = inspect(task)
    nets = inspected.model.nets
    state, goal = draw_moment(inspected)
    plane = Slice(kind, (0, 2), (-1.0, 1.0), (0.0, 2.0), points=POINTS)
    seen = evaluate_slice(nets, inspected.task, plane, state, goal)
    objects = inspected.task.goal_size // 3
    at = goal if kind == "goal" else state
    assert seen.here == (at[0], at[2])
    assert seen.now == pytest.approx(value_of(nets, state, goal), abs=1e-5)
    for row, up in enumerate(np.linspace(0.0, 2.0, POINTS)):
        for column, across in enumerate(np.linspace(-1.0, 1.0, POINTS)):
            moved = at.copy()
            for index in range(objects):
                moved[3 * index] += across - at[0]
                moved[3 * index + 2] += up - at[2]
            pair = (state, moved) if kind == "goal" else (moved, goal)
            assert seen.value[row, column] == pytest.approx(value_of(nets, *pair), abs=1e-5)


@pytest.mark.parametrize(("axes", "body"), [((0, 1), 0), ((0, 2), 1), ((4, 5), 1)])
def test_a_slice_of_actions_varies_two_entries_of_what_is_wanted(inspect, axes, body):
    inspected = inspect("FetchTuple3")
    nets = inspected.model.nets
    state, goal = draw_moment(inspected)
    seen = evaluate_slice(
        nets, inspected.task, Slice("action", axes, (-1, 1), (-1, 1), body=body, points=POINTS), state, goal
    )
    entries = [action_entry(axis, body) for axis in axes]
    assert seen.here == pytest.approx(tuple(wanted(nets, state, goal)[entries]))
    for row, up in enumerate(np.linspace(-1, 1, POINTS)):
        for column, across in enumerate(np.linspace(-1, 1, POINTS)):
            action = wanted(nets, state, goal).copy()
            action[entries] = across, up
            assert seen.value[row, column] == pytest.approx(value_of(nets, state, goal, action), abs=1e-5)


def test_entries_of_an_action_are_those_of_the_physics():
    assert [action_entry(axis, 0) for axis in range(6)] == [0, 1, 2, 4, 5, 6]
    assert [action_entry(axis, 1) for axis in range(6)] == [7, 8, 9, 11, 12, 13]


def test_a_slice_of_turns_is_a_plane_of_rotation_vectors(inspect):
    inspected = inspect("HandBlockRotate")
    nets = inspected.model.nets
    state, goal = draw_moment(inspected)
    plane = Slice("turn", (0, 2), (-3.0, 3.0), (-2.0, 2.0), points=POINTS)
    seen = evaluate_slice(nets, inspected.task, plane, state, goal)
    for row, up in enumerate(np.linspace(-2.0, 2.0, POINTS)):
        for column, across in enumerate(np.linspace(-3.0, 3.0, POINTS)):
            turned = state.copy()
            turned[9:] = product(quaternion_of([across, 0.0, up]), state[9:])
            assert seen.value[row, column] == pytest.approx(value_of(nets, turned, goal), abs=1e-5)


def test_turns_about_single_axes(inspect):
    inspected = inspect("HandBlockRotate")
    nets = inspected.model.nets
    state, goal = draw_moment(inspected, seed=1)
    seen = evaluate_turns(nets, state, goal, np.eye(3), 0.5)
    for axis in range(3):
        turned = state.copy()
        turned[9:] = product(quaternion_of(0.5 * np.eye(3)[axis]), state[9:])
        assert seen[axis] == pytest.approx(value_of(nets, turned, goal), abs=1e-5)


def test_a_moved_object_in_the_hand_keeps_its_turn_and_speed(inspect):
    inspected = inspect("HandBlockRotate")
    state, _ = draw_moment(inspected)
    (moved,) = moved_states(inspected.task, state, np.array([[1.0, 2.0, 3.0]]))
    assert moved.tolist() == [*state[:6], 1.0, 2.0, 3.0, *state[9:]]
