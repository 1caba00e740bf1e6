"""Small things to look at: locomotion models that know nothing, and an episode of random actions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import torch

from sldr_core.config import config_hash, config_to_dict
from sldr_core.envs import Envs, make_envs
from sldr_core.episodes import Origin, RecordedEpisode, RecordedTest
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import make_config
from worker.viewer.simulated import Simulated

STEPS = 12
"""Steps of a made episode."""


def make_model(task: str, seed: int = 0) -> LocomotionModel:
    """Return a locomotion model with random weights: an object with wishes of its own."""
    config = make_config(task, "locomotion", "her", seed, "smoke")
    nets = LocomotionNets(config, torch.Generator().manual_seed(seed))
    return LocomotionModel(nets.requires_grad_(False).eval(), config, Measured(0.5, 10))


def save_model(task: str, path: Path) -> Path:
    """Write such a model."""
    make_model(task).save(path)
    return path


def random_actions(envs: Envs, seed: int = 0) -> Simulated:
    """Return an episode in which somebody acts at random."""
    rng = np.random.default_rng(seed)
    return Simulated(envs, lambda obs, goal: rng.uniform(-1, 1, (len(obs), envs.action_size)).astype(np.float32))


def record(task: str, seed: int = 3) -> tuple[RecordedTest, RecordedEpisode]:
    """Return a recorded episode of random actions; what was judged of it is made up, its states are not."""
    envs = make_envs(task, seed=seed, testing=True)
    episode = random_actions(envs, seed)
    before = envs.state()
    moments = [episode.moment(step) for step in range(STEPS + 1)]
    rng = np.random.default_rng(seed)
    parts = tuple(part.name for part in envs.spec.parts)
    shape = (STEPS, len(parts), envs.spec.object_action_size)
    kept = RecordedEpisode(
        index=0,
        tag="other",
        resimulates=True,
        start_state=before["simulation"][0],
        rng_state=before["rngs"][0],
        qpos=np.stack([each.qpos for each in moments]),
        qvel=np.stack([each.qvel for each in moments]),
        obs=np.stack([each.obs for each in moments]).astype(np.float32),
        goal=moments[0].goal,
        achieved=np.stack([each.achieved for each in moments]).astype(np.float32),
        action=np.stack([episode.action(step) for step in range(STEPS)]),
        reward=-rng.random((STEPS, 1 + len(parts)), dtype=np.float32),
        value=rng.random((STEPS, 1 + len(parts)), dtype=np.float32),
        wanted=rng.random(shape, dtype=np.float32),
        induced=rng.random(shape, dtype=np.float32),
        contact=rng.random((STEPS + 1, 1)) < 0.5,
        distance=np.linalg.norm(np.stack([each.achieved - each.goal for each in moments])[:, :3], axis=1),
        angle=np.full(STEPS + 1, np.nan),
        success=np.zeros(STEPS + 1, dtype=np.bool_),
    )
    config = make_config(task, "manipulation", "her-sldr", 0, "smoke")
    streams = ("task", *(f"sldr/{part}" for part in parts))
    origin = Origin(config_to_dict(config), config_hash(config), 2, 100, streams, parts, ("object0",))
    return RecordedTest(origin, (kept,)), kept
