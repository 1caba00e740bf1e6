"""The curriculum keeps what a plain greedy selection keeps, and forgets nothing that a resumed training needs."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from plain_rewards import never_met, no_reward
from small_training import collected_parts, tiny_config

from sldr_core.config import CurriculumConfig, ReplayConfig
from sldr_core.records import Episodes, Floats
from sldr_core.replay import CurriculumSampler, HindsightSampler, ReplayBuffer
from sldr_core.replay.curriculum import distinct_positions, greedy_picks, neighbour_gains
from sldr_core.replay.sampling import Draw, drawn_goals
from sldr_core.training.build import SAMPLERS

LENGTH = 6
EPISODES = 40
CONFIG = CurriculumConfig(group_size=40, candidates=20, kept=9, examined=3, nearness=0.7, nearness_growth=0.05)
UPDATES_PER_EPOCH = 5
SIGMAS = 5.0
"""A count may be off by so many standard deviations; the draws are seeded."""


def euclidean(goals: Floats, others: Floats) -> np.ndarray:
    return np.linalg.norm(np.asarray(goals, np.float64)[..., :, None, :] - others[..., None, :, :], axis=-1)


def plain_greedy(goals: np.ndarray, achieved: np.ndarray, nearness: float, positions: np.ndarray) -> list[int]:
    """Select from one group as the method's paper says, one set function and one candidate at a time."""
    count = len(goals)
    distance = [[math.dist(a, b) for b in goals] for a in goals]
    nearest = [min((d, j) for j, d in enumerate(row) if j != i) for i, row in enumerate(distance)]
    mean = sum(d for d, _ in nearest) / count
    similarity = [[0.0] * count for _ in range(count)]
    for i, (d, j) in enumerate(nearest):
        similarity[i][j] = math.exp(-(d**2) / mean**2)

    def representation(selected: list[int]) -> float:
        return sum(max((similarity[i][j] for j in selected), default=0.0) for i in range(count))

    left, selected = list(range(count)), []
    for compared in positions:
        best_value, best_position = -math.inf, -1
        for position in compared:
            candidate = left[position]
            value = representation([*selected, candidate]) - representation(selected)
            value -= nearness * math.dist(goals[candidate], achieved[candidate])
            if value > best_value + 1e-12:
                best_value, best_position = value, position
        selected.append(left[best_position])
        left[best_position] = left[-1]
        left.pop()
    return selected


@pytest.fixture
def buffer(tmp_path: Path) -> ReplayBuffer:
    """Return episodes whose actions tell which transition they are of."""
    shapes = {"obs": (LENGTH + 1, 1), "achieved": (LENGTH + 1, 2), "goal": (2,), "action": (LENGTH, 1)}
    buffer = ReplayBuffer(tmp_path / "replay.bin", shapes, capacity=EPISODES, slack=0)
    rng = np.random.default_rng(0)
    obs = np.zeros((EPISODES, LENGTH + 1, 1), np.float32)
    achieved = rng.normal(size=(EPISODES, LENGTH + 1, 2)).astype(np.float32)
    goal = rng.normal(size=(EPISODES, 2)).astype(np.float32)
    number = np.arange(EPISODES * LENGTH, dtype=np.float32).reshape(EPISODES, LENGTH, 1)
    buffer.store(Episodes(obs, achieved, goal, number))
    return buffer


def hindsight_of(buffer: ReplayBuffer, seed: int) -> HindsightSampler:
    return HindsightSampler(buffer, no_reward, never_met, ReplayConfig(), np.random.default_rng(seed))


def sampler_of(buffer: ReplayBuffer, seed: int = 0) -> CurriculumSampler:
    return CurriculumSampler(hindsight_of(buffer, seed), buffer, euclidean, CONFIG, UPDATES_PER_EPOCH)


@pytest.mark.parametrize("update", [0, 3, UPDATES_PER_EPOCH + 3])
def test_the_selection_is_that_of_a_plain_greedy_one_on_the_same_random_subsets(
    buffer: ReplayBuffer, update: int
) -> None:
    groups = 7
    draw = hindsight_of(buffer, 1).draw(groups * CONFIG.candidates)

    selected = sampler_of(buffer).select(draw, update)

    uniform = np.random.default_rng(0).random((CONFIG.kept, CONFIG.examined, groups))
    positions = distinct_positions(uniform, CONFIG.candidates)
    nearness = 0.7 * 1.05 ** (update % UPDATES_PER_EPOCH)
    goal, achieved = drawn_goals(buffer, draw), buffer.arrays["achieved"][draw.episode, draw.step]
    expected: list[int] = []
    for group in range(groups):
        members = slice(group * CONFIG.candidates, (group + 1) * CONFIG.candidates)
        picked = plain_greedy(goal[members], achieved[members], nearness, positions[:, :, group])
        expected += [group * CONFIG.candidates + pick for pick in picked]
    assert_same_draw(selected, draw.choose(np.array(expected)))


