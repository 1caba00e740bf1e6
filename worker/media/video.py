"""Frames to a video file that every browser plays, through the ffmpeg that imageio-ffmpeg brings."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from imageio_ffmpeg import write_frames
from numpy.typing import NDArray

FRAMES_PER_S = 25
"""A control step takes 0.04 s, so a video with a frame for each runs as fast as the world does."""

BLOCK = 8
"""Width and height are multiples of it [pixels]: ffmpeg would stretch what is not."""

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
        OSError: ffmpeg could not write the file.
    """
    codec, settings = CODECS[suffix]
    open_writer: Any = write_frames  # its own types forbid `quality=None`, which leaves the quality to `-crf`
    writer = open_writer(
        path,
        (width, height),
        fps=FRAMES_PER_S,
        codec=codec,
        quality=None,
        macro_block_size=BLOCK,
        ffmpeg_log_level="error",
        output_params=[*settings, *THREADS],
    )
    writer.send(None)
    try:
        for frame in frames:
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()
