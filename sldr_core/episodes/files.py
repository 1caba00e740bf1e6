"""The file of a test's recorded episodes: compressed numpy arrays with a JSON header, read as data alone."""

from __future__ import annotations

import io
import json
import math
import re
import zlib
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, cast
from zipfile import BadZipFile

import numpy as np
from numpy.typing import DTypeLike, NDArray

from sldr_core.episodes.record import Origin, RecordedEpisode, RecordedTest
from sldr_core.episodes.tags import TAGS, Tag
from sldr_core.errors import BadFile

KIND = "episodes"
"""What such a file calls itself."""

FORMAT = 1
"""Version of what the file holds; raised whenever a reader of this one would be misled."""

HEADER = "header"

LAYOUT: dict[str, tuple[DTypeLike, tuple[str, ...]]] = {
    "start_state": (np.float64, ("K",)),
    "qpos": (np.float64, ("T+1", "nq")),
    "qvel": (np.float64, ("T+1", "nv")),
    "obs": (np.float32, ("T+1", "D")),
    "goal": (np.float64, ("G",)),
    "achieved": (np.float32, ("T+1", "G")),
    "action": (np.float32, ("T", "A")),
    "reward": (np.float32, ("T", "S")),
    "value": (np.float32, ("T", "S")),
    "wanted": (np.float32, ("T", "P", "U")),
    "induced": (np.float32, ("T", "P", "U")),
    "contact": (np.bool_, ("T+1", "O")),
    "distance": (np.float64, ("T+1",)),
    "angle": (np.float64, ("T+1",)),
    "success": (np.bool_, ("T+1",)),
}
"""Type and axes of every array of an episode; in the file one axis over the episodes comes before them."""

_NAME = re.compile(r"episodes-epoch-(\d{4,})\.npz")

_UNREADABLE = (
    BadZipFile,
    EOFError,
    AttributeError,
    LookupError,
    NotImplementedError,
    OSError,
    RuntimeError,
    TypeError,
    ValueError,
    zlib.error,
)
"""What zipfile, numpy and json raise on files that are cut short, damaged or foreign."""


def episodes_file(epoch: int) -> str:
    """Return the name of the file of the test after `epoch`."""
    return f"episodes-epoch-{epoch:04d}.npz"


def epoch_of(name: str) -> int | None:
    """Return the epoch that a file of this name is of, or None if it is no file of episodes."""
    found = _NAME.fullmatch(name)
    return int(found[1]) if found else None


def episode_bytes(sizes: Mapping[str, int]) -> int:
    """Return what the arrays of one episode take before they are packed [bytes], from the sizes of all axes but T+1."""
    known = {**sizes, "T+1": sizes["T"] + 1}
    return sum(np.dtype(kind).itemsize * math.prod(known[axis] for axis in axes) for kind, axes in LAYOUT.values())


def write_episodes(path: Path, test: RecordedTest) -> None:
    """Write a test's episodes; equal episodes make equal bytes.

    Raises:
        ValueError: there is no episode, or arrays do not fit together.
        OSError: the disk is full, and the like.
    """
    arrays = {
        name: np.stack([np.asarray(getattr(episode, name), dtype=kind) for episode in test.episodes])
        for name, (kind, _) in LAYOUT.items()
    }
    problem = _misfit(test.origin, arrays)
    if problem is not None:
        raise ValueError(problem)
    header = {
        "kind": KIND,
        "format": FORMAT,
        "origin": asdict(test.origin),
        "episodes": [
            {
                "index": episode.index,
                "tag": episode.tag,
                "resimulates": episode.resimulates,
                "rng_state": dict(episode.rng_state),
            }
            for episode in test.episodes
        ],
    }
    # By way of memory: numpy would add an ending to a temporary name, and zipfile hides that a disk is full.
    packed = io.BytesIO()
    np.savez_compressed(packed, **{HEADER: np.array(json.dumps(header))}, **cast(dict[str, Any], arrays))
    path.write_bytes(packed.getbuffer())


def read_episodes(path: Path) -> RecordedTest:
    """Read a test's episodes.

    Raises:
        BadFile: the file is missing, cut short, damaged, foreign or of a newer version.
    """
    if not path.is_file():
        raise BadFile(f"There is no file {path}; give a file of recorded episodes, as in {episodes_file(12)}.")
    try:
        return _read(path)
    except _UNREADABLE as err:
        raise BadFile(f"{path} is cut short, damaged or no file of recorded episodes; fetch it again.") from err


def _read(path: Path) -> RecordedTest:
    with path.open("rb") as file:
        archive = np.load(file, allow_pickle=False)
        header = json.loads(str(archive[HEADER][()]))
        if header["kind"] != KIND:
            raise ValueError(f"a file of kind {header['kind']}")
        if header["format"] != FORMAT:
            raise BadFile(
                f"{path} is of format {header['format']} and this version reads format {FORMAT}; update to read it."
            )
        arrays: dict[str, NDArray[Any]] = {name: archive[name] for name in LAYOUT}
    origin = _origin(header["origin"])
    notes = header["episodes"]
    problem = _misfit(origin, arrays)
    if problem is None and len(notes) != len(arrays["qpos"]):
        problem = f"{len(notes)} episodes are described, {len(arrays['qpos'])} are there"
    if problem is not None:
        raise ValueError(problem)
    return RecordedTest(origin, tuple(_episode(arrays, at, note) for at, note in enumerate(notes)))


def _origin(values: Mapping[str, Any]) -> Origin:
    return Origin(
        config=dict(values["config"]),
        config_hash=str(values["config_hash"]),
        epoch=int(values["epoch"]),
        env_steps=int(values["env_steps"]),
        streams=tuple(values["streams"]),
        parts=tuple(values["parts"]),
        objects=tuple(values["objects"]),
    )


def _episode(arrays: Mapping[str, NDArray[Any]], at: int, note: Mapping[str, Any]) -> RecordedEpisode:
    tag = note["tag"]
    if tag not in TAGS:
        raise ValueError(f"unknown tag {tag}")
    return RecordedEpisode(
        index=int(note["index"]),
        tag=cast(Tag, tag),
        resimulates=bool(note["resimulates"]),
        rng_state=note["rng_state"],
        **{name: array[at] for name, array in arrays.items()},
    )


def _misfit(origin: Origin, arrays: Mapping[str, NDArray[Any]]) -> str | None:
    """Return what is wrong with the types or shapes of a file's arrays, if anything is."""
    sizes = {"S": len(origin.streams), "P": len(origin.parts), "O": len(origin.objects)}
    episodes = len(arrays["qpos"])
    sizes["T"] = arrays["action"].shape[1] if arrays["action"].ndim > 1 else 0
    sizes["T+1"] = sizes["T"] + 1
    for name, (kind, axes) in LAYOUT.items():
        array = arrays[name]
        if array.dtype != kind or array.ndim != len(axes) + 1:
            return f"'{name}' is {array.dtype} {array.shape}"
        expected = (episodes, *(sizes.setdefault(axis, size) for axis, size in zip(axes, array.shape[1:], strict=True)))
        if array.shape != expected:
            return f"'{name}' has the shape {array.shape} instead of {expected}"
    return None if episodes and sizes["T"] else "there is no episode in it"
