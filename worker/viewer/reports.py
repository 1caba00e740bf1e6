"""What the viewer host and its session processes tell each other."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Job:
    """Ask a process to serve one 3D session."""

    session_id: str
    policy_path: Path
    """The policy file to show and to follow."""
    host_pid: int
    """The process that the session must not outlive."""


@dataclass(frozen=True)
class Ready:
    """Tell that a page can be opened."""

    port: int
    """Where it is served on 127.0.0.1."""
    message: str
    """What it shows, in one sentence."""


@dataclass(frozen=True)
class Watched:
    """Tell how many people look at a session, each time that changes."""

    clients: int


@dataclass(frozen=True)
class Broken:
    """Tell, as the last thing, why a session cannot go on."""

    message: str


Report = Ready | Watched | Broken
