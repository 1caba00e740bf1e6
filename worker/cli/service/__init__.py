"""Where the command line's launches and questions go: to a service over its API, or straight to the store.

Both say the same in the records of the client, so that a command prints them in one way.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Annotated, Any, Protocol

import tyro

from backend.client.access import URL_VARIABLE, find_local_server
from backend.client.records.runs import Phase, PlannedRun, Run, RunDetail, RunPage
from backend.client.records.studies import StudyOutcome, StudyPreview, StudySpec

Server = Annotated[str | None, tyro.conf.arg(metavar="URL", help_behavior_hint="")]
"""The address of a service, as an option of commands."""


@dataclass(frozen=True)
class Order:
    """Ask for one run a seed, with the locomotion run they need."""

    task: str
    phase: Phase
    method: str
    seeds: Sequence[int]
    preset: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    """Settings laid over the preset, nested."""
    locomotion: str = "zoo"
    """Where locomotion models come from: `zoo`, `train`, or ids of locomotion runs, separated by commas."""


@dataclass(frozen=True)
class Wanted:
    """Say which runs are listed; None is any."""

    state: str | None = None
    task: str | None = None
    method: str | None = None
    phase: Phase | None = None
    search: str | None = None


class Service(Protocol):
    """What commands ask for."""

    def plan(self, order: Order) -> list[PlannedRun]:
        """Return what a launch would queue and share, locomotion first."""
        ...

    def launch(self, order: Order) -> list[Run]:
        """Queue the runs of an order; return them and those that serve, as planned."""
        ...

    def preview_study(self, spec: StudySpec) -> StudyPreview:
        """Return what launching a study would do and cost."""
        ...

    def create_study(self, name: str, spec: StudySpec) -> StudyOutcome:
        """Make a study and queue what nothing serves yet."""
        ...

    def study_run_ids(self, study_id: str) -> list[str]:
        """Return the ids of a study's runs, the locomotion runs that they need first."""
        ...

    def get_run(self, run_id: str) -> RunDetail:
        """Return everything about one run."""
        ...

    def list_runs(self, wanted: Wanted, limit: int) -> RunPage:
        """Return the first runs that are wanted, the newest first."""
        ...


@contextmanager
def open_service(server: str | None) -> Iterator[Service]:
    """Open the service at an address, in SLDR_URL, or that runs over this data directory; else the store itself.

    Raises:
        ClientError: the address can be none.
        SldrError: the store cannot be opened.
    """
    if server or os.environ.get(URL_VARIABLE) or find_local_server():
        from backend.client import Client
        from worker.cli.service.server import ServerService

        with Client(server) as client:
            yield ServerService(client)
    else:
        from worker.cli.service.store import open_store_service

        with open_store_service() as service:
            yield service
