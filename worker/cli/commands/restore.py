"""`sldr restore`: bring back what `sldr backup` has copied."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import tyro

from backend.store.backups.restore import restore_backup
from backend.store.settings import load_settings
from worker.cli.status_line import StatusLine


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(restore, prog="sldr restore", args=list(arguments))


def restore(source: Annotated[Path, tyro.conf.Positional], overwrite: bool = False) -> int:
    """Put a backup into the store and the data directory that the environment names; both should be empty.

    Args:
        source: What `sldr backup` has made.
        overwrite: Replace everything that is there.
    """
    with StatusLine() as status:
        report = restore_backup(load_settings(), source, overwrite, status.show)
    print(f"Restored {report.runs} runs and {report.files} files of {report.made_at}.")
    if report.queued_again:
        print(f"{report.queued_again} of them were being trained then; they are queued and go on from a checkpoint.")
    return 0
