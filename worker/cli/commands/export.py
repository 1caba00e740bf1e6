"""`sldr export`: what the store has of runs, in the forms of other tools."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import tyro

from sldr_core.errors import InvalidConfig
from worker.cli.commands.export_rerun import export_rerun


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(export, prog="sldr export", args=list(arguments))


def export(rerun: Annotated[tuple[str, Path] | None, tyro.conf.arg(metavar="RUN OUT")] = None) -> int:
    """Write what the store has of runs to a file.

    Args:
        rerun: The id of a run, and the .rrd file to write: its curves, episodes and log, for Rerun.
    """
    if rerun is None:
        raise InvalidConfig({"export": "say what to export: --rerun RUN OUT"})
    return export_rerun(*rerun)
