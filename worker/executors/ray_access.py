"""Getting into a Ray cluster safely: with its token, without its dashboard, and never into one that stands open."""

from __future__ import annotations

import importlib.util
import ipaddress
import logging
import os
import secrets
import socket
import subprocess
import sys
from pathlib import Path

from sldr_core.errors import InvalidConfig, SldrError

TOKEN_FILE = "cluster-token"
"""In the data directory: the token that opens the cluster."""
TOKEN_VARIABLES = ("RAY_AUTH_TOKEN", "RAY_AUTH_TOKEN_PATH")
"""Ray's own variables for the token; either is used in place of the file."""
NICENESS = "RAY_worker_niceness"
"""Ray's own variable for how nice a node's attempts are."""
TOKEN_BYTES = 32
DEFAULT_PORT = 6379
CONNECT_S = 5.0
"""How long the head may take to answer [s]."""
KNOCK_S = 60.0
"""How long it may take to find out whether a cluster asks for a token; most of it is Python starting [s]."""

OPEN = "open"
REFUSED = "InvalidAuthToken"
"""What Ray writes when it wants a token."""

KNOCK = f"""
import sys, ray
ray.init(address=sys.argv[1], log_to_driver=False, configure_logging=False)
print("{OPEN}")
"""


class ClusterUnavailable(SldrError):
    """Report a cluster that cannot, or must not, be used."""


def require_ray() -> None:
    """Raise a sentence if Ray is not installed.

    Raises:
        ClusterUnavailable: it is not.
    """
    if importlib.util.find_spec("ray") is None:
        raise ClusterUnavailable(
            "Running on a cluster needs Ray; install it in the product's directory: pip install '.[ray]'"
        )


def connect(address: str, home: Path) -> None:
    """Connect this process to the cluster whose head listens at `address`, `host:port`.

    Raises:
        ClusterUnavailable: nobody is there, our token does not open it, or it opens without any.
    """
    require_ray()
    host, port = split_address(address)
    os.environ.update(cluster_environment(home, host))
    find_token()
    _check_listening(host, port)
    _check_guarded(address)
    import ray  # Reads the environment when imported.

    logging.getLogger("ray").setLevel(logging.ERROR)
    try:
        ray.init(address=address, namespace="sldr", log_to_driver=False, configure_logging=False)
    except (ConnectionError, RuntimeError) as err:
        raise ClusterUnavailable(
            f"The cluster at {address} did not let this worker in: its token may be another than that in "
            f"{_token_source()}, or this machine is not one of its nodes (start `sldr node` here first). "
            f"Ray says: {_first_line(err)}"
        ) from err


def cluster_environment(home: Path, host: str) -> dict[str, str]:
    """Return the environment of whatever takes part in a cluster whose head has the address `host`.

    A token is asked for everywhere, no usage is reported to anybody, and a cluster on the loopback address alone
    listens nowhere else: Ray does so where it believes that there can be no second machine. Trainings keep their
    node's usual priority, unless told otherwise: Ray would make them nicer than what is to make way for them.
    """
    environment = {"RAY_AUTH_MODE": "token", "RAY_USAGE_STATS_ENABLED": "0"}
    environment[NICENESS] = os.environ.get(NICENESS) or "0"
    if not any(os.environ.get(name) for name in TOKEN_VARIABLES):
        environment["RAY_AUTH_TOKEN_PATH"] = str(home / TOKEN_FILE)
    if is_loopback(host):
        environment["RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"] = "0"
    return environment


def make_token(home: Path) -> None:
    """Make the token file of a new cluster, readable by its owner only, unless there is a token already."""
    path = home / TOKEN_FILE
    if path.exists() or any(os.environ.get(name) for name in TOKEN_VARIABLES):
        return
    home.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with os.fdopen(descriptor, "w") as file:
        file.write(secrets.token_hex(TOKEN_BYTES))


def find_token() -> None:
    """Make sure that there is a token to show, once the environment is that of the cluster.

    Raises:
        ClusterUnavailable: there is none.
    """
    if os.environ.get("RAY_AUTH_TOKEN"):
        return
    path = Path(os.environ["RAY_AUTH_TOKEN_PATH"])
    if not path.is_file():
        raise ClusterUnavailable(
            f"There is no token in {path}; copy {TOKEN_FILE} there from the data directory of the cluster's head."
        )


def split_address(address: str) -> tuple[str, int]:
    """Return host and port of `host:port`.

    Raises:
        InvalidConfig: it is not of that form.
    """
    host, colon, port = address.rpartition(":")
    if not (colon and host and port.isdecimal()):
        raise InvalidConfig({"address": f"'{address}' is not of the form host:port, as in 127.0.0.1:{DEFAULT_PORT}"})
    return host.strip("[]"), int(port)


def is_loopback(host: str) -> bool:
    """Tell whether an address is one that only this machine can reach."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _check_listening(host: str, port: int) -> None:
    """Raise a sentence if nobody listens; Ray itself would wait for minutes."""
    try:
        socket.create_connection((host, port), CONNECT_S).close()
    except OSError as err:
        raise ClusterUnavailable(
            f"No cluster answers at {host}:{port} ({err.strerror or err}); start its head with `sldr node --head`."
        ) from err


def _check_guarded(address: str) -> None:
    """Raise a sentence if the cluster lets in somebody who shows no token: it would run anybody's code."""
    environment = {name: value for name, value in os.environ.items() if name not in TOKEN_VARIABLES}
    environment |= {"RAY_AUTH_MODE": "disabled", "RAY_NUM_REDIS_GET_RETRIES": "1"}
    command = [sys.executable, "-c", KNOCK, address]
    try:
        knock = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=KNOCK_S, check=False)
    except subprocess.TimeoutExpired as err:
        raise ClusterUnavailable(f"What listens at {address} does not answer like a Ray cluster.") from err
    if OPEN in knock.stdout.split():
        raise ClusterUnavailable(
            f"The cluster at {address} obeys anybody who reaches it; start every node with `sldr node`, "
            "or with RAY_AUTH_MODE=token."
        )
    if REFUSED not in knock.stderr:
        raise ClusterUnavailable(f"What listens at {address} does not answer like a Ray cluster.")


def _token_source() -> str:
    return "RAY_AUTH_TOKEN" if os.environ.get("RAY_AUTH_TOKEN") else os.environ["RAY_AUTH_TOKEN_PATH"]


def _first_line(err: Exception) -> str:
    return (str(err).strip().splitlines() or [type(err).__name__])[0]
