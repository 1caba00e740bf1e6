"""Small forms of the tasks' pictures, for lists: a page of runs shows dozens of them."""

from __future__ import annotations

import logging
import os
import threading
from pathlib import Path

WIDTH = 168
"""Three times what a table shows, for screens with dense pixels [px]."""
QUALITY = 80

log = logging.getLogger("sldr.api.pictures")


def small_form(picture: Path) -> Path:
    """Return a small WebP of a picture, made when it is first asked for; the picture itself if that cannot be."""
    small = picture.with_suffix(".small.webp")
    try:
        if small.is_file() and small.stat().st_mtime >= picture.stat().st_mtime:
            return small
        # Only needed once for each task: a server that is up to date never loads it.
        from PIL import Image

        with Image.open(picture) as whole:
            whole.thumbnail((WIDTH, WIDTH))
            drawn = small.with_name(f".{small.name}-{os.getpid()}-{threading.get_ident()}")
            whole.save(drawn, "WEBP", quality=QUALITY)
        drawn.replace(small)
    except OSError as error:
        log.warning("No small form of %s can be made: %s", picture.name, error)
        return picture
    return small
