"""Episodes in which nothing moved can be drawn less often; everything else stays as it was."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from plain_rewards import never_met, no_reward

from sldr_core.config import ReplayConfig
from sldr_core.records import Episodes
from sldr_core.replay import HindsightSampler, ReplayBuffer
from sldr_core.replay.buffer import has_moved

LENGTH = 4
BATCH = 40_000
STILL, MOVED = 30, 10


@pytest.fixture
def buffer(tmp_path: Path) -> ReplayBuffer:
    """Hold 30 episodes in which nothing moved, then 10 in which something did; the action names the episode."""
    count = STILL + MOVED
    buffer = ReplayBuffer(
        tmp_path / "replay.bin",
        {"obs": (LENGTH + 1, 1), "achieved": (LENGTH + 1, 3), "goal": (3,), "action": (LENGTH, 1)},
        capacity=count,
        slack=5,
    )
    achieved = np.zeros((count, LENGTH + 1, 3), dtype=np.float32)
    achieved[STILL:, -1, 1] = 0.02
    action = np.broadcast_to(np.arange(count, dtype=np.float32)[:, None, None], (count, LENGTH, 1)).copy()
    obs, goal = np.zeros((count, LENGTH + 1, 1), np.float32), np.zeros((count, 3), np.float32)
    buffer.store(Episodes(obs, achieved, goal, action))
    return buffer


def weighted_sampler(buffer: ReplayBuffer, config: ReplayConfig) -> HindsightSampler:
    return HindsightSampler(buffer, no_reward, never_met, config, np.random.default_rng(0))


def drawn_episodes(buffer: ReplayBuffer, still_weight: float) -> np.ndarray:
    sampler = weighted_sampler(buffer, ReplayConfig(still_weight=still_weight))
    return sampler.sample(BATCH, 0).action[:, 0]


def test_an_episode_has_moved_if_any_entry_of_its_goal_changed() -> None:
    achieved = np.zeros((3, LENGTH + 1, 3), dtype=np.float32)
    achieved[1, 2, 0] = 0.011
    achieved[2, :, 2] = 0.5
    assert has_moved(achieved).tolist() == [0.0, 1.0, 0.0]


def test_weight_one_draws_all_episodes_alike(buffer: ReplayBuffer) -> None:
    share = np.mean(drawn_episodes(buffer, 1.0) >= STILL)
    assert share == pytest.approx(MOVED / (STILL + MOVED), abs=0.01)


def test_still_episodes_are_drawn_as_often_as_their_weight_says(buffer: ReplayBuffer) -> None:
    episodes = drawn_episodes(buffer, 0.1)
    counts = np.bincount(episodes.astype(int), minlength=STILL + MOVED)
    expected_moved = BATCH / (MOVED + 0.1 * STILL)
    assert counts[STILL:] == pytest.approx(np.full(MOVED, expected_moved), rel=0.1)
    assert counts[:STILL] == pytest.approx(np.full(STILL, 0.1 * expected_moved), rel=0.3)


def test_new_episodes_are_seen_at_the_next_draw(buffer: ReplayBuffer) -> None:
    sampler = weighted_sampler(buffer, ReplayConfig(still_weight=0.1))
    sampler.sample(BATCH, 0)
    achieved = np.zeros((1, LENGTH + 1, 3), dtype=np.float32)
    achieved[0, 1, 0] = 1.0
    new = np.full((1, LENGTH, 1), 99.0, dtype=np.float32)
    buffer.store(Episodes(np.zeros((1, LENGTH + 1, 1), np.float32), achieved, np.zeros((1, 3), np.float32), new))
    assert np.any(sampler.sample(BATCH, 0).action == 99.0)


def test_a_buffer_in_which_nothing_has_moved_can_still_be_drawn(tmp_path: Path) -> None:
    buffer = ReplayBuffer(
        tmp_path / "replay.bin",
        {"obs": (LENGTH + 1, 1), "achieved": (LENGTH + 1, 3), "goal": (3,), "action": (LENGTH, 1)},
        capacity=4,
        slack=1,
    )
    zeros = np.zeros((2, LENGTH + 1, 3), dtype=np.float32)
    buffer.store(Episodes(zeros[..., :1], zeros, zeros[:, 0], zeros[:, :LENGTH, :1]))
    assert drawn_episodes(buffer, 0.1).shape == (BATCH,)
