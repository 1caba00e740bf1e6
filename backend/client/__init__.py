"""A typed client of the service, for notebooks and scripts: `from backend.client import Client`."""

from backend.client.client import Client
from backend.client.errors import (
    BadAnswer,
    ClientError,
    NotAllowed,
    NotReachable,
    NotThere,
    Refused,
    ServerFailed,
    StillGoing,
    Unfit,
)

__all__ = [
    "BadAnswer",
    "Client",
    "ClientError",
    "NotAllowed",
    "NotReachable",
    "NotThere",
    "Refused",
    "ServerFailed",
    "StillGoing",
    "Unfit",
]
