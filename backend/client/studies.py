"""Studies: previewing, launching, listing, waiting."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any
from urllib.parse import quote

from backend.client.connection import Connection
from backend.client.errors import StillGoing
from backend.client.records.runs import ENDED
from backend.client.records.studies import Study, StudyDetail, StudyOutcome, StudyPreview, StudySpec, Variant
from backend.client.runs import Runs
from backend.client.waiting import POLL_S, goes_no_further

Wanted = Study | StudyOutcome | str
"""A study, what its launch has answered, or its id."""


class Studies:
    """Everything about studies; `client.studies`."""

    def __init__(self, connection: Connection, runs: Runs) -> None:
        self._connection = connection
        self._runs = runs

    def preview(self, spec: StudySpec) -> StudyPreview:
        """Return what launching a study would do and cost; queue nothing.

        Raises:
            Unfit: a name or setting cannot work; the sentence says which.
        """
        return self._connection.tell(StudyPreview, "POST", "/api/studies/preview", {"spec": asdict(spec)})

    def launch(
        self,
        name: str,
        tasks: Sequence[str],
        methods: Sequence[str],
        seeds: Sequence[int],
        preset: str = "quick",
        settings: Mapping[str, Any] | None = None,
        variants: Mapping[str, Mapping[str, Any]] | None = None,
        note: str = "",
        locomotion: str = "zoo",
    ) -> StudyOutcome:
        """Make a study and queue the runs that nothing serves yet.

        Args:
            settings: what is laid over the preset in every run, nested, as in `{"loop": {"batch_size": 256}}`.
            variants: further settings that are tried beside each other, by a name for each.
            locomotion: where locomotion models come from: `zoo`, `train`, or ids of locomotion runs, with commas.

        Raises:
            Unfit: a name or setting cannot work; the sentence says which.
        """
        axis = [Variant(name=key, overrides=dict(overrides)) for key, overrides in (variants or {}).items()]
        spec = StudySpec(list(tasks), list(methods), list(seeds), preset, dict(settings or {}), axis, locomotion)
        return self.create(name, spec, note)

    def create(self, name: str, spec: StudySpec, note: str = "") -> StudyOutcome:
        """Make a study of a spec, such as that of another study."""
        body = {"name": name, "note": note, "spec": asdict(spec)}
        return self._connection.tell(StudyOutcome, "POST", "/api/studies", body)

    def find(self, deleted: bool = False) -> list[Study]:
        """Return studies, the newest first.

        Args:
            deleted: those that a person hid, instead of all others.
        """
        return self._connection.ask(list[Study], "/api/studies", "studies", deleted=deleted, limit=500)

    def get(self, study: Wanted) -> StudyDetail:
        """Return a study with all its cells.

        Raises:
            NotThere: there is no such study.
        """
        return self._connection.ask(StudyDetail, f"/api/studies/{quote(_id(study), safe='')}")

    def wait(self, study: Wanted, timeout_s: float | None = None, poll_s: float = POLL_S) -> StudyDetail:
        """Wait until every run of a study has ended, or goes no further without a person; `has_ended` tells which.

        Args:
            timeout_s: how long to wait at most; for ever if None [s].

        Raises:
            StillGoing: not all have ended in time.
        """
        give_up_at = None if timeout_s is None else time.monotonic() + timeout_s
        while not self._stands_still(found := self.get(study)):
            if give_up_at is not None and time.monotonic() > give_up_at:
                going = sum(count for state, count in found.states.items() if state not in ENDED)
                raise StillGoing(f"After {timeout_s:g} s, {going} runs of study '{found.name}' have not ended.")
            time.sleep(poll_s)
        return found

    def _stands_still(self, study: StudyDetail) -> bool:
        """Tell whether no run of a study goes on by itself."""
        every = [*study.locomotion, *(run for cell in study.cells for run in cell.runs)]
        if any(run.state in ("queued", "running") for run in every):
            return False
        blocked = [run.run_id for run in every if run.state == "blocked"]
        return all(goes_no_further(self._runs.get, self._runs.get(run_id)) for run_id in blocked)


def _id(study: Wanted) -> str:
    if isinstance(study, str):
        return study
    return study.study_id if isinstance(study, StudyOutcome) else study.id
