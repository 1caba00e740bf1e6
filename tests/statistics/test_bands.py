"""Centres and bands, against numbers worked out by hand, SciPy, and rliable."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.stats
from numpy.testing import assert_allclose, assert_array_equal
from rliable_numbers import load_numbers

from backend.statistics.bands import BANDS, Aggregate, interquartile_mean, iqm_band, mean_band, median_band
from backend.statistics.resampling import RESAMPLES, resamples_of
from backend.statistics.student import t_quantile

NAN = np.nan


def column(*values: float) -> np.ndarray:
    return np.array(values, dtype=float)[:, None]


def test_median_and_quartiles_by_hand():
    # Sorted 1 2 4 8 16: the quartiles of five are its second and fourth.
    band = median_band(column(8, 1, 16, 2, 4), 0.95)
    assert (band.low[0], band.centre[0], band.high[0]) == (2, 4, 8)


def test_quartiles_between_two_seeds_are_interpolated():
    # Sorted 1 2 4 8: positions 0.75, 1.5 and 2.25.
    band = median_band(column(8, 1, 2, 4), 0.95)
    assert (band.low[0], band.centre[0], band.high[0]) == (1.75, 3.0, 5.0)


def test_mean_and_t_interval_by_hand():
    # Mean 4, deviation 2, t(0.975, 2) = 4.302653: 4 -+ 4.302653 * 2 / sqrt(3).
    band = mean_band(column(2, 4, 6), 0.95)
    assert band.centre[0] == 4
    assert_allclose([band.low[0], band.high[0]], [4 - 4.968275, 4 + 4.968275], atol=1e-5)


def test_interquartile_mean_by_hand():
    # Of 1 2 3 4 100 the lowest and the highest are left out.
    assert interquartile_mean(np.array([100.0, 1, 2, 3, 4])) == 3
    # A quarter of three is less than one: all count.
    assert interquartile_mean(np.array([1.0, 2, 6])) == 3


@pytest.mark.parametrize("n", [3, 4, 5, 7, 10, 23])
def test_ragged_columns_agree_with_scipy_and_numpy(n: int):
    rng = np.random.default_rng(n)
    y = rng.random((n, 12))
    y[0, 8:] = NAN
    median, mean, iqm = (BANDS[name](y, 0.9) for name in ("median", "mean", "iqm"))
    for place in range(12):
        seeds = y[np.isfinite(y[:, place]), place]
        assert_allclose(median.centre[place], np.median(seeds))
        assert_allclose(mean.centre[place], seeds.mean())
        assert_allclose(iqm.centre[place], scipy.stats.trim_mean(seeds, 0.25))
        if len(seeds) >= 3:
            assert_allclose([median.low[place], median.high[place]], np.percentile(seeds, [25, 75]))
            interval = scipy.stats.t.interval(0.9, len(seeds) - 1, seeds.mean(), scipy.stats.sem(seeds))
            assert_allclose([mean.low[place], mean.high[place]], interval)


@pytest.mark.parametrize("degrees", [1, 2, 3, 4, 5, 10, 29, 100])
@pytest.mark.parametrize("probability", [0.025, 0.5, 0.75, 0.95, 0.975, 0.9995])
def test_t_quantiles_agree_with_scipy(probability: float, degrees: int):
    assert_allclose(t_quantile(probability, degrees), scipy.stats.t.ppf(probability, degrees), rtol=1e-9, atol=1e-12)


def test_a_t_quantile_without_freedom_is_refused():
    with pytest.raises(ValueError, match="0 degrees of freedom"):
        t_quantile(0.975, 0)


@pytest.mark.parametrize("aggregate", ["median", "mean", "iqm"])
def test_below_three_seeds_there_is_no_band(aggregate: Aggregate):
    y = np.array([[1.0, 1, 1, NAN], [2, 2, NAN, NAN], [3, NAN, NAN, NAN]])
    band = BANDS[aggregate](y, 0.95)
    assert_array_equal(np.isfinite(band.low), [True, False, False, False])
    assert_array_equal(np.isfinite(band.high), [True, False, False, False])
    assert_array_equal(np.isfinite(band.centre), [True, True, True, False])


def test_the_bootstrap_of_few_seeds_takes_every_draw_with_its_probability():
    resamples = resamples_of(3)
    chances = {
        tuple(map(int, row)): weight * 27 for row, weight in zip(resamples.copies, resamples.weights, strict=True)
    }
    assert len(chances) == 10
    assert chances[3, 0, 0] == pytest.approx(1)
    assert chances[2, 1, 0] == pytest.approx(3)
    assert chances[1, 1, 1] == pytest.approx(6)


def test_the_bootstrap_of_many_seeds_is_the_same_each_time():
    again = resamples_of.__wrapped__(12)
    assert_array_equal(resamples_of(12).copies, again.copies)
    assert resamples_of(12).copies.sum(axis=1).tolist() == [12.0] * len(again.copies)
    assert again.weights.sum() == pytest.approx(1)
    assert len(again.copies) <= RESAMPLES


def test_a_bootstrap_interval_is_that_of_a_plain_loop_over_all_draws():
    seeds = np.array([0.1, 0.35, 0.5, 0.9])
    draws = np.array(np.meshgrid(*[seeds] * 4)).reshape(4, -1).T
    replicates = [scipy.stats.trim_mean(draw, 0.25) for draw in draws]
    low, high = np.quantile(replicates, [0.025, 0.975], method="inverted_cdf")
    band = iqm_band(seeds[:, None], 0.95)
    assert_allclose([band.low[0], band.high[0]], [low, high])


def test_iqm_and_its_interval_agree_with_rliable():
    numbers = load_numbers()
    band = iqm_band(numbers["curves"], 0.95)
    centre, low, high = numbers["curve_iqm"]
    assert_allclose(band.centre, centre, rtol=1e-12)
    # rliable's 20,000 draws against all of them.
    assert_allclose(band.low, low, atol=0.01)
    assert_allclose(band.high, high, atol=0.01)
