"""Relabelled transitions that begin at their goal can be drawn less often; everything else stays as it was."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from plain_rewards import no_reward

from sldr_core.config import ReplayConfig
from sldr_core.records import Episodes, Floats
from sldr_core.replay import HindsightSampler, ReplayBuffer
from sldr_core.replay.sampling import Draw

LENGTH = 6
EPISODES = 10
BATCH = 60_000
MOVES_AT = 4
"""Until then nothing moves; from then on something does at every step."""

RELABELLED = 0.8
SIGMAS = 5.0
"""A share may be off by so many standard deviations; the draws are seeded."""


def same(achieved: Floats, goal: Floats) -> np.ndarray:
    return (achieved == goal).all(axis=-1)


def buffer_of(tmp_path: Path, achieved: np.ndarray) -> ReplayBuffer:
    """Hold episodes that all went as `achieved` `[T + 1]` says."""
    shapes = {"obs": (LENGTH + 1, 1), "achieved": (LENGTH + 1, 1), "goal": (1,), "action": (LENGTH, 1)}
    buffer = ReplayBuffer(tmp_path / "replay.bin", shapes, capacity=EPISODES, slack=1)
    course = np.tile(achieved.astype(np.float32)[None, :, None], (EPISODES, 1, 1))
    goal = np.full((EPISODES, 1), 99.0, np.float32)
    buffer.store(Episodes(course, course, goal, course[:, :-1]))
    return buffer


def drawn(buffer: ReplayBuffer, met_weight: float) -> Draw:
    config = ReplayConfig(relabel_probability=RELABELLED, met_weight=met_weight)
    return HindsightSampler(buffer, no_reward, same, config, np.random.default_rng(0)).draw(BATCH)


def pair_shares(achieved: np.ndarray, met_weight: float) -> np.ndarray:
    """Return how often each step and later step should be drawn, `[T, T + 1]`, pair by pair."""
    shares = np.zeros((LENGTH, LENGTH + 1))
    for step in range(LENGTH):
        for later in range(step + 1, LENGTH + 1):
            weight = met_weight if achieved[step] == achieved[later] else 1.0
            shares[step, later] = weight / LENGTH / (LENGTH - step)
    return shares / shares.sum()


@pytest.mark.parametrize("met_weight", [1.0, 0.3, 0.03])
def test_pairs_of_step_and_goal_are_drawn_as_often_as_their_weights_say(tmp_path: Path, met_weight: float) -> None:
    achieved = np.maximum(np.arange(LENGTH + 1) - MOVES_AT, 0)
    draw = drawn(buffer_of(tmp_path, achieved), met_weight)
    relabelled = draw.goal_step > 0
    counts = np.zeros((LENGTH, LENGTH + 1))
    np.add.at(counts, (draw.step[relabelled], draw.goal_step[relabelled]), 1.0)
    expected = pair_shares(achieved, met_weight)
    # Candidates are drawn before they are weighed, so a count varies by both draws: twice the variance at the most.
    bound = SIGMAS * np.sqrt(2.0 * expected / relabelled.sum())
    assert (np.abs(counts / relabelled.sum() - expected) <= bound).all()


def test_goals_that_stay_are_drawn_evenly_and_as_often_as_ever(tmp_path: Path) -> None:
    draw = drawn(buffer_of(tmp_path, np.maximum(np.arange(LENGTH + 1) - MOVES_AT, 0)), 0.03)
    stays = draw.goal_step == 0
    assert stays.mean() == pytest.approx(1.0 - RELABELLED, abs=0.01)
    assert np.bincount(draw.step[stays]) / stays.sum() == pytest.approx(np.full(LENGTH, 1 / LENGTH), abs=0.02)


def test_weight_one_draws_the_very_same_as_without_looking_at_goals(tmp_path: Path) -> None:
    buffer = buffer_of(tmp_path, np.arange(LENGTH + 1))

    def never_asked(achieved: Floats, goal: Floats) -> np.ndarray:
        raise AssertionError("With weight 1 nobody needs to know which goals are met.")

    config = ReplayConfig(relabel_probability=RELABELLED)
    unasked = HindsightSampler(buffer, no_reward, never_asked, config, np.random.default_rng(0)).draw(BATCH)
    np.testing.assert_array_equal(unasked.goal_step, drawn(buffer, 1.0).goal_step)


def test_where_nothing_moves_the_batch_is_full_all_the_same(tmp_path: Path) -> None:
    draw = drawn(buffer_of(tmp_path, np.zeros(LENGTH + 1)), 0.03)
    assert draw.step.shape == (BATCH,)
    assert (draw.goal_step > 0).mean() == pytest.approx(RELABELLED, abs=0.01)
