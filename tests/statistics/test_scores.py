"""One number a run over several tasks, against numbers worked out by hand, SciPy, and rliable."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.stats
from numpy.testing import assert_allclose
from rliable_numbers import load_numbers

from backend.statistics.scores import overall_iqm, performance_profile, probability_of_improvement

MONTE_CARLO = 0.015
"""How far the ends of an interval of 2,000 draws may lie from those of 20,000."""


@pytest.fixture(scope="module")
def numbers() -> dict[str, np.ndarray]:
    return load_numbers()


def test_the_overall_iqm_agrees_with_rliable(numbers: dict[str, np.ndarray]):
    estimate = overall_iqm(list(numbers["first"].T), 0.95)
    assert_allclose(estimate.value, numbers["iqm"][0], rtol=1e-12)
    assert_allclose([estimate.low, estimate.high], numbers["iqm"][1:], atol=MONTE_CARLO)


def test_the_probability_of_improvement_agrees_with_rliable(numbers: dict[str, np.ndarray]):
    estimate = probability_of_improvement(list(numbers["first"].T), list(numbers["second"].T), 0.95)
    assert_allclose(estimate.value, numbers["improvement"][0], rtol=1e-12)
    assert_allclose([estimate.low, estimate.high], numbers["improvement"][1:], atol=MONTE_CARLO)


def test_the_performance_profile_agrees_with_rliable(numbers: dict[str, np.ndarray]):
    estimate = performance_profile(list(numbers["first"].T), numbers["thresholds"], 0.95)
    share, low, high = numbers["profile"]
    assert_allclose(estimate.value, share, rtol=1e-12)
    # A share is a whole number of twenty runs, so an end may fall on the next one.
    assert_allclose(estimate.low, low, atol=0.0501)
    assert_allclose(estimate.high, high, atol=0.0501)


def test_improvement_by_hand_with_a_tie_and_ragged_tasks():
    # First task: 3 of 4 pairs won, one tied. Second: one run against two, half won.
    first = [np.array([2.0, 3.0]), np.array([5.0])]
    second = [np.array([1.0, 2.0]), np.array([4.0, 6.0])]
    assert probability_of_improvement(first, second, 0.95).value == pytest.approx((3.5 / 4 + 0.5) / 2)


def test_improvement_is_the_mann_whitney_statistic():
    rng = np.random.default_rng(5)
    first, second = rng.random(6), rng.random(9)
    u = scipy.stats.mannwhitneyu(first, second).statistic
    assert probability_of_improvement([first], [second], 0.95).value == pytest.approx(u / 54)


def test_improvement_of_both_ways_adds_up_to_one():
    rng = np.random.default_rng(6)
    first, second = [np.round(rng.random(5), 1)], [np.round(rng.random(5), 1)]
    both = (
        probability_of_improvement(first, second, 0.9).value,
        probability_of_improvement(second, first, 0.9).value,
    )
    assert sum(both) == pytest.approx(1)


def test_a_profile_weighs_every_task_the_same_however_many_seeds_it_has():
    scores = [np.array([0.9]), np.array([0.1, 0.1, 0.1])]
    assert performance_profile(scores, np.array([0.5]), 0.95).value.tolist() == [0.5]


def test_an_interval_is_the_same_each_time_and_wider_at_a_higher_level():
    scores = [np.array([0.1, 0.4, 0.5, 0.7, 0.9]), np.array([0.2, 0.3, 0.6])]
    narrow, again, wide = (overall_iqm(scores, level) for level in (0.8, 0.8, 0.99))
    assert (narrow.low, narrow.high) == (again.low, again.high)
    assert wide.low < narrow.low < narrow.value < narrow.high < wide.high
