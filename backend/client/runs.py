"""Runs: launching, listing, waiting, what they logged and wrote, and what can be asked of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal
from urllib.parse import quote

from backend.client.connection import Connection
from backend.client.curves import MetricBatch, Metrics, join_batches
from backend.client.errors import NotThere, Problem
from backend.client.records.runs import (
    ActionResult,
    Attempt,
    LogPiece,
    Phase,
    PlannedRun,
    Run,
    RunDetail,
    RunEvent,
    RunFile,
    RunPage,
)
from backend.client.waiting import POLL_S, wait_for_runs

PAGE = 200
"""Runs asked for at once."""

Action = Literal["cancel", "pause", "resume", "retry", "release", "delete", "restore"]
Wanted = Run | str
"""A run, or its id."""


class Runs:
    """Everything about runs; `client.runs`."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def plan(
        self,
        task: str,
        method: str = "her-sldr",
        seeds: Sequence[int] = (0,),
        preset: str = "quick",
        phase: Phase = "manipulation",
        settings: Mapping[str, Any] | None = None,
        locomotion: str = "zoo",
    ) -> list[PlannedRun]:
        """Return what `launch` would queue and share, the locomotion run first; queue nothing.

        Raises:
            Unfit: a name or setting cannot work; the sentence says which.
        """
        body = _launch(task, method, seeds, preset, phase, settings, locomotion)
        return self._connection.tell(list[PlannedRun], "POST", "/api/launches/plan", body, "runs")

    def launch(
        self,
        task: str,
        method: str = "her-sldr",
        seeds: Sequence[int] = (0,),
        preset: str = "quick",
        phase: Phase = "manipulation",
        settings: Mapping[str, Any] | None = None,
        locomotion: str = "zoo",
    ) -> list[Run]:
        """Queue one run a seed and the locomotion run they need; return all, existing ones that serve among them.

        Args:
            settings: what is laid over the preset, nested, as in `{"loop": {"batch_size": 256}}`.
            locomotion: where locomotion models come from: `zoo`, `train`, or ids of locomotion runs, with commas.

        Raises:
            Unfit: a name or setting cannot work; the sentence says which.
        """
        body = _launch(task, method, seeds, preset, phase, settings, locomotion)
        return self._connection.tell(list[Run], "POST", "/api/launches", body, "runs")

    def find(self, limit: int | None = None, **filters: Any) -> list[Run]:
        """Return the runs that pass all filters, the newest first.

        Args:
            limit: how many at most; all if None.
            filters: as in the page's address: `state`, `task`, `method`, `phase`, `preset`, `tag` (each one word or
                several), `search`, `seed_from`, `seed_to`, `success_from`, `success_to`, `deleted`.
        """
        return self.page(limit, **filters).runs

    def page(self, limit: int | None = None, **filters: Any) -> RunPage:
        """Return the same, with how many there are in all."""
        found: list[Run] = []
        cursor: str | None = None
        while True:
            left = PAGE if limit is None else min(PAGE, limit - len(found))
            page = self._connection.ask(RunPage, "/api/runs", limit=left, cursor=cursor, **filters)
            found += page.runs
            cursor = page.next_cursor
            if cursor is None or (limit is not None and len(found) >= limit):
                return RunPage(runs=found, next_cursor=cursor, total=page.total)

    def get(self, run: Wanted) -> RunDetail:
        """Return everything about a run but its curves and files.

        Raises:
            NotThere: there is no such run.
        """
        return self._connection.ask(RunDetail, _path(run))

    def wait(
        self,
        runs: Iterable[Wanted],
        timeout_s: float | None = None,
        on_change: Callable[[Run], None] | None = None,
        poll_s: float = POLL_S,
    ) -> list[Run]:
        """Wait until each has ended, or goes no further without a person, as if paused; see `wait_for_runs`."""
        return wait_for_runs(self.get, [_id(run) for run in runs], timeout_s, on_change, poll_s)

    def metrics(self, run: Wanted, names: Collection[str] | None = None) -> Metrics:
        """Return all that a run has logged, without what a later attempt has replaced.

        Args:
            names: the metrics wanted, such as `test/success_rate`; all if None.
        """
        batches = [self._connection.ask(MetricBatch, f"{_path(run)}/metrics")]
        while batches[-1].step:
            after = batches[-1].cursor
            batches.append(self._connection.ask(MetricBatch, f"{_path(run)}/metrics", after=after))
        return join_batches(_id(run), batches, names)

    def files(self, run: Wanted) -> list[RunFile]:
        """Return a run's stored files, by name."""
        return self._connection.ask(list[RunFile], f"{_path(run)}/files", "files")

    def download(self, run: Wanted, name: str, target: Path | str = ".") -> Path:
        """Copy one stored file of a run, check it against its checksum, and return where it lies.

        Args:
            target: a file to write, or a directory to write it into.

        Raises:
            NotThere: the run has no such file.
            BadAnswer: it came damaged.
        """
        files = {file.name: file for file in self.files(run)}
        if name not in files:
            known = ", ".join(files) or "none yet"
            raise NotThere((Problem(None, f"Run {_id(run)} has no file '{name}'; it has: {known}."),))
        path = Path(target) / name if Path(target).is_dir() else Path(target)
        self._connection.fetch(files[name].url, path, files[name].sha256)
        return path

    def log(self, run: Wanted) -> str:
        """Return what a run's processes have said, from the beginning."""
        pieces = [self._connection.ask(LogPiece, f"{_path(run)}/log", after=0)]
        while pieces[-1].text:
            pieces.append(self._connection.ask(LogPiece, f"{_path(run)}/log", after=pieces[-1].offset))
        return "".join(piece.text for piece in pieces)

    def events(self, run: Wanted) -> list[RunEvent]:
        """Return a run's history, oldest first."""
        return self._connection.ask(list[RunEvent], f"{_path(run)}/events", "events")

    def attempts(self, run: Wanted) -> list[Attempt]:
        """Return a run's attempts, oldest first."""
        return self._connection.ask(list[Attempt], f"{_path(run)}/attempts", "attempts")

    def act(self, action: Action, runs: Iterable[Wanted]) -> list[ActionResult]:
        """Do something to runs; one that does not allow it says why, and keeps no other from it."""
        body = {"action": action, "run_ids": [_id(run) for run in runs]}
        return self._connection.tell(list[ActionResult], "POST", "/api/runs/actions", body, "results")

    def cancel(self, runs: Iterable[Wanted]) -> list[ActionResult]:
        """End runs for good."""
        return self.act("cancel", runs)

    def tag(self, runs: Iterable[Wanted], add: Collection[str] = (), remove: Collection[str] = ()) -> None:
        """Give runs tags and take others away."""
        body = {"run_ids": [_id(run) for run in runs], "add": sorted(add), "remove": sorted(remove)}
        self._connection.tell(type(None), "POST", "/api/runs/tags", body)

    def note(self, run: Wanted, text: str) -> None:
        """Replace the notes of a run, which are plain text."""
        self._connection.tell(type(None), "PUT", f"{_path(run)}/notes", {"notes": text})


def _launch(
    task: str,
    method: str,
    seeds: Sequence[int],
    preset: str,
    phase: Phase,
    settings: Mapping[str, Any] | None,
    locomotion: str,
) -> dict[str, Any]:
    choices = {"task": task, "phase": phase, "method": method, "seeds": list(seeds), "preset": preset}
    return {**choices, "overrides": dict(settings or {}), "locomotion": locomotion}


def _id(run: Wanted) -> str:
    return run if isinstance(run, str) else run.id


def _path(run: Wanted) -> str:
    return f"/api/runs/{quote(_id(run), safe='')}"
