"""The drawing process: takes orders one after the other, until its host ends it."""

from __future__ import annotations

import logging
import os
import signal
import sys
from multiprocessing.connection import Connection

from sldr_core.errors import SldrError
from worker.media.orders import Answer, DrawOrder, NotDrawn
from worker.mortality import end_with_parent
from worker.priority import give_way
from worker.render import NoRenderer, off_screen

NICENESS = 10
"""Drawing gives way to training and to 3D sessions."""

SOFTWARE_RENDERER_THREADS = {"LP_NUM_THREADS": "1"}
"""Mesa's renderer would otherwise take every core where there is no graphics card."""

log = logging.getLogger("sldr.media")


def serve_orders(host: Connection, host_pid: int) -> None:
    """Answer orders with files; the entry point of the process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    give_way(NICENESS)
    end_with_parent()
    if os.getppid() != host_pid:
        raise SystemExit(1)
    os.environ.update(SOFTWARE_RENDERER_THREADS)
    logging.basicConfig(stream=sys.stderr, level=logging.WARNING, format="%(asctime)s %(name)s %(message)s")
    try:
        while True:
            host.send(answer(host.recv()))
    except (EOFError, BrokenPipeError):
        raise SystemExit(0) from None


def answer(order: DrawOrder) -> Answer:
    """Draw one order, or say in one sentence why that cannot be."""
    try:
        # torch and MuJoCo take seconds to import: here, and only where there is something to draw.
        with off_screen():
            from worker.media.artist import draw_order

            probe_renderer()
        return draw_order(order)
    except NoRenderer as err:
        return NotDrawn(str(err), is_machine=True)
    except SldrError as err:
        return NotDrawn(str(err))
    except Exception as err:
        log.exception("%s could not be drawn", order.target.name)
        return NotDrawn(f"Drawing broke down ({type(err).__name__}: {err}).")


def probe_renderer() -> None:
    """Make a small renderer: a machine without a working EGL is found here, and not in the middle of a video."""
    import mujoco

    model = mujoco.MjModel.from_xml_string("<mujoco/>")
    mujoco.Renderer(model, height=8, width=8).close()  # type: ignore[attr-defined]
