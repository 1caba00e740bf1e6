"""Bringing what a claimed run needs to this machine: its newest checkpoint, if it was trained elsewhere before.

A run's directory says which attempt has last written it, by its fence. If the checkpoint in the store's list is of a
later attempt, the directory was left behind, as it is if the store does not know the fence: a backup was restored
since. Else it is at least as new as what the list has.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from backend.store.attempts import AttemptRow, list_attempts
from backend.store.blocks import get_blocks, read_block_list
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import FileGone
from backend.store.files import LOG_FILE, REPLAY_FILE, REPLAY_LIST, FileRow, list_files
from backend.store.outcomes import CHECKPOINT_KIND
from backend.store.settings import Settings
from backend.store.storage import FileStorage, SharedPlace
from sldr_core.disk import write_atomically
from sldr_core.errors import BadFile
from worker.file_keeper import FileKeeper
from worker.patience import FILES_PATIENCE_S, insist

CHECKPOINT_FILES = ("checkpoint.pt", "checkpoint-previous.pt")
"""Either of them lets a run go on."""
ATTEMPT_FILE = ".attempt"
"""Holds the fence of the attempt that has last written a run's directory."""

log = logging.getLogger(__name__)


def bring_claimed_run(db: Database, settings: Settings, claim: Claim) -> None:
    """Make sure that the run's directory is no older than any other machine's, and sign it for this attempt.

    Call it while the directory is held, as it is the run's own process that writes there.

    Raises:
        BadFile: what another machine has put at the shared place is damaged.
        DiskTooFull: it does not fit on this machine's disk.
        FileGone: it is no longer there.
        StoreUnavailable: store or shared place could not be used for minutes.
    """
    directory = settings.run_directory(claim.run_id)
    storage = FileStorage(settings)
    shared = storage.shared
    if shared is not None:
        rows = insist(lambda: list_files(db, claim.run_id))
        checkpoint = next((row for row in rows if row.kind == CHECKPOINT_KIND), None)
        last = _last_attempt(directory, insist(lambda: list_attempts(db, claim.run_id)))
        if last < (1 if checkpoint is None else checkpoint.attempt):
            _leave_old(directory)
        if checkpoint is not None and last < checkpoint.attempt:
            insist(lambda: _bring_replay(shared, storage, rows, directory), patience_s=FILES_PATIENCE_S)
            _bring_log(storage, rows, directory)
            found = insist(lambda: storage.bring(checkpoint), patience_s=FILES_PATIENCE_S)
            found.rename(directory / checkpoint.name)
            log.info("The checkpoint of attempt %d, made on another machine, was fetched.", checkpoint.attempt)
        FileKeeper(db, storage, claim).sweep()
    _sign(directory, claim.fence)


def send_log(db: Database, settings: Settings, claim: Claim) -> None:
    """Let other machines read what the attempt has said.

    Raises:
        StaleFence: the run was given to another worker.
    """
    FileKeeper(db, FileStorage(settings), claim).keep_log(settings.run_directory(claim.run_id) / LOG_FILE)


def _last_attempt(directory: Path, attempts: Sequence[AttemptRow]) -> int:
    """Return which of the run's attempts has last written a directory; 0 if nothing can be resumed there."""
    signed = directory / ATTEMPT_FILE
    if not signed.exists() or not any((directory / name).is_file() for name in CHECKPOINT_FILES):
        return 0
    # As text: a directory whose signature is damaged was signed by none of them.
    fence = signed.read_text(errors="replace")
    return next((attempt.attempt for attempt in attempts if str(attempt.fence) == fence), 0)


def _sign(directory: Path, fence: int) -> None:
    def write(path: Path) -> None:
        path.write_text(str(fence))

    write_atomically(directory / ATTEMPT_FILE, write)


def _leave_old(directory: Path) -> None:
    """Remove what does not go with the checkpoint to come; until that is there, nothing can be resumed here."""
    (directory / ATTEMPT_FILE).unlink(missing_ok=True)
    for old in (*directory.glob("checkpoint*.pt"), directory / REPLAY_FILE):
        old.unlink(missing_ok=True)


def _bring_replay(shared: SharedPlace, storage: FileStorage, rows: list[FileRow], directory: Path) -> None:
    found = next((row for row in rows if row.name == REPLAY_LIST), None)
    if found is not None:
        get_blocks(shared, read_block_list(storage.bring(found)), directory / REPLAY_FILE)


def _bring_log(storage: FileStorage, rows: list[FileRow], directory: Path) -> None:
    """Go on in the log of the attempts elsewhere; a training needs it not, so without it the log begins here."""
    found = next((row for row in rows if row.name == LOG_FILE), None)
    if found is None:
        return
    try:
        earlier = insist(lambda: storage.bring(found), patience_s=FILES_PATIENCE_S).read_bytes()
    except (FileGone, BadFile) as err:
        log.warning("What earlier attempts have said on other machines is lost; their points are not. %s", err)
        return
    # In place, because this process writes to the end of that very file.
    with (directory / LOG_FILE).open("r+b" if (directory / LOG_FILE).exists() else "wb") as file:
        file.write(earlier)
        file.truncate()
