"""Where the service is and what opens it: given, or from the environment, or what a service here has left."""

from __future__ import annotations

import fcntl
import ipaddress
import os
from pathlib import Path
from urllib.parse import urlsplit

from backend.client.errors import ClientError

URL_VARIABLE = "SLDR_URL"
TOKEN_VARIABLE = "SLDR_TOKEN"
HOME_VARIABLE = "SLDR_HOME"
DEFAULT_HOME = "~/.sldr"
USUAL_URL = "http://127.0.0.1:8000"
"""Where the service listens unless it is told otherwise."""
SERVER_FILE = "server-address"
"""In the data directory: the address of the service that runs over it, which holds a lock on the file."""
TOKEN_FILE = "access-token"
"""In the data directory: the token of whoever may read that directory, on one line."""


class BadUrl(ClientError):
    """Report an address that can be no service's."""


def find_url(given: str | None) -> str:
    """Return the address of the service: given, in SLDR_URL, of the one that runs here, or the usual one.

    Raises:
        BadUrl: it is no http or https address.
    """
    return check_url(given or os.environ.get(URL_VARIABLE) or find_local_server() or USUAL_URL)


def find_token(given: str | None, url: str) -> str | None:
    """Return the token: given, in SLDR_TOKEN, or this machine's own; None if there is none.

    The token in the data directory is shown to services on this machine alone.

    Raises:
        ClientError: the file that holds it cannot be read.
    """
    if given or os.environ.get(TOKEN_VARIABLE):
        return given or os.environ[TOKEN_VARIABLE]
    path = data_directory() / TOKEN_FILE
    if not is_loopback(url) or not path.exists():
        return None
    try:
        return path.read_text().strip() or None
    except OSError as err:
        raise ClientError(f"{path} cannot be read ({err.strerror}); only whoever runs the service may.") from err


def find_local_server() -> str | None:
    """Return the address of the service that runs over this machine's data directory; None if none does."""
    path = data_directory() / SERVER_FILE
    try:
        with path.open() as file:
            try:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                return file.read().strip() or None
    except OSError:
        return None
    # Nobody holds it: the service that wrote it has ended.
    return None


def data_directory() -> Path:
    """Return the data directory of this machine."""
    return Path(os.environ.get(HOME_VARIABLE) or DEFAULT_HOME).expanduser().absolute()


def check_url(url: str) -> str:
    """Return an address without a slash at its end.

    Raises:
        BadUrl: it is no http or https address.
    """
    try:
        parts = urlsplit(url.strip())
        is_one = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:
        is_one = False
    if not is_one:
        raise BadUrl(f"'{url}' is no address of a service; write one such as {USUAL_URL}.")
    return url.strip().rstrip("/")


def is_loopback(url: str) -> bool:
    """Tell whether an address is of this machine for certain, without asking anyone."""
    host = urlsplit(url).hostname or ""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
