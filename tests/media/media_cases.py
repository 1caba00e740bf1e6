"""A run with a policy and recorded episodes, and waiting for what is drawn of it."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.media_jobs import MediaJob, get_media
from backend.store.queue import claim
from backend.store.settings import Settings
from backend.store.storage import checksum
from sldr_core.config import config_hash, config_to_dict
from sldr_core.episodes import Origin, RecordedEpisode, RecordedTest, episodes_file, write_episodes
from sldr_core.presets import make_config
from sldr_core.training.build import build_training
from sldr_core.training.checkpoint import Counters
from sldr_core.training.policy import write_policy
from worker.media.host import MediaHost

PATIENCE_S = 180.0
"""Long, because the machine that runs the tests may be busy with others."""
STEPS = 6
"""Steps of the recorded episode."""
EPOCH = 3


def claimed_run(db: Database) -> Claim:
    """Launch a locomotion run and claim it."""
    launch(db, LaunchOrder("FetchPush", "locomotion", "her", (0,), "smoke"))
    held = claim(db, "here")
    assert held is not None
    return held


def store_file(db: Database, settings: Settings, held: Claim, path: Path, kind: str) -> None:
    """Register a file that lies in the run's directory."""
    place = str(path.relative_to(settings.home))
    register_file(db, held, path.name, kind, place, path.stat().st_size, checksum(path))


def store_policy(db: Database, settings: Settings, held: Claim) -> None:
    """Give a run an untrained policy."""
    path = settings.run_directory(held.run_id) / "policy-newest.pt"
    path.parent.mkdir(parents=True, exist_ok=True)
    config = make_config("FetchPush", phase="locomotion", method="her", seed=0, preset="smoke")
    write_policy(path, build_training(config, path.parent, ()), Counters(cycle=1, test_success_rate=0.0))
    store_file(db, settings, held, path, "policy")


def store_episodes(db: Database, settings: Settings, held: Claim) -> None:
    """Give a run a recorded episode in which the block slides over the table."""
    path = settings.run_directory(held.run_id) / episodes_file(EPOCH)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_episodes(path, RecordedTest(_origin(), (sliding_episode(),)))
    store_file(db, settings, held, path, "episodes")


def sliding_episode() -> RecordedEpisode:
    """Return a locomotion episode of FetchPush: 15 cm in `STEPS` steps."""
    qpos = np.tile(np.array([1.25, 0.75, 0.42, 1.0, 0.0, 0.0, 0.0]), (STEPS + 1, 1))
    qpos[:, 0] += np.linspace(0.0, 0.15, STEPS + 1)
    nothing = np.zeros((STEPS, 1), dtype=np.float32)
    return RecordedEpisode(
        index=0,
        tag="other",
        resimulates=True,
        start_state=np.zeros(9),
        rng_state=np.random.default_rng(0).bit_generator.state,
        qpos=qpos,
        qvel=np.zeros((STEPS + 1, 6)),
        obs=np.zeros((STEPS + 1, 13), dtype=np.float32),
        goal=np.array([1.4, 0.75, 0.42]),
        achieved=qpos[:, :3].astype(np.float32),
        action=np.zeros((STEPS, 7), dtype=np.float32),
        reward=nothing - 1.0,
        value=nothing,
        wanted=np.zeros((STEPS, 0, 7), dtype=np.float32),
        induced=np.zeros((STEPS, 0, 7), dtype=np.float32),
        contact=np.zeros((STEPS + 1, 1), dtype=bool),
        distance=np.abs(1.4 - qpos[:, 0]),
        angle=np.full(STEPS + 1, np.nan),
        success=np.abs(1.4 - qpos[:, 0]) < 0.05,
    )


def _origin() -> Origin:
    config = make_config("FetchPush", phase="locomotion", method="her", seed=0, preset="smoke")
    return Origin(
        config=config_to_dict(config),
        config_hash=config_hash(config),
        epoch=EPOCH,
        env_steps=600,
        streams=("task",),
        parts=(),
        objects=("object0",),
    )


def tick_until_ended(host: MediaHost, db: Database, job_id: str) -> MediaJob:
    """Let the host work until a job is done or has failed."""
    give_up_at = time.monotonic() + PATIENCE_S
    while (job := get_media(db, job_id)).state in ("queued", "running"):
        assert time.monotonic() < give_up_at, f"still {job.state}"
        host.tick()
        time.sleep(0.02)
    return replace(job)
