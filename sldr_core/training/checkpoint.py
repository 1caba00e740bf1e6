"""The checkpoint: everything that decides what comes next, so that a resumed run ends with the same bits."""

from __future__ import annotations

import json
import logging
import shutil
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
import torch

from sldr_core.config import TrainConfig, config_from_dict, config_hash, config_to_dict
from sldr_core.disk import write_atomically
from sldr_core.envs import Envs
from sldr_core.errors import BadFile, InvalidConfig
from sldr_core.nets.files import UNFIT, load_tensors, one_line, save_tensors
from sldr_core.training.build import Parts
from sldr_core.training.files import (
    CHECKPOINT_FILE,
    DAMAGED_CHECKPOINT_FILE,
    PREVIOUS_CHECKPOINT_FILE,
    REPLAY_FILE,
)

KIND = "checkpoint"

PARTS = frozenset(
    (
        *("agent", "inverse", "streams", "envs", "test_envs"),
        *("sampler_rng", "exploration_rng", "counters", "replay_written", "replay_bytes"),
    )
)
"""What a checkpoint cannot do without."""

COUNTED_LATER = {"best_epoch": 0, "warmup_cycles": 0}
"""Counters that checkpoints of earlier versions lack."""

START_ANEW = "remove every checkpoint of this directory to start the run anew"

log = logging.getLogger(__name__)


@dataclass
class Counters:
    """How far a training is; the only state of the loop itself."""

    warmup_cycles: int = 0
    """Cycles of random actions collected before the first update."""
    cycle: int = 0
    env_steps: int = 0
    episodes: int = 0
    updates: int = 0
    wall_seconds: float = 0.0
    """Seconds of training in earlier attempts and this one [s]."""
    test_success_rate: float = -1.0
    """Success of the newest test; -1 before the first."""
    best_success_rate: float = -1.0
    """Success of the best test; -1 before the first."""
    best_epoch: int = 0
    """Epoch of the best test; 0 before the first."""
    tests_held: int = 0
    """Newest tests in a row that reached `loop.stop_at_success`."""

    def are_final(self, config: TrainConfig) -> bool:
        """Tell whether a training of `config` has come to its end."""
        wanted = config.loop.stop_after_tests
        return 0 < wanted <= self.tests_held or self.cycle >= config.total_cycles


class ForeignCheckpoint(BadFile):
    """Report a checkpoint of another run than the one that is to go on."""


@dataclass(frozen=True)
class Kept:
    """A checkpoint as it lies on the disk, read but not yet used."""

    path: Path
    content: dict[str, Any]
    counters: Counters


def write_checkpoint(path: Path, parts: Parts, counters: Counters) -> None:
    """Write the whole state of a training to `path`; the replay file is flushed first."""
    parts.buffer.flush()
    save_tensors(
        path,
        {
            "kind": KIND,
            "config": config_to_dict(parts.config),
            "config_hash": config_hash(parts.config),
            "counters": asdict(counters),
            "agent": parts.agent.state_dict(),
            "inverse": parts.inverse.state_dict() if parts.inverse else None,
            "streams": {stream.name: stream.state_dict() for stream in parts.streams},
            "envs": _pack_envs(parts.envs),
            "test_envs": _pack_envs(parts.test_envs),
            "sampler_rng": _pack_rng(parts.sampler.rng),
            "exploration_rng": _pack_rng(parts.exploration.rng),
            "replay_written": parts.buffer.written,
            "replay_bytes": parts.buffer.file_size,
        },
    )


def keep_previous(directory: Path) -> None:
    """Keep a copy of the newest checkpoint, which is about to be replaced."""
    newest = directory / CHECKPOINT_FILE

    def copy(path: Path) -> None:
        shutil.copyfile(newest, path)

    if newest.exists():
        write_atomically(directory / PREVIOUS_CHECKPOINT_FILE, copy)


def read_newest(directory: Path, config: TrainConfig) -> Kept | None:
    """Read the newest usable checkpoint of a directory, if it holds any; say so if that is not the newest.

    Raises:
        BadFile: none can be used, or the newest was made by another config.
    """
    problem: BadFile | None = None
    newest, previous = directory / CHECKPOINT_FILE, directory / PREVIOUS_CHECKPOINT_FILE
    for path in (path for path in (newest, previous) if path.exists()):
        try:
            kept = read_checkpoint(path, config)
        except ForeignCheckpoint:
            raise
        except BadFile as err:
            problem = problem or err
            continue
        if path == previous:
            _fall_back(kept, newest, problem)
        return kept
    if problem is not None:
        raise problem
    return None


