"""`python -m worker.child`: one attempt of one run, in a process of its own.

The claim comes as the first line on standard input; what the supervisor wants of it comes as further lines.
What is printed goes to the run's log.
"""

from __future__ import annotations

import faulthandler
import fcntl
import logging
import os
import socket
import sys
import threading
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import IO, Protocol

from backend.store.attempts import note_host
from backend.store.claims import Claim, claim_from_json
from backend.store.database import Database, open_database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.outcomes import Cancelled, Failed, HandedBack, Outcome, Paused, Succeeded
from backend.store.queue import finish
from backend.store.settings import Settings, load_settings
from sldr_core.config import TrainConfig
from sldr_core.disk import remove_leftovers
from sldr_core.errors import SldrError
from worker.claimed_files import bring_claimed_run, send_log
from worker.locomotion_files import find_locomotion_models
from worker.mortality import end_with_parent
from worker.patience import FILES_PATIENCE_S, insist
from worker.recorder import StoreRecorder
from worker.sign_of_life import showing_life
from worker.words import STOP_WORDS, StopWord

LOCK_FILE = ".lock"
LOCK_PATIENCE_S = 10.0
"""How long an earlier attempt's process may take to let go of the run's directory [s]."""
LOCK_RETRY_S = 10.0
"""How long a run waits in the queue when it did not [s]."""
STORE_RETRY_S = 60.0
"""How long a run waits in the queue when the place of its files could not be used for long [s]."""
EXIT_ORPHANED = 70
EXIT_STALE = 71

log = logging.getLogger(__name__)


class TrainResult(Protocol):
    """What a training tells at its end."""

    @property
    def stopped(self) -> StopWord | None:
        """The request that ended it, or None if it came to its end."""
        ...

    @property
    def test_success_rate(self) -> float | None:
        """Success of the last test."""
        ...

    @property
    def best_success_rate(self) -> float | None:
        """Success of the best test, whose locomotion model is kept."""
        ...


class Train(Protocol):
    """A training: `sldr_core.training.train`, or a short one in tests."""

    def __call__(
        self, config: TrainConfig, recorder: StoreRecorder, locomotion_models: Sequence[Path], gate_waived: bool
    ) -> TrainResult:
        """Train until the end or until the recorder asks to stop."""
        ...


RecordRun = Callable[[Database, Settings, str, Path], None]
"""Write all that the store has of a run to a Rerun file."""


class DirectoryBusy(Exception):
    """Report that a process of an earlier attempt still writes the run's directory."""


def main() -> int:
    """Train for real."""
    return run_child(_train, _record_run)


def run_child(train: Train, record_run: RecordRun | None = None) -> int:
    """Read a claim, train, and report how it ended; return the exit status."""
    end_with_parent()
    faulthandler.enable()
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s", stream=sys.stdout)
    claim = claim_from_json(sys.stdin.readline())
    requests = StopRequests(sys.stdin)
    settings = load_settings()
    db = insist(lambda: open_database(settings))
    try:
        outcome = _attempt(db, settings, claim, requests, train, record_run)
        send_log(db, settings, claim)
        insist(lambda: finish(db, claim, outcome))
    except StaleFence as err:
        log.error("%s", err)
        return EXIT_STALE
    log.info("Attempt %d has ended: %s", claim.attempt, outcome)
    return 0


class StopRequests:
    """Listen to the supervisor, and end this process when the supervisor is gone."""

    def __init__(self, lines: IO[str]) -> None:
        self._lines = lines
        self._newest: StopWord | None = None
        threading.Thread(target=self._listen, name="requests", daemon=True).start()

    def newest(self) -> StopWord | None:
        """Return what was asked for last."""
        return self._newest

    def _listen(self) -> None:
        for line in self._lines:
            word = line.strip()
            if word in STOP_WORDS:
                self._newest = word
            else:
                log.warning("The supervisor said '%s', which means nothing here.", word)
        os._exit(EXIT_ORPHANED)


def _attempt(
    db: Database,
    settings: Settings,
    claim: Claim,
    requests: StopRequests,
    train: Train,
    record_run: RecordRun | None,
) -> Outcome:
    """Train, and turn whatever happens into an outcome; only a stale fence leaves as an error."""
    try:
        with _hold_directory(settings.run_directory(claim.run_id)):
            # Only now is it sure that nobody else writes there; an attempt that is over must not begin.
            insist(lambda: note_host(db, claim, socket.gethostname()))
            with showing_life(db, claim):
                bring_claimed_run(db, settings, claim)
                models = insist(lambda: find_locomotion_models(db, settings, claim), patience_s=FILES_PATIENCE_S)
            log.info("Attempt %d of run %s begins in process %d.", claim.attempt, claim.run_id, os.getpid())
            write = None if record_run is None else partial(record_run, db, settings, claim.run_id)
            with StoreRecorder(db, settings, claim, requests.newest, write) as recorder:
                result = train(claim.config, recorder, models, claim.gate_waived)
    except DirectoryBusy as err:
        return HandedBack(str(err), LOCK_RETRY_S)
    except StaleFence:
        raise
    except StoreUnavailable as err:
        log.error("%s", err)
        return HandedBack(f"{err} It goes on from its checkpoint.", STORE_RETRY_S)
    except SldrError as err:
        log.error("%s", err)
        return Failed(str(err), retry=False)
    except Exception as err:
        log.exception("The training ended by an error that nobody expected.")
        return Failed(_sentence(err), retry=True)
    return _outcome_of(result, claim)


def _outcome_of(result: TrainResult, claim: Claim) -> Outcome:
    match result.stopped:
        case "cancel":
            return Cancelled()
        case "pause":
            return Paused()
        case "shutdown":
            return HandedBack("Its worker was asked to end; it goes on from its checkpoint.")
        case None if claim.config.phase == "locomotion":
            return Succeeded(result.best_success_rate)
        case None:
            return Succeeded(result.test_success_rate)


def _sentence(err: Exception) -> str:
    """Put an unexpected error into one sentence."""
    lines = str(err).strip().splitlines()
    what = f": {lines[0].rstrip('.')}" if lines else ""
    return f"The training ended by an unexpected {type(err).__name__}{what}; the log says where."


@contextmanager
def _hold_directory(directory: Path) -> Generator[None]:
    """Keep every other process from training in this directory; the lock ends with this process."""
    directory.mkdir(parents=True, exist_ok=True)
    give_up_at = time.monotonic() + LOCK_PATIENCE_S
    with (directory / LOCK_FILE).open("w") as file:
        while True:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > give_up_at:
                    raise DirectoryBusy("A process of an earlier attempt still writes its directory.") from None
                time.sleep(0.1)
        remove_leftovers(directory)
        yield


def _train(
    config: TrainConfig, recorder: StoreRecorder, locomotion_models: Sequence[Path], gate_waived: bool
) -> TrainResult:
    from sldr_core.training import train  # Brings PyTorch and MuJoCo, which tests of this process do without.

    return train(config, recorder, locomotion_models, gate_waived)


def _record_run(db: Database, settings: Settings, run_id: str, path: Path) -> None:
    from worker.recording.run_recording import record_run  # Takes seconds to import.

    record_run(db, settings, run_id, path)


if __name__ == "__main__":
    exit_status = main()
    logging.shutdown()
    sys.stdout.flush()
    # Taking PyTorch down in good order takes seconds in which the slot would stand idle.
    os._exit(exit_status)
