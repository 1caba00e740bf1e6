"""What a real drawing process writes: pictures that show something, videos that play."""

from __future__ import annotations

import hashlib
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import SIZE, DrawnRun
from imageio_ffmpeg import get_ffmpeg_exe
from media_cases import STEPS
from numpy.typing import NDArray
from PIL import Image

from backend.store.files import find_file
from backend.store.media_jobs import MediaOrder, order_media
from backend.store.thumbnails import THUMBNAIL, THUMBNAIL_FILE
from sldr_core.disk import explain_full_disk
from sldr_core.errors import DiskTooFull
from worker.drawing import check_frame
from worker.media.video import CODECS, FRAMES_PER_S, write_video

FULL = Path("/dev/full")
"""What the system keeps for such tests: there is never room in it."""


def noise(count: int) -> Iterator[NDArray[np.uint8]]:
    """Return frames of 64 x 64 pixels that cannot be made small."""
    rng = np.random.default_rng(0)
    return (rng.integers(256, size=(64, 64, 3), dtype=np.uint8) for _ in range(count))


def decode(drawn: DrawnRun, name: str) -> tuple[str, NDArray[np.uint8]]:
    """Decode a video with ffmpeg; return what that says of it, and the frames `[F, height, width, 3]`."""
    path = drawn.settings.run_directory(drawn.run_id) / name
    command = [get_ffmpeg_exe(), "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, capture_output=True, check=True)
    return done.stderr.decode(), np.frombuffer(done.stdout, dtype=np.uint8).reshape(-1, SIZE[1], SIZE[0], 3)


@pytest.mark.parametrize(("name", "codec"), [("a.mp4", "h264"), ("a.webm", "vp9")])
def test_a_video_has_a_frame_for_each_moment_at_the_size_asked_for(drawn: DrawnRun, name: str, codec: str) -> None:
    assert drawn.jobs[name].state == "done", drawn.jobs[name].reason
    said, frames = decode(drawn, name)
    for what in (codec, f"{SIZE[0]}x{SIZE[1]}", f"{FRAMES_PER_S} fps"):
        assert what in said
    assert len(frames) == STEPS + 1
    for frame in frames:
        check_frame(frame)
    moved = np.abs(frames[-1].astype(int) - frames[0].astype(int)).max(axis=-1) > 40
    assert moved.sum() > 30, "the block slides, and nothing moves in the video"


def test_the_thumbnail_shows_something(drawn: DrawnRun) -> None:
    assert drawn.jobs[THUMBNAIL_FILE].state == "done", drawn.jobs[THUMBNAIL_FILE].reason
    with Image.open(drawn.settings.run_directory(drawn.run_id) / THUMBNAIL_FILE) as picture:
        assert picture.size == (THUMBNAIL["width"], THUMBNAIL["height"])
        check_frame(np.asarray(picture.convert("RGB")))


def test_files_are_registered_with_size_and_checksum(drawn: DrawnRun) -> None:
    for name in ("a.mp4", "a.webm", THUMBNAIL_FILE):
        row = find_file(drawn.db, drawn.run_id, name)
        content = (drawn.settings.home / row.path).read_bytes()
        assert (row.size, row.sha256) == (len(content), hashlib.sha256(content).hexdigest())


def test_an_episode_that_is_not_there_is_said_in_one_sentence(drawn: DrawnRun) -> None:
    job = drawn.jobs["missing.mp4"]
    assert (job.state, job.reason) == ("failed", "episodes-epoch-0003.npz has no episode 7; it has 0.")


def test_what_is_there_is_not_drawn_again(drawn: DrawnRun) -> None:
    job = drawn.jobs["a.mp4"]
    again = order_media(drawn.db, MediaOrder(job.run_id, "video", job.source, job.file_name, job.arguments))
    assert (again.id, again.state) == (job.id, "done")


@pytest.mark.parametrize("suffix", CODECS)
@pytest.mark.parametrize("count", [3, 300], ids=["found full at the end", "found full on the way"])
def test_a_video_that_does_not_fit_on_its_disk_is_no_video(suffix: str, count: int) -> None:
    with pytest.raises(DiskTooFull, match=r"There is no room for /dev/full: its disk has"), explain_full_disk(FULL):
        write_video(FULL, suffix, noise(count), 64, 64)


def test_what_ffmpeg_says_of_a_file_that_it_cannot_write_is_told(tmp_path: Path) -> None:
    with pytest.raises(OSError, match=r"ffmpeg ended with status \d+ \(.*No such file or directory"):
        write_video(tmp_path / "missing" / "a.webm", ".webm", noise(3), 64, 64)


def test_a_frame_that_cannot_be_drawn_ends_the_video(tmp_path: Path) -> None:
    def break_off() -> Iterator[NDArray[np.uint8]]:
        yield from noise(2)
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        write_video(tmp_path / "a.mp4", ".mp4", break_off(), 64, 64)
