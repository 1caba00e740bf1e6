"""What went wrong in an episode, by rules on its curves.

`N` episodes, `T` steps, `O` objects. An episode has one tag: the first below whose rule it meets.

| tag | rule |
|---|---|
| `success` | the goal is reached at the last moment |
| `never_touched` | the robot touched no object at any moment, and none came off its start by more than `MOVED` |
| `dropped` | an object ends at least `FALL` below where it was before, out of the robot's touch |
| `overshot` | the goal was reached earlier, and is not at the end |
| `too_slow` | over the last `CLOSING_STEPS` steps the gap to the goal shrank by at least `CLOSING_SHARE` of itself |
| `other` | none of these |

Where the object moves itself nobody has to touch it, so `never_touched` and `dropped` are not given.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

Tag = Literal["success", "never_touched", "dropped", "overshot", "too_slow", "other"]
"""How an episode ended, or what went wrong in it."""

TAGS: tuple[Tag, ...] = get_args(Tag)

MOVED = 0.005
"""An object further from its start than this was moved, also where the touch itself fell between two moments [m]."""

FALL = 0.03
"""An object that comes down by this has fallen, if nothing holds it [m]."""

CLOSING_STEPS = 10
"""The end of an episode, in which it shows whether the goal was being approached [steps]."""

CLOSING_SHARE = 0.1
"""Share of the gap that has to be closed in that time."""


def tag_episodes(
    success: NDArray[np.bool_],
    gap: NDArray[np.floating],
    position: NDArray[np.floating],
    touched: NDArray[np.bool_] | None,
    held: NDArray[np.bool_] | None,
) -> list[Tag]:
    """Return the tag of each episode.

    Args:
        success: whether the goal is reached, `[N, T+1]`.
        gap: how far off it is in thresholds of success: 1 is where success begins, `[N, T+1]`.
        position: positions of the objects [m], `[N, T+1, O, 3]`.
        touched: whether the robot touched any object at any moment, `[N]`; None where the object moves itself.
        held: whether it touches each object at the last moment, `[N, O]`; None where the object moves itself.
    """
    rules: list[tuple[Tag, NDArray[np.bool_]]] = [("success", success[:, -1])]
    if touched is not None and held is not None:
        rules.append(("never_touched", ~touched & ~_has_moved(position)))
        rules.append(("dropped", np.any(_has_fallen(position) & ~held, axis=1)))
    rules.append(("overshot", np.any(success, axis=1)))
    rules.append(("too_slow", _is_closing(gap)))
    names = np.select([met for _, met in rules], [TAGS.index(tag) for tag, _ in rules], TAGS.index("other"))
    return [TAGS[name] for name in names.tolist()]


def tag_shares(tags: Sequence[Tag]) -> dict[Tag, float]:
    """Return the share of each tag, which add up to 1; nothing of no episodes."""
    return {tag: tags.count(tag) / len(tags) for tag in TAGS} if tags else {}


def _has_moved(position: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Tell in which episodes any object came off its start, `[N]`."""
    away = np.linalg.norm(position - position[:, :1], axis=-1)
    return np.any(away > MOVED, axis=(1, 2))


def _has_fallen(position: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Tell which objects end below where they were, `[N, O]`."""
    height = position[..., 2]
    return height.max(axis=1) - height[:, -1] >= FALL


def _is_closing(gap: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Tell in which episodes the goal was being approached at the end, `[N]`."""
    before = gap[:, max(0, gap.shape[1] - 1 - CLOSING_STEPS)]
    return gap[:, -1] <= (1.0 - CLOSING_SHARE) * before