def assert_same_draw(first: Draw, second: Draw) -> None:
    for name in ("episode", "step", "goal_step"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


def test_gains_by_hand() -> None:
    # On a line at 0, 1, 3 and 7: the neighbours are 1, 0, 1 and 3; their distances 1, 1, 2 and 4, so 2 on average.
    where = np.array([0.0, 1.0, 3.0, 7.0])

    gains = neighbour_gains(np.abs(where[:, None] - where)[None])

    near, middle, far = math.exp(-1 / 4), math.exp(-1), math.exp(-4)
    np.testing.assert_allclose(gains, [[near, near + middle, far, 0.0]])


def test_goals_that_are_all_the_same_are_fully_similar() -> None:
    gains = neighbour_gains(np.zeros((2, 4, 4)))

    np.testing.assert_array_equal(gains.sum(axis=1), [4.0, 4.0])


def test_every_pick_compares_different_candidates_that_are_left_and_all_sets_alike() -> None:
    picks, candidates, groups = 3, 6, 20_000
    uniform = np.random.default_rng(0).random((picks, 3, groups))

    positions = distinct_positions(uniform, candidates)

    for pick, left in enumerate((6, 5, 4)):
        sets = Counter(frozenset(compared) for compared in positions[pick].T.tolist())
        expected = groups / math.comb(left, 3)
        assert {len(compared) for compared in sets} == {3}
        assert {position for compared in sets for position in compared} == set(range(left))
        assert len(sets) == math.comb(left, 3)
        assert max(abs(count - expected) for count in sets.values()) < SIGMAS * math.sqrt(expected)


def test_the_last_picks_may_take_all_that_is_left() -> None:
    positions = distinct_positions(np.random.default_rng(0).random((4, 3, 10)), 6)

    picked = greedy_picks(np.random.default_rng(1).random((10, 6)), positions)

    assert sorted(positions[-1, :, 0]) == [0, 1, 2]
    assert all(len(set(row)) == 4 for row in picked.tolist())


def test_nearness_grows_with_the_updates_of_an_epoch_and_starts_anew_with_the_next(buffer: ReplayBuffer) -> None:
    sampler = sampler_of(buffer)

    weights = [sampler.nearness(update) for update in range(7)]

    expected = [0.7, 0.7 * 1.05, 0.7 * 1.05**2, 0.7 * 1.05**3, 0.7 * 1.05**4, 0.7, 0.7 * 1.05]
    assert weights == pytest.approx(expected)


def test_much_nearness_keeps_what_is_near_its_goal(buffer: ReplayBuffer) -> None:
    config = CurriculumConfig(group_size=40, candidates=20, kept=5, examined=16, nearness=1e6, nearness_growth=0.0)
    hindsight = hindsight_of(buffer, 2)
    draw = hindsight.draw(20)

    kept = CurriculumSampler(hindsight, buffer, euclidean, config, 1).select(draw, 0)

    goal, achieved = drawn_goals(buffer, draw), buffer.arrays["achieved"][draw.episode, draw.step]
    ways = np.linalg.norm(goal - achieved, axis=1)
    kept_goal, kept_achieved = drawn_goals(buffer, kept), buffer.arrays["achieved"][kept.episode, kept.step]
    kept_ways = np.linalg.norm(kept_goal - kept_achieved, axis=1)
    assert kept_ways.max() <= np.sort(ways)[9]


def test_a_batch_has_the_kept_transitions_of_every_group(buffer: ReplayBuffer) -> None:
    sample = sampler_of(buffer).sample(batch_size=200, update=0)

    assert sample.action.shape == (5 * CONFIG.kept, 1)
    assert sample.goal.shape == (5 * CONFIG.kept, 2)


def test_the_same_generator_and_update_keep_the_same(buffer: ReplayBuffer) -> None:
    first, again = (sampler_of(buffer, seed=3).sample(80, update=2) for _ in range(2))

    np.testing.assert_array_equal(first.action, again.action)
    np.testing.assert_array_equal(first.goal, again.goal)


def test_a_training_with_a_curriculum_counts_updates_by_epoch(tmp_path: Path) -> None:
    config = tiny_config("manipulation", "cher", cycles_per_epoch=3, updates_per_cycle=4)
    sampler = collected_parts(config, tmp_path).sampler

    assert isinstance(sampler, CurriculumSampler)
    assert set(SAMPLERS) == {"hindsight", "curriculum"}
    assert sampler.nearness(12) == sampler.nearness(0) < sampler.nearness(11)
