"""Draws of seeds are counted as they are, in memory that grows with the seeds and not with their square."""

from __future__ import annotations

import tracemalloc

import numpy as np
from numpy.testing import assert_array_equal

from backend.statistics.resampling import RESAMPLES, count_copies, resamples_of
from backend.statistics.scores import performance_profile


def test_copies_are_counted_draw_by_draw():
    members = np.array([[0, 0, 2], [1, 2, 2]])
    assert_array_equal(count_copies(members, 3), [[2, 0, 1], [0, 1, 2]])


def test_the_bootstrap_of_many_seeds_takes_no_memory_of_their_square():
    seeds = 211
    tracemalloc.start()
    try:
        resamples_of(seeds)
        performance_profile([np.linspace(0.0, 1.0, seeds)], np.array([0.5]), 0.95)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    # Some arrays of draws x seeds of eight bytes each.
    assert peak < 12 * RESAMPLES * seeds * 8
