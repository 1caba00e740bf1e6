"""Curves of several seeds are read on one grid, and nothing is invented."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from backend.statistics.alignment import Curve, Loss, align, common_grid, find_losses

NAN = np.nan


def curve(*points: tuple[float, float]) -> Curve:
    x, y = np.array(points, dtype=float).reshape(-1, 2).T
    return Curve(x, y)


def by_plain_loop(curves: list[Curve], grid: np.ndarray) -> np.ndarray:
    """Say the same without searchsorted: the newest point at or before each place, up to the curve's last."""
    rows = []
    for one in curves:
        row = []
        for place in grid:
            value = NAN
            for x, y in zip(one.x, one.y, strict=True):
                if x <= place <= one.x[-1]:
                    value = y
            row.append(value)
        rows.append(row)
    return np.array(rows)


def test_a_value_holds_until_the_next_and_neither_before_the_first_nor_after_the_last():
    aligned = align([curve((1, 10), (3, 30))], np.array([0.0, 1, 2, 3, 4]))
    assert_array_equal(aligned.y, [[NAN, 10, 10, 30, NAN]])
    assert_array_equal(aligned.n, [0, 1, 1, 1, 0])


def test_the_last_value_of_a_training_that_is_done_holds_to_the_end_of_the_grid():
    done, going = Curve(np.array([1.0, 2.0]), np.array([10.0, 20.0]), holds=True), curve((1, 5), (2, 6), (4, 7))
    aligned = align([done, going], np.array([0.0, 1, 2, 3, 4]))
    assert_array_equal(aligned.y, [[NAN, 10, 20, 20, 20], [NAN, 5, 6, 6, 7]])
    assert_array_equal(aligned.n, [0, 2, 2, 2, 2])
    assert_array_equal(aligned.measured, [0, 2, 2, 1, 1])
    assert find_losses(aligned) == [Loss(2.0, 2, 1)]


def test_ragged_curves_are_aligned_as_by_a_plain_loop():
    rng = np.random.default_rng(3)
    curves = [Curve(np.sort(rng.random(n)), rng.random(n)) for n in (1, 4, 9, 17)]
    grid = np.sort(rng.random(40))
    assert_array_equal(align(curves, grid).y, by_plain_loop(curves, grid))


def test_of_points_at_the_same_place_the_last_counts():
    assert_array_equal(align([curve((1, 10), (1, 11))], np.array([1.0])).y, [[11]])


def test_a_curve_without_points_has_no_value_anywhere():
    assert_array_equal(align([curve(), curve((1, 5))], np.array([1.0])).y, [[NAN], [5]])


def test_the_grid_is_every_place_of_any_curve():
    assert_array_equal(common_grid([curve((1, 0), (3, 0)), curve((2, 0), (3, 0))], 9), [1, 2, 3])
    assert len(common_grid([], 9)) == 0


def test_a_thinned_grid_keeps_its_ends_and_takes_only_places_that_were_measured():
    places = np.linspace(0.0, 1.0, 1001)
    grid = common_grid([Curve(places, places)], 10)
    assert (len(grid), grid[0], grid[-1]) == (10, 0.0, 1.0)
    assert np.isin(grid, places).all()


def test_it_is_found_where_curves_end_before_others():
    curves = [curve((1, 0), (2, 0), (3, 0)), curve((1, 0), (2, 0)), curve((2, 0), (3, 0))]
    assert find_losses(align(curves, common_grid(curves, 9))) == [Loss(2.0, 3, 2)]


def test_curves_that_end_together_lose_nothing():
    curves = [curve((1, 0), (2, 0)), curve((1, 0), (2, 0))]
    assert find_losses(align(curves, common_grid(curves, 9))) == []
