"""Drawing in a process of its own.

Matplotlib takes some 70 MB, keeps its settings in globals and holds the interpreter while it draws. So the service,
which must stay small and answer others meanwhile, lets a process that ends afterwards draw.
"""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Sequence
from typing import Literal

from pydantic import TypeAdapter
from pydantic.dataclasses import dataclass

from backend.comparison.records import RECORD, BestModels, CurveComparison
from backend.figures.styles import Width
from sldr_core.errors import SldrError

Format = Literal["svg", "pdf", "png"]

DRAWING_S = 120.0
"""Longest time that one process may draw [s]."""

DRAWINGS_AT_ONCE = 2
"""Processes that draw at the same time; further ones wait."""


class DrawingFailed(SldrError):
    """Report that no figure could be drawn; the message says what to do."""


@dataclass(frozen=True, config=RECORD)
class Drawing:
    """Ask for one figure."""

    content: CurveComparison | BestModels
    """What is drawn: learning curves, or bars of best models."""
    format: Format
    width: Width = "double"
    log_x: bool = False
    """Whether curves are drawn over a logarithmic axis."""
    log_y: bool = False


DRAWINGS: TypeAdapter[list[Drawing]] = TypeAdapter(list[Drawing])

_turns = threading.BoundedSemaphore(DRAWINGS_AT_ONCE)


def draw_apart(drawings: Sequence[Drawing]) -> list[bytes]:
    """Draw figures in one process of their own and return their files, in the same order.

    Raises:
        DrawingFailed: Matplotlib is missing, or takes too long.
    """
    with _turns:
        try:
            done = subprocess.run(
                [sys.executable, "-m", "backend.figures"],
                input=DRAWINGS.dump_json(list(drawings)),
                capture_output=True,
                timeout=DRAWING_S,
                check=False,
            )
        except subprocess.TimeoutExpired as err:
            raise DrawingFailed(
                f"The figure was not drawn within {DRAWING_S:g} s; choose fewer runs, or a shorter metric."
            ) from err
    if done.returncode != 0:
        lines = done.stderr.decode(errors="replace").strip().splitlines() or ["it said nothing"]
        raise DrawingFailed(f"The figure could not be drawn ({lines[-1]}); the numbers can be had as CSV.")
    return _split(done.stdout)


def join(files: Sequence[bytes]) -> bytes:
    """Return files in one piece, each after its length."""
    return b"".join(len(file).to_bytes(LENGTH_BYTES, "big") + file for file in files)


LENGTH_BYTES = 8


def _split(joined: bytes) -> list[bytes]:
    files: list[bytes] = []
    at = 0
    while at < len(joined):
        length = int.from_bytes(joined[at : at + LENGTH_BYTES], "big")
        at += LENGTH_BYTES
        files.append(joined[at : at + length])
        at += length
    return files
