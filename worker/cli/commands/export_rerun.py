"""`sldr export rerun RUN OUT`: the Rerun file of a run, made again from the store."""

from __future__ import annotations

from pathlib import Path

from backend.store.database import open_database
from backend.store.settings import load_settings
from sldr_core.errors import InvalidConfig

SUFFIX = ".rrd"


def export_rerun(run_id: str, out: Path) -> int:
    """Write the Rerun file of a run and print where it is.

    Raises:
        NotFound: there is no such run.
        InvalidConfig: nothing can be written there.
    """
    if out.suffix != SUFFIX:
        raise InvalidConfig({"out": f"a Rerun file ends in {SUFFIX}, got {out.name}"})
    if not out.absolute().parent.is_dir():
        raise InvalidConfig({"out": f"there is no directory {out.absolute().parent}; make it first"})
    settings = load_settings()
    db = open_database(settings)
    try:
        from worker.recording.run_recording import record_run  # Rerun takes seconds to import.

        record_run(db, settings, run_id, out)
    finally:
        db.close()
    print(f"{out}\nOpen it with: rerun {out}")
    return 0
