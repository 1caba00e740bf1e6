"""`sldr backup`: a copy of store and files, made while everything runs."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import tyro

from backend.store.backups.make import BackupReport, make_backup
from backend.store.settings import load_settings
from worker.cli.status_line import StatusLine

INCOMPLETE = 1
"""Exit code when the backup was made, but something is missing in it."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(backup, prog="sldr backup", args=list(arguments))


def backup(target: Annotated[Path, tyro.conf.Positional], overwrite: bool = False) -> int:
    """Copy all runs, their metrics and their files to one place; nothing needs to stop for it.

    Args:
        target: A file ending in .tar, .tar.gz or .tgz, or a directory.
        overwrite: Replace an earlier backup of that name once the new one is whole.
    """
    with StatusLine() as status:
        report = make_backup(load_settings(), target, overwrite, status.show)
    print(_describe(report))
    for sentence in report.left_out:
        print(f"sldr: Left out: {sentence}", file=sys.stderr)
    return INCOMPLETE if report.left_out else 0


def _describe(report: BackupReport) -> str:
    return f"{report.path}: {report.runs} runs, {report.files} files, {report.size / 1e6:,.1f} MB."
