"""Pictures of the tasks, drawn off screen in a process of their own.

    python -m worker.render FetchPush push.png

The renderer chooses its library by an environment variable when MuJoCo is imported, and hangs in a forked process:
so each picture is drawn by a fresh interpreter, and this file imports no MuJoCo.
"""

from __future__ import annotations

import argparse
import ctypes
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

from sldr_core.config import TASKS, find_task
from sldr_core.errors import SldrError
from worker.mortality import end_with_parent
from worker.priority import give_way

PICTURE_SIZE = (800, 500)
"""Width and height of a task's picture [pixels]."""

DRAWING_TIMEOUT_S = 120.0
"""A picture that is not drawn by then will not be [s]."""

UNFINISHED = ".drawing-"
"""What the names of directories begin with in which pictures are drawn."""

NICENESS = 10
"""Drawing what nobody asked for yet gives way to everything else."""

EGL_LIBRARY = "libEGL.so.1"

MISSING_EGL = (
    "MuJoCo cannot draw off screen here because EGL is missing; "
    "install it with: apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri"
)

_OWN_ERROR = 3
"""Exit status of a process that says in one sentence why it failed."""

_ERROR_MARK = "error: "
"""What that sentence's line begins with; MuJoCo and Python may write lines of their own."""


class RenderFailed(SldrError):
    """Report that a picture could not be drawn."""


class NoRenderer(RenderFailed):
    """Report that this machine can draw nothing off screen."""


@contextmanager
def off_screen() -> Generator[None]:
    """Let this process draw through EGL; MuJoCo has to be imported, and its renderer to be made, within.

    Raises:
        NoRenderer: this machine has no EGL that works.
    """
    try:
        ctypes.CDLL(EGL_LIBRARY)
        # MuJoCo reads it when imported, so it is set before and in this process alone.
        os.environ["MUJOCO_GL"] = "egl"
        yield
    except (OSError, ImportError, RuntimeError) as err:
        raise NoRenderer(f"{MISSING_EGL} ({err}).") from err


def render_task_picture(task: str, path: Path, width: int = PICTURE_SIZE[0], height: int = PICTURE_SIZE[1]) -> None:
    """Draw a task with its goal to a PNG file, which appears whole or not at all.

    Raises:
        UnknownName: no such task.
        RenderFailed: it could not be drawn, for the reason given.
    """
    find_task(task)
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=UNFINISHED) as folder:
        drawn = Path(folder) / "picture.png"
        size = [f"--width={width}", f"--height={height}"]
        _run([sys.executable, "-m", "worker.render", task, str(drawn), *size], task)
        drawn.replace(path)


def render_all_pictures(home: Path) -> list[Path]:
    """Draw the tasks that have no picture below `home/pictures`, and return the new files.

    Raises:
        RenderFailed: one could not be drawn, for the reason given.
    """
    _sweep(home / "pictures")
    missing = {task: home / "pictures" / f"{task}.png" for task in TASKS}
    missing = {task: path for task, path in missing.items() if not path.exists()}
    for task, path in missing.items():
        render_task_picture(task, path)
    return list(missing.values())


def _sweep(directory: Path) -> None:
    """Remove what drawings that were killed have left; one that is so old cannot be at work any more."""
    for left in directory.glob(f"{UNFINISHED}*"):
        # One that was at work when the directory was listed may have ended since.
        with suppress(FileNotFoundError):
            if time.time() - left.stat().st_mtime > 2 * DRAWING_TIMEOUT_S:
                shutil.rmtree(left, ignore_errors=True)


def main() -> int:
    """Draw one picture in this process, or with `--all-below` every missing one, each in its own."""
    parser = argparse.ArgumentParser(prog="python -m worker.render", description="Draw a picture of a task off screen.")
    parser.add_argument("task", nargs="?", help=f"one of {', '.join(TASKS)}")
    parser.add_argument("file", nargs="?", type=Path, help="the PNG file to write")
    parser.add_argument("--width", type=int, default=PICTURE_SIZE[0])
    parser.add_argument("--height", type=int, default=PICTURE_SIZE[1])
    parser.add_argument("--all-below", type=Path, metavar="HOME", help="draw every missing picture below HOME/pictures")
    options = parser.parse_args()
    end_with_parent()
    try:
        if options.all_below is not None:
            give_way(NICENESS)
            render_all_pictures(options.all_below)
        elif options.task is None or options.file is None:
            parser.error("name a task and a file, or give --all-below HOME.")
        else:
            _draw_here(options.task, options.file, options.width, options.height)
    except SldrError as err:
        print(f"{_ERROR_MARK}{err}", file=sys.stderr)
        return _OWN_ERROR
    return 0


def _draw_here(task: str, path: Path, width: int, height: int) -> None:
    find_task(task)
    with off_screen():
        from worker.drawing import draw_task

        picture = draw_task(task, width, height)
    picture.save(path, format="PNG")


def _run(command: list[str], task: str) -> None:
    environment = {**os.environ, "MUJOCO_GL": "egl"}
    try:
        done = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=DRAWING_TIMEOUT_S, check=False
        )
    except subprocess.TimeoutExpired as err:
        raise RenderFailed(f"The picture of {task} was not drawn within {DRAWING_TIMEOUT_S:.0f} s.") from err
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        sentences = [line.removeprefix(_ERROR_MARK) for line in lines if line.startswith(_ERROR_MARK)]
        raise RenderFailed(sentences[0] if sentences else f"The renderer broke down: {lines[-1]}")


if __name__ == "__main__":
    sys.exit(main())
