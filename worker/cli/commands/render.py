"""`sldr render`: the picture of a task."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import tyro

from sldr_core.config import find_task
from sldr_core.errors import InvalidConfig
from worker.render import PICTURE_SIZE, render_task_picture


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(render, prog="sldr render", args=list(arguments))


def render(task: str, out: Path, width: int = PICTURE_SIZE[0], height: int = PICTURE_SIZE[1]) -> int:
    """Draw the picture of a task.

    Args:
        task: The task, as `sldr list tasks` names it.
        out: The PNG file to write.
        width: Width of the picture [pixels].
        height: Height of the picture [pixels].
    """
    find_task(task)
    if width < 1 or height < 1:
        raise InvalidConfig({"size": f"a picture needs at least one pixel each way, got {width} x {height}"})
    if not out.absolute().parent.is_dir():
        raise InvalidConfig({"out": f"there is no directory {out.absolute().parent}; make it first"})
    render_task_picture(task, out, width, height)
    print(out)
    return 0
