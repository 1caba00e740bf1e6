"""Commands over the API of a service."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from backend.client import Client
from backend.client.records.runs import PlannedRun, Run, RunDetail, RunPage
from backend.client.records.studies import StudyOutcome, StudyPreview, StudySpec
from worker.cli.service import Order, Wanted


class ServerService:
    """Ask a service; see `Service`."""

    def __init__(self, client: Client) -> None:
        self._client = client

    def plan(self, order: Order) -> list[PlannedRun]:
        """Return what a launch would queue and share, locomotion first."""
        return self._client.runs.plan(**_words(order))

    def launch(self, order: Order) -> list[Run]:
        """Queue the runs of an order; return them and those that serve, as planned."""
        return self._client.runs.launch(**_words(order))

    def preview_study(self, spec: StudySpec) -> StudyPreview:
        """Return what launching a study would do and cost."""
        return self._client.studies.preview(spec)

    def create_study(self, name: str, spec: StudySpec) -> StudyOutcome:
        """Make a study and queue what nothing serves yet."""
        return self._client.studies.create(name, spec)

    def study_run_ids(self, study_id: str) -> list[str]:
        """Return the ids of a study's runs, the locomotion runs that they need first."""
        found = self._client.studies.get(study_id)
        return [run.run_id for run in (*found.locomotion, *(run for cell in found.cells for run in cell.runs))]

    def get_run(self, run_id: str) -> RunDetail:
        """Return everything about one run."""
        return self._client.runs.get(run_id)

    def list_runs(self, wanted: Wanted, limit: int) -> RunPage:
        """Return the first runs that are wanted, the newest first."""
        return self._client.runs.page(limit, **asdict(wanted))


WORDS = ("task", "phase", "method", "seeds", "preset")


def _words(order: Order) -> dict[str, Any]:
    return {name: getattr(order, name) for name in (*WORDS, "settings", "locomotion")}
