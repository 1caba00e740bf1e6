"""A session's process: where it begins, and how it ends with its host."""

from __future__ import annotations

import logging
import multiprocessing
import signal
import sys
from functools import partial
from multiprocessing.connection import Connection

from sldr_core.errors import SldrError
from worker.mortality import end_with_parent
from worker.priority import give_way
from worker.viewer.reports import Broken, Job

OPENING_NICENESS = 5
"""Until its page is loaded a person waits for a view."""

NICENESS = 15
"""Watching gives way to training: a view gets about a thirtieth of a core that a training keeps busy."""

log = logging.getLogger("sldr.viewer")


def serve_session(job: Job, host: Connection) -> None:
    """Serve one session until the host ends this process; the entry point of the process."""
    _end_with_host()
    logging.basicConfig(stream=sys.stderr, level=logging.WARNING, format="%(asctime)s %(name)s %(message)s")
    try:
        # PyTorch takes seconds to import where it was not beforehand: only once the process is mortal.
        import torch

        from worker.viewer.session import serve

        torch.set_num_threads(1)
        serve(job, host, watched=partial(give_way, NICENESS))
    except BrokenPipeError:
        raise SystemExit(1) from None
    except SldrError as err:
        host.send(Broken(str(err)))
    except Exception as err:
        log.exception("session %s broke down", job.session_id)
        host.send(Broken(f"The 3D view broke down ({type(err).__name__}: {err})."))


def _end_with_host() -> None:
    """Make this process gentle, deaf to Ctrl-C (the host ends it in order), and mortal with its host.

    Its parent is the process it was forked from, which ends with the host.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    give_way(OPENING_NICENESS)
    end_with_parent()
    host = multiprocessing.parent_process()
    if host is None or not host.is_alive():
        raise SystemExit(1)
