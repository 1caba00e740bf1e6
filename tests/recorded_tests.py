"""Recorded tests made of hand-written numbers, for whoever reads, stores or shows them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from sldr_core.config import config_hash, config_to_dict
from sldr_core.episodes import Origin, RecordedEpisode, RecordedTest
from sldr_core.presets import make_config

STEPS = 4
"""Steps of a made episode."""


def made_episode(index: int = 0, **changes: Any) -> RecordedEpisode:
    """Return an episode of FetchPush whose numbers are all different."""
    rng = np.random.default_rng(index)

    def doubles(*shape: int) -> Any:
        return rng.normal(size=shape)

    def floats(*shape: int) -> Any:
        return rng.normal(size=shape).astype(np.float32)

    episode = RecordedEpisode(
        index=index,
        tag="other",
        resimulates=True,
        start_state=doubles(9),
        rng_state=np.random.default_rng(index).bit_generator.state,
        qpos=doubles(STEPS + 1, 22),
        qvel=doubles(STEPS + 1, 21),
        obs=floats(STEPS + 1, 25),
        goal=doubles(3),
        achieved=floats(STEPS + 1, 3),
        action=floats(STEPS, 4),
        reward=-np.abs(floats(STEPS, 2)),
        value=floats(STEPS, 2),
        wanted=floats(STEPS, 1, 7),
        induced=floats(STEPS, 1, 7),
        contact=rng.random((STEPS + 1, 1)) < 0.5,
        distance=np.abs(doubles(STEPS + 1)),
        angle=np.full(STEPS + 1, np.nan),
        success=np.zeros(STEPS + 1, dtype=bool),
    )
    return replace(episode, **changes)


def made_test(
    *episodes: RecordedEpisode, epoch: int = 12, streams: tuple[str, ...] = ("task", "sldr/object0")
) -> RecordedTest:
    """Return a test with these episodes, or with two made ones."""
    config = make_config("FetchPush", "manipulation", "her-sldr", 0, "smoke")
    origin = Origin(
        config=config_to_dict(config),
        config_hash=config_hash(config),
        epoch=epoch,
        env_steps=100 * epoch,
        streams=streams,
        parts=("object0",),
        objects=("object0",),
    )
    return RecordedTest(origin, episodes or (made_episode(0), made_episode(1)))
