"""`python forked_trainings.py`: trainings in processes of their own, each ending itself by SIGKILL where it is told.

An order is one line of JSON on standard input. The answer is two lines: the process's id when it begins, its status
when it has ended. Everything slow to import is there already, so a training begins at once.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

from small_training import know_short_push, run

from sldr_core.agent import DdpgAgent
from sldr_core.config import config_from_dict
from sldr_core.envs import Envs
from sldr_core.records import Floats
from sldr_core.replay import ReplayBuffer


class Reaper:
    """Kill this process when an event of a kind happens for the n-th time."""

    def __init__(self, kind: str, number: int) -> None:
        self._kind = kind
        self._left = number

    def visit(self, kind: str, last_words: Callable[[], object] = lambda: None) -> None:
        """Let an event happen; `last_words` is done before the end."""
        if kind != self._kind:
            return
        self._left -= 1
        if self._left == 0:
            last_words()
            os.kill(os.getpid(), signal.SIGKILL)


class WatchedArrays(dict[str, Floats]):
    """The arrays of a replay file; asking for one to write to is an event."""

    def __init__(self, arrays: dict[str, Floats], reaper: Reaper) -> None:
        super().__init__(arrays)
        self._reaper = reaper

    def __getitem__(self, name: str) -> Floats:
        self._reaper.visit("store")
        return super().__getitem__(name)


class WatchedLines:
    """A file of lines; writing one is an event, in the middle of the line."""

    def __init__(self, file: IO[str], reaper: Reaper) -> None:
        self._file = file
        self._reaper = reaper

    def __enter__(self) -> WatchedLines:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def write(self, line: str) -> None:
        def half() -> None:
            self._file.write(line[: len(line) // 2])
            self._file.flush()

        self._reaper.visit("line", half)
        self._file.write(line)


def name_of(temporary: Path) -> str:
    """Return which file a temporary one is to become: `.checkpoint.pt.<token>.<pid>.tmp` is `checkpoint.pt`."""
    return temporary.name.strip(".").rsplit(".", 3)[0]


def watch(reaper: Reaper) -> None:
    """Make events of all that a training does and writes.

    Kinds are `step`, `update`, `store`, `line`, and for each file `half:<name>`, `before:<name>` and `after:<name>`
    its renaming.
    """
    step, update, build = Envs.step, DdpgAgent.update, ReplayBuffer.__init__
    rename, write_bytes, copyfile, opened = Path.rename, Path.write_bytes, shutil.copyfile, Path.open

    def watched_step(envs: Envs, action: Any) -> Any:
        reaper.visit("step")
        return step(envs, action)

    def watched_update(agent: DdpgAgent, *arguments: Any) -> Any:
        reaper.visit("update")
        return update(agent, *arguments)

    def watched_build(buffer: ReplayBuffer, *arguments: Any, **named: Any) -> None:
        build(buffer, *arguments, **named)
        buffer.arrays = WatchedArrays(buffer.arrays, reaper)

    def watched_rename(path: Path, target: Path) -> Path:
        reaper.visit(f"before:{target.name}")
        renamed = rename(path, target)
        reaper.visit(f"after:{target.name}")
        return renamed

    def watched_write(path: Path, content: Any) -> int:
        reaper.visit(f"half:{name_of(path)}", lambda: write_bytes(path, content[: len(content) // 2]))
        return write_bytes(path, content)

    def watched_copy(source: Path, target: Path) -> Path:
        content = source.read_bytes()
        reaper.visit(f"half:{name_of(target)}", lambda: write_bytes(target, content[: len(content) // 2]))
        return copyfile(source, target)

    def watched_open(path: Path, mode: str = "r", *arguments: Any, **named: Any) -> Any:
        file = opened(path, mode, *arguments, **named)
        return WatchedLines(file, reaper) if mode == "a" else file

    replaced: list[tuple[Any, str, Callable[..., Any]]] = [
        (Envs, "step", watched_step),
        (DdpgAgent, "update", watched_update),
        (ReplayBuffer, "__init__", watched_build),
        (Path, "rename", watched_rename),
        (Path, "write_bytes", watched_write),
        (Path, "open", watched_open),
        (shutil, "copyfile", watched_copy),
    ]
    for owner, name, watched in replaced:
        setattr(owner, name, watched)


def train(order: dict[str, Any]) -> None:
    """Train as ordered."""
    if order["kill"]:
        watch(Reaper(*order["kill"]))
    run(config_from_dict(order["config"]), Path(order["directory"]), tuple(map(Path, order["models"])))


def main() -> None:
    """Take orders until standard input ends."""
    know_short_push()
    for line in sys.stdin:
        process = os.fork()
        if process == 0:
            status = 1
            try:
                train(json.loads(line))
                status = 0
            finally:
                sys.stderr.flush()
                os._exit(status)
        print(process, flush=True)
        print(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), flush=True)


if __name__ == "__main__":
    main()
