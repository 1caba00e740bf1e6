"""Where a session's process begins: light, and importable by name, as a spawned process needs it.

(What stands in a package's `__main__` cannot be found by a spawned process.)
"""

from __future__ import annotations

from worker.viewer.reports import Job


def begin_session(job: Job, pipe: object) -> None:
    """Import torch and MuJoCo in the session's process alone: the host stays small."""
    from worker.viewer.session import serve_session

    serve_session(job, pipe)  # pyright: ignore[reportArgumentType]
