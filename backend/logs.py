"""Logs of the service's own processes: lines for a person or JSON for a machine, on stderr and in files that rotate.

What a line is about (a run and its attempt, a request) is set once with `about` and stands in every line until then.
"""

from __future__ import annotations

import fcntl
import json
import logging
import logging.handlers
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from datetime import UTC, datetime
from pathlib import Path
from typing import IO, Literal, cast, get_args

from backend.redaction import redact
from sldr_core.errors import InvalidConfig

LogStyle = Literal["human", "json"]
STYLE_VARIABLE = "SLDR_LOG_FORMAT"
LARGEST_FILE = 10 * 1024 * 1024
"""A log file is set aside once it has grown to this size [bytes]."""
KEPT_FILES = 5
"""Files set aside that are kept; the oldest goes when another comes."""
QUIET = ("httpx", "httpcore")
"""Libraries that would write every address they ask, tokens in it and all."""
MOST_NAMES = 50
"""Processes of one role that may write logs in one directory."""

_about: ContextVar[Mapping[str, str | int]] = ContextVar("about")


@contextmanager
def about(**what: str | int) -> Iterator[None]:
    """Let every line that is written within say what it is about, as in `about(run_id=..., attempt=...)`."""
    before = _about.set({**_about.get({}), **what})
    try:
        yield
    finally:
        _about.reset(before)


def load_style() -> LogStyle:
    """Return the style that SLDR_LOG_FORMAT names.

    Raises:
        InvalidConfig: there is no such style.
    """
    style = os.environ.get(STYLE_VARIABLE) or "human"
    if style not in get_args(LogStyle):
        raise InvalidConfig({STYLE_VARIABLE: f"'{style}' is no format of logs; write human or json."})
    return cast(LogStyle, style)


def start_logging(role: str, directory: Path, style: LogStyle, level: int = logging.INFO) -> Path:
    """Write this process's log to stderr and to a file of its own; return the file.

    Args:
        role: what this process is, as in `api` or `worker`; its file is named after it.
        directory: where the files lie; made if it is not there.
    """
    directory.mkdir(parents=True, exist_ok=True)
    path = _own_file(directory, role)
    formatter = JsonLines(role) if style == "json" else HumanLines()
    file = logging.handlers.RotatingFileHandler(path, maxBytes=LARGEST_FILE, backupCount=KEPT_FILES, encoding="utf-8")
    for handler in (logging.StreamHandler(sys.stderr), file):
        handler.setFormatter(formatter)
        logging.getLogger().addHandler(handler)
    logging.getLogger().setLevel(level)
    for name in QUIET:
        logging.getLogger(name).setLevel(logging.WARNING)
    return path


class HumanLines(logging.Formatter):
    """Write time, what happened, and behind it what that is about."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(message)s")

    def format(self, record: logging.LogRecord) -> str:
        """Return all of it, without secrets."""
        return redact(super().format(record))

    def formatMessage(self, record: logging.LogRecord) -> str:  # noqa: N802 - named by the standard library
        """Return the line, without a traceback."""
        ids = " ".join(f"{name}={value}" for name, value in _about.get({}).items())
        line = super().formatMessage(record)
        return f"{line} [{ids}]" if ids else line


class JsonLines(logging.Formatter):
    """Write one JSON object a line."""

    def __init__(self, role: str) -> None:
        super().__init__()
        self._role = role

    def format(self, record: logging.LogRecord) -> str:
        """Return the line; a traceback is a field of it."""
        line = {
            "at": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "role": self._role,
            "logger": record.name,
            "message": record.getMessage(),
            **_about.get({}),
        }
        if record.exc_info:
            line["error"] = self.formatException(record.exc_info)
        return redact(json.dumps(line, ensure_ascii=False, default=str))


_held: list[IO[str]] = []
"""Locks of the files that this process writes; they end with it."""


def _own_file(directory: Path, role: str) -> Path:
    """Return a file that no other living process writes: two that rotate one file would lose lines."""
    for number in range(1, MOST_NAMES + 1):
        path = directory / (f"{role}.log" if number == 1 else f"{role}-{number}.log")
        lock = path.with_suffix(".lock").open("w")
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.close()
            continue
        _held.append(lock)
        return path
    raise InvalidConfig({"logs": f"{MOST_NAMES} processes write {role} logs in {directory}; end some of them."})
