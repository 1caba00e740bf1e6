"""How long each seed took, kept so that a measurement of hours can be interrupted, or told with more time of the peer.

Only what the same code gave on the same machine counts.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import Path

from measured_page import describe_machine

import sldr_core

KEPT = Path("build/reached")
"""A file for each task."""


@dataclass(frozen=True)
class Reached:
    """Say how long it took, and how far it came; infinitely long if it did not come there."""

    seconds: float
    best: float


def reach_each(task: str, seeds: Sequence[int], reach: Callable[[str, int], Reached], take_kept: bool) -> list[Reached]:
    """Train each seed of a task, but those that have been trained before.

    Args:
        task: what is learnt.
        seeds: of its trainings.
        reach: trains one, given task and seed.
        take_kept: whether those are taken; else all are trained.
    """
    # Asked for once, before: the code may be edited while a seed trains.
    measured = _what_is_measured()
    reached = _read(task, measured) if take_kept else {}
    for seed in seeds:
        if seed not in reached:
            reached[seed] = reach(task, seed)
            _keep(task, measured, reached)
    return [reached[seed] for seed in seeds]


def _read(task: str, measured: str) -> dict[int, Reached]:
    path = _file_of(task)
    kept = json.loads(path.read_text()) if path.exists() else {}
    if kept.get("measured") != measured:
        return {}
    return {int(seed): Reached(**one) for seed, one in kept["seeds"].items()}


def _keep(task: str, measured: str, reached: dict[int, Reached]) -> None:
    KEPT.mkdir(parents=True, exist_ok=True)
    seeds = {seed: asdict(one) for seed, one in reached.items()}
    _file_of(task).write_text(json.dumps({"measured": measured, "seeds": seeds}, indent=1) + "\n")


def _file_of(task: str) -> Path:
    return KEPT / f"{task}.json"


def _what_is_measured() -> str:
    """Return the machine in words, and a hash of the code that trains."""
    digest = sha256()
    package = Path(sldr_core.__path__[0])
    for source in sorted(package.rglob("*.py")):
        digest.update(source.relative_to(package).as_posix().encode())
        digest.update(source.read_bytes())
    return f"{describe_machine()}, code {digest.hexdigest()}"
