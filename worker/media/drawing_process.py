"""The drawing process as its host holds it: started when there is something to draw, ended when there is nothing."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess

from worker.media.orders import Answer, DrawOrder, NotDrawn

ENDING_S = 3.0
"""A process that was asked to end and has not by then is killed [s]."""

Target = Callable[[Connection, int], None]
"""What the process runs: it is given its pipe, and the id of the process that it must not outlive."""


class DrawingProcess:
    """Hold at most one process; a new one is started when the last has ended."""

    def __init__(self, target: Target) -> None:
        self._target = target
        self._held: tuple[SpawnProcess, Connection] | None = None

    def send(self, order: DrawOrder) -> None:
        """Hand over an order, to a process that lives; if it dies of it, `poll` says so."""
        if self._held is not None and not self._held[0].is_alive():
            self.end()
        if self._held is None:
            self._held = self._start()
        try:
            self._held[1].send(order)
        except OSError:
            self._held[0].join(ENDING_S)

    def poll(self) -> Answer | None:
        """Return the answer to the order, also if that is that the process has died; None while it draws."""
        if self._held is None:
            return NotDrawn("The drawing process was ended; order it again.")
        process, pipe = self._held
        try:
            if pipe.poll():
                return pipe.recv()
        except (EOFError, OSError):
            process.join(ENDING_S)
        if process.is_alive():
            return None
        return NotDrawn(f"The drawing process ended with exit code {process.exitcode}; order it again.")

    def end(self) -> None:
        """End the process, if there is one."""
        if self._held is None:
            return
        (process, pipe), self._held = self._held, None
        process.terminate()
        process.join(ENDING_S)
        if process.is_alive():
            process.kill()
            process.join()
        process.close()
        pipe.close()

    def _start(self) -> tuple[SpawnProcess, Connection]:
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        process = context.Process(target=self._target, args=(theirs, os.getpid()), name="media-drawing")
        process.start()
        theirs.close()
        return process, ours
