"""The errors that a user of the library can meet, each naming the culprit and the way out.

SldrError
├── UnknownName          a task, method, preset or setting that does not exist
├── InvalidConfig        a setting with a value that cannot work
├── LocomotionMissing    a manipulation run was started without the locomotion model it needs
├── BadFile              a checkpoint, model or episode file that is corrupt, foreign or unfit
├── DiskTooFull          the run's files do not fit on the disk, or no longer
├── DirectoryInUse       another process trains in the run's directory
└── TrainingDiverged     a loss, weight or reward stopped being finite
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class SldrError(Exception):
    """Be the root of every error meant for a user: its text is one clear sentence."""


class UnknownName(SldrError):
    """Report a name that does not exist, with the nearest one and the whole list."""

    def __init__(self, kind: str, name: str, known: Iterable[str]) -> None:
        names = sorted(known)
        near = difflib.get_close_matches(name, names, n=1)
        hint = f" Did you mean '{near[0]}'?" if near else ""
        super().__init__(f"No {kind} is called '{name}'.{hint} There are: {', '.join(names)}.")
        self.kind = kind
        self.name = name
        self.known = names


class InvalidConfig(SldrError):
    """Report settings that cannot work; `problems` maps a dotted setting to what is wrong with it."""

    def __init__(self, problems: dict[str, str]) -> None:
        super().__init__("; ".join(f"{setting}: {problem}" for setting, problem in problems.items()))
        self.problems = problems


class LocomotionMissing(SldrError):
    """Report a manipulation run that has no locomotion model to take its reward from."""


class BadFile(SldrError):
    """Report a file that cannot be used: truncated, corrupt, foreign, or made for another task."""


class DiskTooFull(SldrError):
    """Report that the files of a run do not fit; what was written before is whole."""


class DirectoryInUse(SldrError):
    """Report that another process trains in a run's directory: both would write the same files."""


class TrainingDiverged(SldrError):
    """Report the first number that stopped being finite, by the name of its metric or weight."""
