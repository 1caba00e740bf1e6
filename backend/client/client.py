"""The client: one connection to a service, and what can be done there."""

from __future__ import annotations

from types import TracebackType

from backend.client.access import find_token, find_url
from backend.client.comparisons import Comparisons
from backend.client.connection import Connection
from backend.client.records.service import Choices, Health, Worker
from backend.client.runs import Runs
from backend.client.studies import Studies


class Client:
    """Speak to a service from a notebook or script. Share one between threads."""

    def __init__(self, url: str | None = None, token: str | None = None) -> None:
        """Prepare to ask; nothing is sent yet.

        Args:
            url: where the service is; if None, what SLDR_URL says, or the service that runs over this machine's data
                directory, or http://127.0.0.1:8000.
            token: what opens it; if None, what SLDR_TOKEN says, or this machine's own for a service on it.

        Raises:
            ClientError: the address can be none.
        """
        self.url = find_url(url)
        self._connection = Connection(self.url, find_token(token, self.url))
        self.runs = Runs(self._connection)
        self.studies = Studies(self._connection, self.runs)
        self.comparisons = Comparisons(self._connection)

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close all connections."""
        self._connection.close()

    def health(self) -> Health:
        """Return whether runs would be trained and watched."""
        return self._connection.ask(Health, "/healthz")

    def choices(self) -> Choices:
        """Return the tasks, methods and presets that can be launched."""
        return self._connection.ask(Choices, "/api/choices")

    def workers(self) -> list[Worker]:
        """Return the workers known to the service."""
        return self._connection.ask(list[Worker], "/api/workers", "workers")