def read_checkpoint(path: Path, config: TrainConfig) -> Kept:
    """Read a checkpoint that fits a config; nothing in its directory is touched.

    Raises:
        ForeignCheckpoint: it was made by another config.
        BadFile: the file is corrupt, lacks a part, or has lost its replay file before its training was over.
    """
    content = load_tensors(path, KIND, way_out=START_ANEW)
    if not _is_of(content, config):
        raise ForeignCheckpoint(
            f"{path} was made by another config than this run's; use another directory, or remove it to start anew."
        )
    missing = sorted(PARTS - content.keys())
    if missing:
        raise BadFile(f"{path} is no whole checkpoint: it lacks {', '.join(missing)}; {START_ANEW}.")
    kept = Kept(path, content, _read_counters(path, content["counters"]))
    replay, size = path.with_name(REPLAY_FILE), content["replay_bytes"]
    whole = isinstance(size, int) and replay.is_file() and replay.stat().st_size == size
    # Nobody needs the replay file of a training that is over, and we tell people to remove it.
    if not whole and not kept.counters.are_final(config):
        raise BadFile(f"{path} needs {replay}, which is gone or was cut short; {START_ANEW}.")
    return kept


def restore_training(kept: Kept, parts: Parts) -> None:
    """Bring a training to the state of a checkpoint.

    Raises:
        BadFile: a part of it does not fit.
    """
    content = kept.content
    try:
        parts.agent.load_state_dict(content["agent"])
        if parts.inverse is not None:
            parts.inverse.load_state_dict(content["inverse"])
        for stream in parts.streams:
            stream.load_state_dict(content["streams"][stream.name])
        _unpack_envs(parts.envs, content["envs"])
        _unpack_envs(parts.test_envs, content["test_envs"])
        _unpack_rng(parts.sampler.rng, content["sampler_rng"])
        _unpack_rng(parts.exploration.rng, content["exploration_rng"])
        parts.buffer.written = int(content["replay_written"])
    except UNFIT as err:
        raise _not_whole(kept.path, err) from err


def _read_counters(path: Path, found: Any) -> Counters:
    try:
        values = {**COUNTED_LATER, **found}
        return Counters(**{field.name: _number(values[field.name]) for field in fields(Counters)})
    except UNFIT as err:
        raise _not_whole(path, err) from err


def _number(value: Any) -> Any:
    """Return a counter as it is.

    Raises:
        TypeError: it is no number.
    """
    if not isinstance(value, int | float):
        raise TypeError(f"a counter is {value!r}")
    return value


def _not_whole(path: Path, err: Exception) -> BadFile:
    return BadFile(f"{path} is no whole checkpoint ({one_line(err)}); {START_ANEW}.")


def _fall_back(kept: Kept, newest: Path, problem: BadFile | None) -> None:
    """Tell that a training goes on from an earlier checkpoint, and set the damaged one aside."""
    reason = str(problem or f"There is no {newest}.")
    if newest.exists():
        # Under its own name it would be taken for the previous checkpoint when the next one is written.
        newest.rename(newest.with_name(DAMAGED_CHECKPOINT_FILE))
    log.warning("%s Going on from %s, after cycle %d.", reason, kept.path, kept.counters.cycle)


def _is_of(content: dict[str, Any], config: TrainConfig) -> bool:
    """Tell whether a checkpoint is of a config: hashes would differ once a setting is added."""
    try:
        return config_from_dict(content["config"]) == config
    except (InvalidConfig, KeyError):
        return False


def _pack_rng(rng: np.random.Generator) -> str:
    return json.dumps(rng.bit_generator.state)


def _unpack_rng(rng: np.random.Generator, packed: str) -> None:
    rng.bit_generator.state = json.loads(packed)


def _pack_envs(envs: Envs) -> dict[str, Any]:
    state = envs.state()
    return {
        "simulation": torch.from_numpy(state["simulation"]),
        "goal": torch.from_numpy(state["goal"]),
        "rngs": json.dumps(state["rngs"]),
    }


def _unpack_envs(envs: Envs, packed: dict[str, Any]) -> None:
    envs.restore(
        {
            "simulation": packed["simulation"].numpy(),
            "goal": packed["goal"].numpy(),
            "rngs": json.loads(packed["rngs"]),
        }
    )
