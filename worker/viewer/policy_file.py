"""Follow a policy file that a training writes again and again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from sldr_core.errors import SldrError
from sldr_core.training import Policy, load_policy

_Stamp = tuple[int, int, int]


class PolicyFile:
    """Hold the newest policy that could be read from a file.

    Attributes:
        policy: the policy in use.
        problem: why the file's newest content is not in use, if it is not.
    """

    def __init__(self, path: Path, load: Callable[[Path], Policy] = load_policy) -> None:
        self.path = path
        self.problem: str | None = None
        self._load = load
        self._stamp = self._read_stamp()
        self.policy = load(path)

    def refresh(self) -> bool:
        """Load the file again if it has changed, and tell whether there is a new policy."""
        stamp = self._read_stamp()
        if stamp is None or stamp == self._stamp:
            return False
        self._stamp = stamp
        try:
            self.policy, self.problem = self._load(self.path), None
        except SldrError as err:
            # The policy at hand is still worth watching; the panel says what is wrong with the new one.
            self.problem = str(err)
            return False
        return True

    def _read_stamp(self) -> _Stamp | None:
        try:
            status = self.path.stat()
        except FileNotFoundError:
            return None
        return status.st_mtime_ns, status.st_ino, status.st_size
