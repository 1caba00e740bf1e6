"""The inspector's colours: for every kind of colour vision, on a grey table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Colours = NDArray[np.uint8]

SUCCESS_RGB = (0, 128, 92)
"""Paths of demonstrations that ended at their goals."""

FAILURE_RGB = (213, 94, 0)
"""Paths of those that did not; they are drawn thicker, too."""

SHOWN_RGB = (20, 20, 24)
"""The path of the demonstration that is played."""

SCALE: Colours = np.array(
    [
        (68, 1, 84),
        (72, 40, 120),
        (62, 74, 137),
        (49, 104, 142),
        (38, 130, 142),
        (31, 158, 137),
        (53, 183, 121),
        (110, 206, 88),
        (181, 222, 43),
        (253, 231, 37),
    ],
    dtype=np.uint8,
)
"""From low to high, evenly brighter: viridis in ten colours."""


def colours_of(share: NDArray[np.floating]) -> Colours:
    """Return colours `[..., 3]` of shares from 0 to 1 `[...]`, between the scale's."""
    place = np.clip(share, 0.0, 1.0) * (len(SCALE) - 1)
    below = np.minimum(place.astype(np.int64), len(SCALE) - 2)
    part = (place - below)[..., None]
    return ((1.0 - part) * SCALE[below] + part * SCALE[below + 1]).round().astype(np.uint8)


def shares_of(values: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return where values lie between their least and their greatest, 0 to 1; all 0 if they are equal."""
    low, high = float(values.min()), float(values.max())
    return (np.asarray(values, dtype=np.float64) - low) / max(high - low, 1e-9)
