"""What routes are handed: the store, the settings and the tokens of the application they belong to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import httpx
from fastapi import Depends
from prometheus_client import CollectorRegistry
from starlette.requests import HTTPConnection

from backend.api.access.callers import Access, Caller
from backend.api.tokens import ViewerTokens
from backend.comparison.memory import ComparisonMemory
from backend.store.database import Database
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.webhooks.sender import Sender


@dataclass(frozen=True)
class Service:
    """Hold what lives as long as the application."""

    settings: Settings
    database: Database
    storage: FileStorage
    tokens: ViewerTokens
    viser: httpx.Client
    """Fetches pages from the 3D servers on this machine."""
    memory: ComparisonMemory
    """What comparisons keep between two questions."""
    sender: Sender
    """Tells other services what has ended."""
    access: Access
    """Who comes in."""


# Asynchronous, though they wait for nothing: FastAPI hands every other function to a thread, which takes longer.


async def get_service(connection: HTTPConnection) -> Service:
    """Return the service of the application that answers."""
    return _service(connection)


async def get_database(connection: HTTPConnection) -> Database:
    """Return the store."""
    return _service(connection).database


async def get_storage(connection: HTTPConnection) -> FileStorage:
    """Return where stored files lie."""
    return _service(connection).storage


async def get_settings(connection: HTTPConnection) -> Settings:
    """Return the settings."""
    return _service(connection).settings


async def get_tokens(connection: HTTPConnection) -> ViewerTokens:
    """Return the signer of viewer tokens."""
    return _service(connection).tokens


async def get_memory(connection: HTTPConnection) -> ComparisonMemory:
    """Return what comparisons keep."""
    return _service(connection).memory


async def get_registry(connection: HTTPConnection) -> CollectorRegistry:
    """Return what this process counts for a monitor."""
    return connection.app.state.registry


async def get_caller(connection: HTTPConnection) -> Caller:
    """Return who asks, at a route that nobody else reaches."""
    caller = connection.scope["state"]["caller"]
    assert isinstance(caller, Caller)
    return caller


def _service(connection: HTTPConnection) -> Service:
    return connection.app.state.service


ServiceParts = Annotated[Service, Depends(get_service)]
Store = Annotated[Database, Depends(get_database)]
Storage = Annotated[FileStorage, Depends(get_storage)]
ServiceSettings = Annotated[Settings, Depends(get_settings)]
Tokens = Annotated[ViewerTokens, Depends(get_tokens)]
Memory = Annotated[ComparisonMemory, Depends(get_memory)]
Registry = Annotated[CollectorRegistry, Depends(get_registry)]
KnownCaller = Annotated[Caller, Depends(get_caller)]
