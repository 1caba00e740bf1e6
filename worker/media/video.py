"""Frames to a video file that every browser plays, through the ffmpeg that imageio-ffmpeg brings."""

from __future__ import annotations

import errno
import os
import subprocess
from collections.abc import Iterable
from contextlib import closing, suppress
from pathlib import Path
from tempfile import TemporaryFile

import numpy as np
from imageio_ffmpeg import get_ffmpeg_exe
from numpy.typing import NDArray

from sldr_core.disk import NO_ROOM

FRAMES_PER_S = 25
"""A control step takes 0.04 s, so a video with a frame for each runs as fast as the world does."""

CODECS: dict[str, tuple[str, list[str]]] = {
    ".mp4": ("libx264", ["-preset", "veryfast", "-crf", "21", "-movflags", "+faststart", "-f", "mp4"]),
    ".webm": ("libvpx-vp9", ["-deadline", "realtime", "-cpu-used", "6", "-crf", "30", "-b:v", "0", "-f", "webm"]),
}
"""Codec and its settings, by the file's ending. The form is named because the file has a temporary name."""

THREADS = ["-threads", "1"]
"""Videos give way to trainings."""


def write_video(path: Path, suffix: str, frames: Iterable[NDArray[np.uint8]], width: int, height: int) -> None:
    """Write frames `[height, width, 3]` to a video.

    Args:
        path: the file.
        suffix: `.mp4` or `.webm`.
        frames: one for each control step.
        width: a multiple of 8 [pixels].
        height: a multiple of 8 [pixels].

    Raises:
        OSError: ffmpeg could not write the file; its number is one of `NO_ROOM` where the disk is full.
    """
    codec, settings = CODECS[suffix]
    given = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(FRAMES_PER_S), "-i", "-"]
    wanted = ["-c:v", codec, "-pix_fmt", "yuv420p", *settings, *THREADS]
    command = [get_ffmpeg_exe(), "-y", "-v", "error", *given, *wanted, str(path)]
    # What it says goes to a file: a pipe that nobody empties meanwhile would hold it up.
    with TemporaryFile() as said, subprocess.Popen(command, stdin=subprocess.PIPE, stderr=said) as ffmpeg:
        try:
            _send(ffmpeg, frames)
        except BaseException:
            ffmpeg.kill()
            raise
        status = ffmpeg.wait()
        said.seek(0)
        _check(path, status, said.read().decode(errors="replace").strip())


def _send(ffmpeg: subprocess.Popen[bytes], frames: Iterable[NDArray[np.uint8]]) -> None:
    assert ffmpeg.stdin is not None
    # It hangs up when it has failed; its exit status says so.
    with suppress(BrokenPipeError), closing(ffmpeg.stdin) as pipe:
        for frame in frames:
            pipe.write(frame.tobytes())


def _check(path: Path, status: int, said: str) -> None:
    if status != 0:
        number = next((number for number in NO_ROOM if os.strerror(number) in said), errno.EIO)
        raise OSError(number, f"ffmpeg ended with status {status} ({said or 'it said nothing'})", str(path))
