"""The files that each kind of 3D session is made of, found and brought to this machine.

The host looks them up, so that a session's process needs no store.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from backend.store.database import Database
from backend.store.errors import FileGone, NotFound
from backend.store.files import FileRow, find_file, list_files
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.store.viewer_sessions import Session
from sldr_core.episodes import episodes_file
from sldr_core.errors import SldrError, UnknownName

NEWEST = "newest"
"""The policy that is followed while it is trained."""

POLICY_FILES = ("policy-newest.pt", "policy-best.pt")
"""What of a run is shown as its newest policy, the first that there is."""

KEPT_POLICY_PREFIX = "policy-epoch-"
"""What the names of policies begin with that are kept while a run goes on."""

LOCOMOTION_FILE = "locomotion.pt"
"""A locomotion run's model."""

Files = Mapping[str, tuple[Path, ...]]
"""Files on this machine by what they are for: `policy`, `beside`, `locomotion`, ..."""


class NothingToShow(SldrError):
    """Report that a run has not got what a session is to show."""


@dataclass(frozen=True)
class RunFiles:
    """Find files of runs, and bring those that other machines have written."""

    database: Database
    settings: Settings
    storage: FileStorage

    def policy(self, run_id: str, name: str = NEWEST) -> Path:
        """Return a policy, a checkpoint or a model of a run by its file's name, or the newest policy to follow.

        Raises:
            NothingToShow: there is none.
            BadFile: its content is not what was registered.
            StoreUnavailable: store or shared place cannot be used just now.
        """
        path = self._newest(run_id) if name == NEWEST else self.file(run_id, name)
        if path is None:
            raise NothingToShow(f"Run {run_id} has no policy to watch yet; wait for its first test.")
        return path

    def file(self, run_id: str, name: str) -> Path:
        """Return a file of a run by its name.

        Raises:
            NothingToShow: there is none.
            BadFile: its content is not what was registered.
            StoreUnavailable: store or shared place cannot be used just now.
        """
        try:
            return self.storage.bring(find_file(self.database, run_id, name))
        except (NotFound, FileGone) as err:
            raise NothingToShow(f"Run {run_id} has no file {name}; choose one that its page lists.") from err

    def locomotion_models(self, run_id: str) -> tuple[Path, ...]:
        """Return the models of the locomotion runs that a run needs and that have left one."""
        needed = get_run(self.database, run_id).needs
        rows = [(need, {row.name for row in list_files(self.database, need)}) for need in needed]
        return tuple(self.file(need, LOCOMOTION_FILE) for need, names in rows if LOCOMOTION_FILE in names)

    def kept_policies(self, run_id: str) -> tuple[Path, ...]:
        """Return the policies that were kept while a run was trained, the oldest first."""
        names = sorted(row.name for row in list_files(self.database, run_id))
        return tuple(self.file(run_id, name) for name in names if name.startswith(KEPT_POLICY_PREFIX))

    def _newest(self, run_id: str) -> Path | None:
        directory = self.settings.run_directory(run_id)
        if self.storage.shared is None:
            return next((directory / name for name in POLICY_FILES if (directory / name).is_file()), None)
        row = self._newest_row(run_id)
        try:
            # Not the run's own directory here: from the moment that another machine trains it, that is left behind.
            return None if row is None else self.storage.fetch(row)
        except FileGone:
            return None  # replaced by a newer one in this very moment

    def _newest_row(self, run_id: str) -> FileRow | None:
        rows = {row.name: row for row in list_files(self.database, run_id)}
        return next((rows[name] for name in POLICY_FILES if name in rows), None)


def _live(files: RunFiles, session: Session) -> Files:
    beside = session.request.get("beside")
    return {
        "policy": (files.policy(session.run_id, session.request.get("policy", NEWEST)),),
        "beside": () if beside is None else (files.policy(beside["run_id"], beside.get("policy", NEWEST)),),
        "locomotion": files.locomotion_models(session.run_id),
    }


def _inspector(files: RunFiles, session: Session) -> Files:
    return {"locomotion": (files.file(session.run_id, LOCOMOTION_FILE),)}


def _episode(files: RunFiles, session: Session) -> Files:
    return {
        "episodes": (files.file(session.run_id, episodes_file(session.request["epoch"])),),
        "locomotion": files.locomotion_models(session.run_id),
    }


def _time_machine(files: RunFiles, session: Session) -> Files:
    return {
        "policies": (*files.kept_policies(session.run_id), files.policy(session.run_id)),
        "locomotion": files.locomotion_models(session.run_id),
    }


FINDERS: dict[str, Callable[[RunFiles, Session], Files]] = {
    "live": _live,
    "episode": _episode,
    "time-machine": _time_machine,
    "inspector": _inspector,
}
"""What is brought for each kind of request."""


def find_session_files(files: RunFiles, session: Session) -> Files:
    """Return what a session is made of; asking again renews the copies of policies that are followed.

    Raises:
        UnknownName: there is no such kind of session.
        NothingToShow: the run has not got it.
        BadFile: a file is not what was registered.
        StoreUnavailable: store or shared place cannot be used just now.
    """
    kind = str(session.request.get("kind"))
    if kind not in FINDERS:
        raise UnknownName("kind of 3D view", kind, FINDERS)
    return FINDERS[kind](files, session)
