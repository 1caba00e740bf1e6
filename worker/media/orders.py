"""What the host of media jobs and its drawing process tell each other."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from backend.store.media_jobs import MediaKind


@dataclass(frozen=True)
class DrawOrder:
    """Ask for one picture or video."""

    kind: MediaKind
    source: Path
    """A file of recorded episodes, or one that holds a policy."""
    target: Path
    """The file to write; its ending says in which form."""
    width: int
    """[pixels]."""
    height: int
    """[pixels]."""
    number: int
    """Which of the recorded episodes, or the seed of the episode that the policy makes."""


@dataclass(frozen=True)
class Drawn:
    """Tell that a file was written."""

    size: int
    """Length [bytes]."""
    sha256: str


@dataclass(frozen=True)
class NotDrawn:
    """Tell why there is no file, in one sentence."""

    reason: str
    is_machine: bool = False
    """Whether this machine can draw nothing at all."""


Answer = Drawn | NotDrawn
