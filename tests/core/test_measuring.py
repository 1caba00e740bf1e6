"""Tests count what they say they count, and change nothing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from small_training import collected_parts, tiny_config

from sldr_core.config import ExplorationConfig
from sldr_core.demonstrations.starts import SEED_OFFSET
from sldr_core.envs import Envs, Observation, make_envs
from sldr_core.training.build import TEST_SEED_OFFSET, Parts
from sldr_core.training.evaluation import EVALUATION_SEED_OFFSET
from sldr_core.training.rollout import Collected, Exploration, collect_episodes, numpy_policy
from sldr_core.training.testing import run_test, wilson_interval


def nothing() -> None:
    """Check nothing between steps."""


def stand_still(obs: np.ndarray, goal: np.ndarray) -> np.ndarray:
    return np.zeros((len(obs), 7), dtype=np.float32)


@pytest.mark.parametrize(
    ("successes", "episodes", "low", "high"),
    [
        # Newcombe, Statistics in Medicine 17 (1998), table I, method 3.
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
        # All succeed: n / (n + z^2) by hand.
        (20, 20, 20 / (20 + 1.959963984540054**2), 1.0),
    ],
)
def test_the_interval_is_that_of_the_literature(successes: int, episodes: int, low: float, high: float) -> None:
    assert wilson_interval(successes, episodes) == pytest.approx((low, high), abs=5e-5)


@pytest.mark.parametrize("episodes", [1, 7, 380])
def test_the_interval_holds_the_rate_and_stays_within_zero_and_one(episodes: int) -> None:
    for successes in range(episodes + 1):
        low, high = wilson_interval(successes, episodes)
        assert 0.0 <= low <= successes / episodes <= high <= 1.0


class CountedEnvs:
    """Stand for environments whose n-th episode succeeds if `succeeds[n]`, and ends n metres from its goal."""

    def __init__(self, num_envs: int, succeeds: list[bool]) -> None:
        self.num_envs, self.episode_length = num_envs, 2
        self.obs_size, self.goal_size, self.action_size = 12, 3, 7
        self._succeeds, self._begun = succeeds, 0

    def reset(self) -> Observation:
        self._begun += self.num_envs
        return self._now()

    def step(self, action: np.ndarray) -> Observation:
        return self._now()

    def success(self, achieved: np.ndarray, goal: np.ndarray) -> np.ndarray:
        return np.array([self._succeeds[int(metres)] for metres in achieved[:, 0]])

    def remaining_distance(self, achieved: np.ndarray, goal: np.ndarray) -> np.ndarray:
        return achieved[:, 0]

    def unstable(self) -> np.ndarray:
        return np.zeros(self.num_envs, dtype=np.bool_)

    def _now(self) -> Observation:
        achieved = np.zeros((self.num_envs, 3))
        achieved[:, 0] = np.arange(self._begun - self.num_envs, self._begun)
        return Observation(np.zeros((self.num_envs, 12)), achieved, np.zeros((self.num_envs, 3)))


@pytest.mark.parametrize(("num_envs", "episodes"), [(4, 4), (4, 10), (4, 3), (1, 3)])
def test_a_last_batch_that_is_not_needed_whole_is_counted_in_part(num_envs: int, episodes: int) -> None:
    succeeds = [number % 3 != 1 for number in range(20)]
    envs = CountedEnvs(num_envs, succeeds)

    result = run_test(envs, stand_still, episodes, nothing)  # pyright: ignore[reportArgumentType]

    assert result.episodes == episodes
    assert result.successes == sum(succeeds[:episodes])
    assert result.success_rate == pytest.approx(sum(succeeds[:episodes]) / episodes)
    assert result.mean_final_distance == pytest.approx(np.arange(episodes).mean())


def test_success_is_read_at_the_last_step() -> None:
    def go_and(leave: bool) -> Collected:
        steps = iter(range(50))

        def act(obs: np.ndarray, goal: np.ndarray) -> np.ndarray:
            action = np.zeros((len(obs), 7), dtype=np.float32)
            action[:, :3] = (goal - obs[:, :3]) / 0.032 if not leave or next(steps) < 45 else 1.0
            return action

        return collect_episodes(make_envs("FetchPush", "locomotion", num_envs=3), act, nothing)

    stayed, left = go_and(leave=False), go_and(leave=True)

    assert stayed.success.all()
    assert stayed.final_distance.max() < 0.05
    assert not left.success.any()
    distances = np.linalg.norm(left.episodes.achieved - left.episodes.goal[:, None], axis=2)
    assert (distances.min(axis=1) < 0.05).all(), "every object has to have been at its goal"
    np.testing.assert_allclose(left.final_distance, distances[:, -1], atol=1e-6)


def test_a_pose_is_as_far_as_what_its_task_scores() -> None:
    envs = make_envs("HandBlockRotate", num_envs=2)

    collected = collect_episodes(envs, lambda obs, goal: np.zeros((2, 20), dtype=np.float32), nothing)

    turn = envs.offsets(collected.episodes.achieved[:, -1], collected.episodes.goal).angle
    np.testing.assert_allclose(collected.final_distance, 2.0 * np.sin(turn / 4.0), atol=1e-5)


def test_episodes_hold_every_state_from_first_to_last() -> None:
    envs = make_envs("ShortPush", "locomotion", num_envs=2, seed=4)
    twin = make_envs("ShortPush", "locomotion", num_envs=2, seed=4)
    rng = np.random.default_rng(0)

    episodes = collect_episodes(envs, lambda obs, goal: rng.uniform(-1, 1, (2, 7)).astype(np.float32), nothing).episodes

    seen = [twin.reset(), *(twin.step(episodes.action[:, t]) for t in range(8))]
    np.testing.assert_array_equal(episodes.obs, np.stack([now.obs for now in seen], axis=1).astype(np.float32))
    np.testing.assert_array_equal(episodes.goal, seen[0].goal.astype(np.float32))
    assert episodes.action.shape == (2, 8, 7)


@pytest.fixture
def parts(tmp_path: Path) -> Parts:
    return collected_parts(tiny_config(), tmp_path)


def test_test_episodes_change_neither_normaliser_nor_memory_nor_training_scenes(parts: Parts) -> None:
    normalizer = parts.agent.normalizer
    before = normalizer.mean.clone(), normalizer.count.clone(), parts.buffer.written, parts.envs.state()

    run_test(parts.test_envs, numpy_policy(parts.agent.act_averaged), 5, nothing)

    assert (normalizer.mean == before[0]).all()
    assert normalizer.count == before[1]
    assert parts.buffer.written == before[2]
    assert parts.envs.state()["rngs"] == before[3]["rngs"]


def test_tests_and_training_draw_from_different_generators(parts: Parts) -> None:
    assert starts_of(parts.envs).isdisjoint(starts_of(parts.test_envs))


def test_no_two_purposes_share_a_generator() -> None:
    offsets = [0, TEST_SEED_OFFSET, EVALUATION_SEED_OFFSET, SEED_OFFSET]
    seeds = [*range(20), 2**31 - 1]
    drawn = [
        np.random.default_rng((seed + offset, index)).integers(2**63)
        for offset in offsets
        for seed in seeds
        for index in range(20)
    ]

    assert len(set(drawn)) == len(drawn)


def starts_of(envs: Envs) -> set[tuple[float, ...]]:
    return {tuple(row) for _ in range(5) for row in envs.reset().achieved}


def test_exploration_acts_uniformly_now_and_then_and_near_the_policy_else() -> None:
    config = tiny_config("manipulation").exploration
    exploration = Exploration(config, np.random.default_rng(0))

    noisy = exploration.perturb(np.full((20_000, 4), 0.1, dtype=np.float32))

    far = (np.abs(noisy - 0.1) > 5 * config.noise_std).any(axis=1).mean()
    near = noisy[(np.abs(noisy - 0.1) < 3 * config.noise_std).all(axis=1)]
    assert np.abs(noisy).max() <= 1.0
    assert noisy.dtype == np.float32
    # The policy's 0.1 is left by more than 1.0 only by uniform actions: values below -0.9, of probability 0.05 each.
    assert far == pytest.approx(config.random_action_probability * (1 - 0.95**4), abs=0.01)
    assert near.mean() == pytest.approx(0.1, abs=0.01)


def test_exploration_without_noise_is_the_policy() -> None:
    exploration = Exploration(ExplorationConfig(0.0, 0.0), np.random.default_rng(0))
    action = np.random.default_rng(1).uniform(-1, 1, (50, 4)).astype(np.float32)

    np.testing.assert_array_equal(exploration.around(lambda obs, goal: action)(action, action), action)
