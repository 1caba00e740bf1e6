"""What the service works on: its data directory, its store, shared files, and the workers that the store knows."""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from backend.client.access import TOKEN_FILE
from backend.store.database import open_database
from backend.store.engines import parse_address
from backend.store.errors import StoreUnavailable
from backend.store.inspection import StoreState, inspect_store
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.store.workers import WorkerRow, list_workers
from sldr_core.errors import SldrError
from worker.doctor.finding import Finding, ok, poor, wrong
from worker.doctor.machine import nearest_existing


def look_at_home(home: Path) -> Finding:
    """Write a file where the data lies, or would."""
    try:
        with tempfile.NamedTemporaryFile(dir=nearest_existing(home)):
            pass
    except OSError as err:
        mend = "make it writable for this user, or let SLDR_HOME name another directory."
        return wrong("data", f"{home} cannot be written ({err.strerror}).", mend)
    token = home / TOKEN_FILE
    if token.exists() and stat.S_IMODE(token.stat().st_mode) & 0o077:
        return wrong("data", f"Others may read {token}, which opens the service.", f"chmod 600 {token}")
    return ok("data", f"{home} can be written.")


def look_at_store(settings: Settings) -> Finding:
    """Reach the store and compare its tables with what this version expects; nothing is changed."""
    try:
        state = inspect_store(settings)
    except (SldrError, StoreUnavailable) as err:
        mend = "see that the database runs and that SLDR_DATABASE_URL names it."
        return wrong("store", str(err), mend)
    return describe_store(state, _shown(settings))


def describe_store(state: StoreState, address: str) -> Finding:
    """Say what the tables' revision means."""
    if state.revision is None:
        return ok("store", f"{address} is empty; its tables are made when the service starts.")
    if state.revision == state.expected:
        return ok("store", f"{address} answers; its tables are of revision {state.revision}.")
    if state.revision < state.expected:
        told = f"{address} is of revision {state.revision}, brought to {state.expected} when the service starts."
        return poor(
            "store", told, "make a backup first, with the version that has used it so far: `sldr backup FILE.tar`."
        )
    told = f"{address} is of revision {state.revision}, and this version knows {state.expected}."
    return wrong("store", told, "start the newer version that has used it, or restore a backup made before.")


def look_at_files(settings: Settings) -> Finding:
    """Reach the place that several machines share files through, if there is one."""
    if settings.files_url is None:
        return ok("files", "Files lie in the data directory; several machines would need SLDR_FILES_URL.")
    try:
        shared = FileStorage(settings).shared
        assert shared is not None
        probe = f".doctor-{os.getpid()}"
        shared.put_bytes(b"", probe)
        shared.remove(probe)
    except (SldrError, StoreUnavailable) as err:
        return wrong("files", str(err), "see that SLDR_FILES_URL names a place that this machine may write.")
    return ok("files", f"The shared place {settings.files_url} can be written.")


def look_at_workers(settings: Settings) -> Finding:
    """See whether anything would be trained; a store without tables is left without."""
    if inspect_store(settings).revision is None:
        return describe_workers([])
    with closing(open_database(settings)) as db:
        return describe_workers(list_workers(db))


def describe_workers(workers: Sequence[WorkerRow]) -> Finding:
    """Say what the workers that the store knows would train."""
    alive = [worker for worker in workers if worker.alive]
    taking = [worker for worker in alive if not worker.draining]
    if not alive:
        return poor(
            "workers", "No worker is alive, so nothing is trained.", "start one: `sldr serve`, or `sldr worker`."
        )
    if not taking:
        told = f"{len(alive)} alive, and all of them are drained, so nothing new is trained."
        return poor("workers", told, "let one take runs again, on the page Workers.")
    slots = sum(worker.slots for worker in taking)
    drained = f", besides {len(alive) - len(taking)} drained" if len(taking) < len(alive) else ""
    return ok("workers", f"{len(taking)} alive, for {slots} runs at once{drained}.")


def _shown(settings: Settings) -> str:
    """Return the store's address without its password."""
    return parse_address(settings.database_url).render_as_string(hide_password=True)
