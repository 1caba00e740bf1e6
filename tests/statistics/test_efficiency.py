"""What is needed until a threshold is first reached; seeds that never reach it count as needing most."""

from __future__ import annotations

import numpy as np
import pytest

from backend.statistics.alignment import Curve
from backend.statistics.efficiency import TimesToReach, time_to_reach, times_to_reach

RISING = Curve(np.array([10.0, 20, 30, 40]), np.array([0.1, 0.6, 0.4, 0.9]))


@pytest.mark.parametrize(("threshold", "reached"), [(0.05, 10), (0.5, 20), (0.6, 20), (0.8, 40), (0.95, None)])
def test_the_first_test_at_or_above_a_threshold_counts(threshold: float, reached: float | None):
    assert time_to_reach(RISING, threshold) == reached


def test_a_curve_without_points_reaches_nothing():
    assert time_to_reach(Curve(np.empty(0), np.empty(0)), 0.5) is None


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        ([30, 10, 20], TimesToReach(3, 20, 15, 25)),
        # Sorted 10 20 30 inf inf: the median is the third, the third quartile one that never came.
        ([30, None, 10, None, 20], TimesToReach(3, 30, 20, None)),
        ([None, 10, None], TimesToReach(1, None, None, None)),
        ([None, None], TimesToReach(0, None, None, None)),
        ([], TimesToReach(0, None, None, None)),
    ],
)
def test_median_and_quartiles_of_times(times: list[float | None], expected: TimesToReach):
    assert times_to_reach(times) == expected
