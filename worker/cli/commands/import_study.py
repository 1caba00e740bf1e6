"""`sldr import`: take in a study that another installation has exported."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

import tyro

from backend.store.database import open_database
from backend.store.settings import load_settings
from backend.store.study_files.placing import import_study
from sldr_core.errors import BadFile


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(take_in, prog="sldr import", args=list(arguments))


def take_in(file: tyro.conf.Positional[Path]) -> int:
    """Take in a study file; the same file twice is the same study.

    It goes into the store of this machine; SLDR_URL is not asked.

    Args:
        file: The .zip file that `sldr export study` has written.
    """
    if not file.is_file():
        raise BadFile(f"There is no file {file}; give one that `sldr export study` has written.")
    settings = load_settings()
    with closing(open_database(settings)) as db:
        imported = import_study(db, settings, file, str(file))
    done = "was there already" if imported.already_there else f"holds {imported.runs} runs"
    print(f"Study {imported.study_id} {done}.")
    return 0
