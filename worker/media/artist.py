"""Drawing one order: here MuJoCo's renderer is used, so `worker.render.off_screen` has to be entered before."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from backend.store.storage import checksum
from sldr_core.disk import write_atomically
from worker.drawing import OVERSAMPLING, SceneDrawing, check_frame, draw
from worker.media.moments import Moments, find_moments
from worker.media.orders import Drawn, DrawOrder
from worker.media.video import write_video

PICTURE_QUALITY = 82
"""Of a WebP file: no block is seen at the size of a thumbnail."""


def draw_order(order: DrawOrder) -> Drawn:
    """Write the picture or video that is asked for; its file appears whole or not at all.

    Raises:
        BadFile: its source cannot be used.
        EmptyPicture: the renderer returned nothing.
        DiskTooFull: there is no room for it.
    """
    moments = find_moments(order.source, order.number)
    order.target.parent.mkdir(parents=True, exist_ok=True)
    if order.kind == "thumbnail":
        picture = _last_moment(moments, order.width, order.height)
        write_atomically(order.target, lambda path: picture.save(path, format="WEBP", quality=PICTURE_QUALITY))
    else:
        write_atomically(order.target, lambda path: _film(path, moments, order))
    return Drawn(order.target.stat().st_size, checksum(order.target))


def _last_moment(moments: Moments, width: int, height: int) -> Image.Image:
    size = (OVERSAMPLING * width, OVERSAMPLING * height)
    frame = draw(moments.model, moments.qpos[-1], moments.goal, moments.camera, *size)
    return Image.fromarray(frame).resize((width, height), Image.Resampling.LANCZOS)


def _film(path: Path, moments: Moments, order: DrawOrder) -> None:
    write_video(path, order.target.suffix, _frames(moments, order.width, order.height), order.width, order.height)


def _frames(moments: Moments, width: int, height: int) -> Iterator[NDArray[np.uint8]]:
    with closing(SceneDrawing(moments.model, moments.camera, width, height, is_video=True)) as drawing:
        for qpos in moments.qpos:
            frame = drawing.frame(qpos, moments.goal)
            check_frame(frame)
            yield frame
