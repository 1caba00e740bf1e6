"""The errors of the store.

SldrError
├── NotFound             there is no such run, worker, file or session
├── FileGone             a file that the store knows is not where it should be
├── WrongState           a run cannot do this in the state it is in
├── Refused              something else than its state keeps a run from doing this
├── BadAddress           the address of the store or of the files cannot work
├── WouldOverwrite       something lies where a backup should be made or restored
├── StoreTooNew          a later version of this program has used the store
└── Unstorable           a value that no column can hold, such as text with a zero byte
Exception
├── StaleFence           an attempt that was replaced tried to write
└── StoreUnavailable     the database cannot be reached, is locked or full; the same call may work later
    └── FilesUnavailable the same of the place that machines share files through
"""

from __future__ import annotations

from collections.abc import Iterable

from sldr_core.errors import SldrError


class NotFound(SldrError):
    """Report an id or name that the store does not hold."""

    def __init__(self, kind: str, name: str) -> None:
        super().__init__(f"There is no {kind} '{name}'.")
        self.kind = kind
        self.name = name


class FileGone(SldrError):
    """Report a stored file whose bytes are not where its row says."""


class WrongState(SldrError):
    """Report a change that the run's present state does not allow."""

    def __init__(self, run_id: str, state: str, event: str, allowed: Iterable[str]) -> None:
        states = ", ".join(sorted(allowed))
        super().__init__(f"Run {run_id} is {state}; '{event}' is possible only for runs that are: {states}.")
        self.run_id = run_id
        self.state = state
        self.event = event


class BadAddress(SldrError):
    """Report an address of the store or of the files that can never work as it is written."""


class WouldOverwrite(SldrError):
    """Report what a backup would replace, where it is made or where it is restored."""


class StoreTooNew(SldrError):
    """Report tables that a later version of this program has made."""


class Unstorable(SldrError):
    """Report a value that the database can neither hold nor compare with what it holds."""


class Refused(SldrError):
    """Report what keeps a run from doing what was asked; the message says it."""


class StaleFence(Exception):
    """Report a write of an attempt that is over: its run was given to another worker, or has ended."""

    def __init__(self, run_id: str, fence: int) -> None:
        super().__init__(f"Attempt with fence {fence} of run {run_id} is over; nothing was written.")
        self.run_id = run_id
        self.fence = fence


class StoreUnavailable(Exception):
    """Report that the database could not be read or written just now."""


class FilesUnavailable(StoreUnavailable):
    """Report that the place that machines share files through could not be read or written just now."""
