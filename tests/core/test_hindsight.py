"""Hindsight draws transitions evenly, relabels its share with later goals, and computes every reward anew."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from plain_rewards import never_met

from sldr_core.config import ReplayConfig
from sldr_core.records import Episodes, Floats
from sldr_core.replay import HindsightSampler, ReplayBuffer, Sample
from sldr_core.replay.sampling import draw_steps

LENGTH = 6
EPISODES = 12
BATCH = 60_000
SIGMAS = 5.0
"""A share may be off by so many standard deviations; the draws are seeded."""

ORIGINAL = 1000.0
"""Added to original goals, so that they are told from achieved ones."""


def reward_telling_its_input(achieved: Floats, goal: Floats) -> Floats:
    return achieved[:, 0] * 10_000 + goal[:, 0]


@pytest.fixture
def sample_of(tmp_path: Path) -> Callable[[float], Sample]:
    """Return batches of episodes in which every entry is 100 episode + step."""
    shapes = {
        "obs": (LENGTH + 1, 1),
        "achieved": (LENGTH + 1, 1),
        "goal": (1,),
        "action": (LENGTH, 1),
        "w": (LENGTH, 1),
    }
    buffer = ReplayBuffer(tmp_path / "replay.bin", shapes, capacity=EPISODES, slack=5)
    number = 100.0 * np.arange(EPISODES + 3, dtype=np.float32)[:, None]
    states = (number + np.arange(LENGTH + 1, dtype=np.float32))[..., None]
    actions = states[:, :-1]
    buffer.store(Episodes(states, states, number + ORIGINAL, actions, {"w": actions}))
    rng = np.random.default_rng(0)
    return lambda share: HindsightSampler(
        buffer, reward_telling_its_input, never_met, ReplayConfig(relabel_probability=share), rng
    ).sample(BATCH, 0)


def chi_square(observed: np.ndarray, expected: np.ndarray) -> float:
    """Return Pearson's statistic in standard deviations above its mean."""
    statistic = float((np.square(observed - expected) / expected).sum())
    freedom = observed.size - 1
    return (statistic - freedom) / np.sqrt(2 * freedom)


@pytest.mark.parametrize("share", [0.0, 0.25, 0.8, 1.0])
def test_the_share_of_relabelled_goals_is_the_one_asked_for(sample_of: Callable[[float], Sample], share: float) -> None:
    relabelled = (sample_of(share).goal % 100 != 0).mean()

    assert abs(relabelled - share) <= SIGMAS * np.sqrt(share * (1 - share) / BATCH)


def test_goals_that_stay_are_those_of_their_episode(sample_of: Callable[[float], Sample]) -> None:
    sample = sample_of(0.5)
    stayed = sample.goal[:, 0] % 100 == 0

    np.testing.assert_array_equal(sample.goal[stayed], sample.obs[stayed] // 100 * 100 + ORIGINAL)


def test_relabelled_goals_were_achieved_later_in_the_same_episode(sample_of: Callable[[float], Sample]) -> None:
    sample = sample_of(1.0)
    step, goal_step = sample.obs % 100, sample.goal % 100

    np.testing.assert_array_equal(sample.goal // 100, sample.obs // 100)
    assert (goal_step > step).all()
    assert goal_step.max() == LENGTH


def test_later_goals_are_uniform_over_what_is_left(sample_of: Callable[[float], Sample]) -> None:
    sample = sample_of(1.0)
    step, goal_step = ((part[:, 0] % 100).astype(np.int64) for part in (sample.obs, sample.goal))

    for now in range(LENGTH - 1):
        counts = np.bincount(goal_step[step == now] - now - 1, minlength=LENGTH - now)
        assert chi_square(counts, np.full(LENGTH - now, counts.sum() / (LENGTH - now))) < SIGMAS


def test_every_transition_of_every_remembered_episode_is_drawn_evenly(sample_of: Callable[[float], Sample]) -> None:
    drawn, counts = np.unique(sample_of(0.8).obs, return_counts=True)

    remembered = (100 * np.arange(3, EPISODES + 3)[:, None] + np.arange(LENGTH)).ravel()
    np.testing.assert_array_equal(drawn, remembered)
    assert chi_square(counts, np.full(counts.size, BATCH / counts.size)) < SIGMAS


def test_parts_of_a_transition_belong_together(sample_of: Callable[[float], Sample]) -> None:
    sample = sample_of(0.8)

    np.testing.assert_array_equal(sample.next_obs, sample.obs + 1)
    np.testing.assert_array_equal(sample.action, sample.obs)
    np.testing.assert_array_equal(sample.extra["w"], sample.obs)


def test_every_reward_is_computed_from_what_came_next_and_the_goal_given(
    sample_of: Callable[[float], Sample],
) -> None:
    sample = sample_of(0.8)

    np.testing.assert_array_equal(sample.reward, reward_telling_its_input(sample.next_obs, sample.goal))


def test_episodes_of_one_step_are_relabelled_with_their_end() -> None:
    step, goal_step = draw_steps(np.random.default_rng(0), 100, length=1, relabel_probability=1.0)

    assert not step.any()
    assert (goal_step == 1).all()


def test_the_same_generator_draws_the_same_batch() -> None:
    first, again = (draw_steps(np.random.default_rng(7), 50, LENGTH, 0.8) for _ in range(2))

    np.testing.assert_array_equal(first, again)
