"""The command line: `sldr COMMAND ...`, one module per command, imported only when it is used."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version

from sldr_core.disk import NO_ROOM
from sldr_core.errors import UnknownName
from worker.sentences import BAD_INPUT, tell

COMMANDS = {
    "serve": "Serve the page in the browser, with a worker and the 3D viewer.",
    "worker": "Train queued runs, on this machine or on a cluster.",
    "node": "Make this machine a node of a cluster.",
    "viewer": "Serve 3D views of policies to the page.",
    "launch": "Queue runs, or a study of them, for the workers.",
    "runs": "List runs.",
    "train": "Train here and now, without page and queue.",
    "evaluate": "Measure the success of a trained policy.",
    "replay": "Simulate recorded episodes again and compare every bit.",
    "render": "Draw the picture of a task.",
    "export": "Draw figures, pack a study, or write runs for other tools: Rerun, TensorBoard, MLflow.",
    "import": "Take in a study that another installation has exported.",
    "accounts": "List who may sign in, or make a one-time link for somebody.",
    "backup": "Copy all runs and their files to one place, while everything runs.",
    "restore": "Bring back what backup has copied.",
    "list": "List tasks, methods, presets or shipped locomotion models.",
    "zoo": "Put locomotion models into the zoo, measured.",
    "retention": "Make room: let go what ended runs no longer need.",
    "doctor": "See whether everything here works, and how to mend what does not.",
}

MODULES = {"import": "import_study"}
"""Commands whose name no module can have."""

READER_GONE = 141
"""Exit code when nobody reads what is printed any more, as behind `| head`; a shell's for the same."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run one command and exit with its code; what the user can put right is told in one sentence."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        try:
            sys.exit(_answer(words))
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        _drop_rest()
        sys.exit(READER_GONE)
    except OSError as error:
        if error.errno not in NO_ROOM or error.filename is not None:
            raise
        _drop_rest()
        print(f"sldr: What it says could not be written out ({error.strerror}).", file=sys.stderr)
        sys.exit(BAD_INPUT)


def _drop_rest() -> None:
    # What is still held back would be tried, and complained about, once more at the very end.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _answer(words: list[str]) -> int:
    if not words or words[0] in ("-h", "--help"):
        print(_help())
        return 0
    if words[0] == "--version":
        print(f"sldr {version('sldr')}")
        return 0
    return _run(words[0], words[1:])


def _run(command: str, arguments: list[str]) -> int:
    try:
        if command not in COMMANDS:
            raise UnknownName("command", command, COMMANDS)
        return import_module(f"worker.cli.commands.{MODULES.get(command, command)}").main(arguments)
    except KeyboardInterrupt:
        return 130
    except Exception as error:
        return tell(error, speaker="sldr: ")


def _help() -> str:
    width = max(map(len, COMMANDS))
    lines = [f"  {name:{width}}  {summary}" for name, summary in COMMANDS.items()]
    return "\n".join(
        [
            "usage: sldr COMMAND ...",
            "",
            "Train robot manipulation with sparse rewards, from the browser or from here.",
            "",
            *lines,
            "",
            "sldr COMMAND --help tells more. The service keeps its data in SLDR_HOME (default ~/.sldr).",
        ]
    )
