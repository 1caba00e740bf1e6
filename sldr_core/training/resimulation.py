"""Simulating recorded episodes again, from their starts and actions alone, and comparing every bit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sldr_core.config import TrainConfig, config_from_dict
from sldr_core.envs import Envs, make_envs
from sldr_core.episodes import Course, RecordedTest
from sldr_core.errors import BadFile, InvalidConfig


def resimulate(test: RecordedTest, threads: int = 1) -> list[int | None]:
    """Simulate a recorded test's episodes again; return the first moment of each that differs, or None.

    Raises:
        BadFile: its config is none of this version's, or its states are of another scene.
    """
    try:
        config = config_from_dict(dict(test.origin.config))
        return first_differences(make_resimulation(config, len(test.episodes), threads), test.episodes)
    except (InvalidConfig, ValueError) as err:
        raise BadFile(
            f"The episodes of epoch {test.origin.epoch} cannot be simulated by this version ({err}); "
            "use the one that recorded them."
        ) from err


def make_resimulation(config: TrainConfig, episodes: int, threads: int = 1) -> Envs:
    """Build simulations of their own for so many episodes of a training's tests."""
    return make_envs(
        config.task,
        config.phase,
        num_envs=episodes,
        threads=threads,
        robot=config.scene.locomotion_robot,
        testing=True,
        variant=config.scene.variant,
    )


def first_differences(envs: Envs, courses: Sequence[Course]) -> list[int | None]:
    """Simulate episodes again and return, for each, the first moment that came out differently, or None.

    Args:
        envs: as many simulations of the episodes' scene as there are episodes.
        courses: the episodes, all of one length.

    Raises:
        ValueError: the episodes are of another scene, or not as many.
    """
    envs.restore(
        {
            "simulation": np.stack([course.start_state for course in courses]),
            "goal": np.stack([course.goal for course in courses]),
            "rngs": [course.rng_state for course in courses],
        }
    )
    actions = np.stack([course.action for course in courses])
    kept = np.stack([np.concatenate([course.qpos, course.qvel], axis=1) for course in courses])
    same = np.empty(kept.shape[:2], dtype=np.bool_)
    for t in range(kept.shape[1]):
        if t > 0:
            envs.step(actions[:, t - 1])
        same[:, t] = np.all(np.concatenate([envs.qpos, envs.qvel], axis=1) == kept[:, t], axis=1)
    return [None if row.all() else int(row.argmin()) for row in same]
