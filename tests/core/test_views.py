"""What the networks see of the scene is what the scene shows, under the goal that counts."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from sldr_core.config import PHASES, Phase, PoseGoal, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.envs.fetch import ObjectObserver
from sldr_core.nets.views import (
    joined_features,
    nearest_features,
    object_features,
    part_view,
    transition_features,
    view_of,
)

TASK = find_task("FetchPush")


def pushed_object() -> Envs:
    """Return robots at work: gripper and object both move."""
    envs = make_envs("FetchPush", num_envs=8)
    way = envs.observe().obs[:, 6:9]
    action = np.zeros((8, 4))
    action[:, :2] = way[:, :2] / np.abs(way[:, :2]).max(axis=1, keepdims=True)
    for _ in range(8):
        envs.step(action)
    return envs


def test_the_object_seen_through_the_robot_is_the_object_seen_by_itself() -> None:
    envs = pushed_object()
    seen = ObjectObserver(envs.simulation, 1).observe()

    through_robot = part_view(TASK, TASK.parts[0]).object_state(torch.from_numpy(envs.observe().obs))

    assert np.abs(seen[:, 6:9]).max() > 1e-3, "no object moved: velocities would prove nothing"
    np.testing.assert_allclose(through_robot.numpy(), seen, atol=1e-15)


def test_the_object_sees_the_way_to_the_goal_it_is_given() -> None:
    state = torch.arange(12.0)[None].repeat(2, 1)
    goal = torch.tensor([[10.0, 20.0, 30.0], [1.0, 2.0, 3.0]])

    features = object_features(state, goal)

    by_hand = [[0, 1, 2, 10, 19, 28, 3, 4, 5, -6, -7, -8, 9, 10, 11, 10, 20, 30]]
    by_hand.append([0, 1, 2, 1, 1, 1, 3, 4, 5, -6, -7, -8, 9, 10, 11, 1, 2, 3])
    assert features.tolist() == by_hand


@pytest.mark.parametrize("phase", PHASES)
def test_a_relabelled_goal_leaves_no_stale_feature(phase: Phase) -> None:
    """Only what is computed from the goal may change, and it must all change with it."""
    view = view_of(TASK, phase)
    size = make_envs("FetchPush", phase).obs_size
    obs = torch.randn(5, size, generator=torch.Generator().manual_seed(0))
    old, new = torch.zeros(5, 3), torch.ones(5, 3)

    changed = (view.features(obs, new) - view.features(obs, old)).round(decimals=5)

    about_goal = [3, 4, 5, 15, 16, 17] if phase == "locomotion" else [25, 26, 27]
    expected = torch.zeros(5, view.size)
    expected[:, about_goal] = 1.0
    assert torch.equal(changed, expected)


@pytest.mark.parametrize("phase", PHASES)
def test_a_view_gives_as_many_features_as_it_says(phase: Phase) -> None:
    now = make_envs("FetchPush", phase, num_envs=2).observe()
    view = view_of(TASK, phase)

    features = view.features(torch.from_numpy(now.obs), torch.from_numpy(now.goal))

    assert features.shape == (2, view.size)


def test_the_robot_sees_its_observation_and_then_the_goal() -> None:
    obs, goal = torch.arange(25.0)[None], torch.tensor([[-1.0, -2.0, -3.0]])

    assert joined_features(obs, goal).tolist() == [[*range(25), -1, -2, -3]]


def test_a_goal_is_seen_with_the_sign_that_is_nearer_to_the_object() -> None:
    """Two objects turned alike, whose goals are one rotation written with either sign."""
    state = torch.tensor([[0.0, 0.0, 1.0, 2.0, 3.0, 0.8, 0.6, 0.0, 0.0]]).repeat(2, 1)
    goal = torch.tensor([[4.0, 5.0, 6.0, 0.6, 0.0, 0.8, 0.0], [4.0, 5.0, 6.0, -0.6, 0.0, -0.8, 0.0]])

    features = nearest_features(state, goal, PoseGoal(distance=0.01, angle=0.1))

    assert torch.equal(features[0], torch.cat([state[0], goal[0]]))
    assert torch.equal(features[1], features[0])


def test_what_does_not_count_of_a_goal_is_seen_as_the_object_has_it() -> None:
    state = torch.tensor([0.0, 0.0, 1.0, 2.0, 3.0, 0.8, 0.6, 0.0, 0.0])
    goal = torch.tensor([4.0, 5.0, 6.0, 0.6, 0.0, 0.8, 0.0])

    turned = nearest_features(state, goal, PoseGoal(distance=None, angle=0.1))
    moved = nearest_features(state, goal, PoseGoal(distance=0.01, angle=None))

    assert torch.equal(turned, torch.cat([state, state[2:5], goal[3:]]))
    assert torch.equal(moved, torch.cat([state, goal[:3], state[5:]]))


@pytest.mark.parametrize("task", ["HandBlockRotate", "HandPenRotate", "HandEggTranslate", "HandPenFull"])
def test_what_the_hand_or_its_object_is_shown_counts_as_the_goal_and_is_nearer(task: str) -> None:
    spec = find_task(task)
    phase = "locomotion" if task in spec.locomotion_tasks else "manipulation"
    envs = make_envs(task, phase, num_envs=8)
    now = envs.observe()
    obs, goal = torch.from_numpy(now.obs), torch.from_numpy(now.goal)
    view, raw = view_of(spec, phase), view_of(find_task(task, "original"), phase)

    seen = view.features(obs, goal)

    shown = seen[:, -7:].numpy()
    assert torch.equal(seen[:, :-7], obs)
    assert envs.success(shown, now.goal).all()
    signed = goal * torch.tensor([1, 1, 1, -1, -1, -1, -1])
    np.testing.assert_allclose(view.features(obs, signed), seen, atol=1e-12)
    assert (alignment(shown, now.achieved) >= np.abs(alignment(now.goal, now.achieved)) - 1e-12).all()
    assert torch.equal(raw.features(obs, signed), joined_features(obs, signed))


def alignment(poses: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return the products of the poses' quaternions: 1 if they are the same, -1 if of opposite signs."""
    return (poses * others)[:, 3:].sum(axis=1)


def test_a_transition_is_seen_as_the_state_and_its_change() -> None:
    state, next_state = torch.tensor([[1.0, 2.0]]), torch.tensor([[4.0, 8.0]])

    assert transition_features(state, next_state).tolist() == [[1, 2, 3, 6]]
