"""`sldr serve`: the page, a worker and the 3D viewer, as child processes."""

from __future__ import annotations

import os
import signal
import socket
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Collection, Sequence

import tyro

from backend.store.access.entry import choose_mode, greet
from backend.store.engines import open_engine, parse_address
from backend.store.settings import load_settings
from backend.store.storage import FileStorage
from sldr_core.errors import InvalidConfig, SldrError
from worker.cli.children import Child
from worker.ports import HIGHEST_PORT

LOOK_INTERVAL_S = 0.2
"""How often the children are looked at [s]."""

HEAD_START_S = 5.0
"""The API starts alone for so long, unless it answers earlier [s]."""

END_S = 30.0
"""How long children may take to checkpoint and end [s]."""

HURRY_S = 3.0
"""How long they may take once they were asked again [s]."""

ANSWER_S = 1.0
"""How long the API may take to say that it is well [s]."""

MOST_DEATHS = 5
"""The API may die this often before it ever answers; then something is wrong that a restart does not mend."""


class CannotServe(SldrError):
    """Report what keeps the service from starting."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(serve, prog="sldr serve", args=list(arguments))


def serve(host: str = "127.0.0.1", port: int = 8000, workers: int = 1, accounts: bool = False) -> int:
    """Serve the page in the browser, with a worker and the 3D viewer, until told to end.

    Args:
        host: Address to listen on. On any but this machine's own, people sign in with accounts.
        port: Port to listen on.
        workers: Runs trained at the same time on this machine (0: none).
        accounts: Ask for accounts on 127.0.0.1 too, behind a proxy for example.
    """
    if workers < 0:
        raise InvalidConfig({"workers": f"it must be 0 or more, got {workers}"})
    check_port(host, port)
    settings = load_settings()
    # An address that cannot work is told here, once, and not by every child again and again.
    open_engine(parse_address(settings.database_url)).dispose()
    FileStorage(settings)
    environment = {**os.environ, **settings.as_environment()}
    commands = {
        "API": ["backend.api", "--host", host, "--port", str(port), *(["--accounts"] if accounts else [])],
        "worker": ["worker", "--slots", str(workers)],
        "viewer": ["worker.viewer"],
    }
    if not workers:
        del commands["worker"]
    children = {name: Child(name, [sys.executable, "-m", *command], environment) for name, command in commands.items()}
    address = _address(host, port)

    def greeting() -> str:
        return f"{greet(settings, address, choose_mode(host, accounts))}  Data: {settings.home}. Ctrl-C ends it."

    return keep(children, address, greeting)


def keep(children: dict[str, Child], address: str, greeting: Callable[[], str]) -> int:
    """Keep the children alive until SIGINT or SIGTERM, then end them all; say when the API answers.

    Who asks a second time does not wait for what they have to finish.
    """
    ended_by: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, frame: ended_by.append(number))
    answered = False
    all_at = time.monotonic() + HEAD_START_S
    try:
        while not ended_by:
            # A person waits for the page; the others would take the cores that it needs to start.
            is_time = answered or time.monotonic() >= all_at
            for child in children.values() if is_time else (children["API"],):
                child.keep_alive(_tell)
            if not answered and (answered := _answers(address)):
                print(greeting(), flush=True)
            if not answered and children["API"].deaths_in_youth >= MOST_DEATHS:
                raise CannotServe(f"The API ended {MOST_DEATHS} times before it answered; its last words are above.")
            time.sleep(LOOK_INTERVAL_S)
    finally:
        if ended_by:
            _tell(f"Trainings may take up to {END_S:.0f} s to checkpoint; Ctrl-C again ends at once.")
        _end(children.values(), lambda: len(ended_by) > 1)
    return 0


def _end(children: Collection[Child], asked_again: Callable[[], bool]) -> None:
    for child in children:
        child.ask_to_end()
    until, is_in_hurry = time.monotonic() + END_S, False
    while time.monotonic() < until and not all(child.has_ended for child in children):
        if asked_again() and not is_in_hurry:
            # A worker that is asked twice hands its runs back without a checkpoint.
            for child in children:
                child.ask_to_end()
            until, is_in_hurry = time.monotonic() + HURRY_S, True
        time.sleep(LOOK_INTERVAL_S)
    for child in children:
        child.wait(until)


def check_port(host: str, port: int) -> None:
    """Raise a sentence if nobody can listen there."""
    if not 1 <= port <= HIGHEST_PORT:
        raise InvalidConfig({"port": f"it must be between 1 and {HIGHEST_PORT}, got {port}"})
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    except socket.gaierror as error:
        raise CannotServe(f"'{host}' is no address of this machine; use 127.0.0.1.") from error
    family, kind, protocol, _, address = found[0]
    with socket.socket(family, kind, protocol) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(address)
            probe.listen()
        except OSError as error:
            raise CannotServe(
                f"Cannot listen on {host} port {port} ({error.strerror}); "
                f"end what uses it, or choose another with --port."
            ) from error


def _address(host: str, port: int) -> str:
    """Return where a browser on this machine finds the page."""
    shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]", "": "127.0.0.1"}.get(host, f"[{host}]" if ":" in host else host)
    return f"http://{shown}:{port}"


def _answers(address: str) -> bool:
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    try:
        with opener.open(f"{address}/healthz", timeout=ANSWER_S):
            return True
    except (urllib.error.URLError, OSError):
        return False


def _tell(sentence: str) -> None:
    print(f"sldr: {sentence}", file=sys.stderr, flush=True)
