"""What the viewer host and its session processes tell each other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Job:
    """Ask a process to serve one 3D session."""

    session_id: str
    request: Mapping[str, Any]
    """What to show: its `kind`, and what that kind can choose from."""
    files: Mapping[str, tuple[Path, ...]]
    """The files it is made of, on this machine, by what they are for; see `worker.viewer.session_files`."""

    def file(self, role: str) -> Path:
        """Return the one file of a role."""
        (path,) = self.files[role]
        return path


@dataclass(frozen=True)
class Ready:
    """Tell that a page can be opened."""

    port: int
    """Where it is served on 127.0.0.1."""
    message: str
    """What it shows, in one sentence."""
    control_port: int | None = None
    """Where it takes commands, on 127.0.0.1."""


@dataclass(frozen=True)
class Watched:
    """Tell how many people look at a session, each time that changes."""

    clients: int


@dataclass(frozen=True)
class Broken:
    """Tell, as the last thing, why a session cannot go on."""

    message: str


Report = Ready | Watched | Broken
