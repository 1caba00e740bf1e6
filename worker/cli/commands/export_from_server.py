"""`sldr export --server URL`: what a service has, written here."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np

from backend.client import Client, ClientError
from backend.client.access import URL_VARIABLE
from backend.client.curves import Metrics
from sldr_core.records import Step
from worker.cli.commands.export_checks import check_metric, check_runs
from worker.exports.exported_run import ExportedRun

Question = Mapping[str, Any]
"""What a comparison is asked for, as its address says it."""


def find_named_server(server: str | None) -> str | None:
    """Return the service that an option or SLDR_URL names; what merely runs here has no more than the store has."""
    return server or os.environ.get(URL_VARIABLE) or None


def fetch_figure(server: str, out: Path, kind: Literal["curves", "best"], question: Question) -> None:
    """Have a figure drawn there, or its numbers written.

    Raises:
        ClientError: the service cannot be asked, or refuses.
        InvalidConfig: no run passes, or none has logged anything.
        UnknownName: none has logged that metric.
    """
    with Client(server) as client:
        _check(client, question, is_of_metric=kind == "curves")
        client.comparisons.figure(out, kind, **question)


def fetch_bundle(server: str, out: Path, anonymous: bool, question: Question) -> None:
    """Have a bundle packed there.

    Raises:
        ClientError: the service cannot be asked, or refuses.
        InvalidConfig: no run passes, or none has logged anything.
        UnknownName: none has logged that metric.
    """
    with Client(server) as client:
        _check(client, question, is_of_metric=True)
        client.comparisons.bundle(out, anonymous, **question)


def fetch_recording(server: str, run_id: str, out: Path) -> None:
    """Copy the newest Rerun file of a run.

    Raises:
        ClientError: the run has none, or the service cannot be asked.
    """
    with Client(server) as client:
        recordings = [file for file in client.runs.files(run_id) if file.kind == "recording"]
        if not recordings:
            raise ClientError(f"Run {run_id} has no Rerun file yet; one is written some minutes after it has begun.")
        client.runs.download(run_id, max(recordings, key=lambda file: file.created_at).name, out)


def fetch_exported(server: str, question: Question) -> Iterator[ExportedRun]:
    """Yield the runs that a question names, with all that they have logged.

    Raises:
        ClientError: the service cannot be asked, or refuses.
        InvalidConfig: no run passes, or not each that is named.
    """
    with Client(server) as client:
        for run_id in _check(client, question, is_of_metric=False):
            metrics = client.runs.metrics(run_id)
            yield ExportedRun(client.runs.get(run_id), steps_of(metrics), columns_of(metrics))


def _check(client: Client, question: Question, is_of_metric: bool) -> list[str]:
    """Return the runs that a question is about, once it is known that there are any."""
    compared = client.comparisons.curves(**{name: given for name, given in question.items() if name != "width"})
    members = [member.run_id for panel in compared.panels for curve in panel.curves for member in curve.members]
    run_ids = list(dict.fromkeys([*members, *(left.run_id for left in compared.left_out)]))
    check_runs(question["run"], run_ids)
    if is_of_metric:
        check_metric(compared, lambda: client.runs.metrics(run_ids[0]).values)
    return run_ids


def steps_of(metrics: Metrics) -> list[Step]:
    """Return where each point was logged."""
    counts = (metrics.axes[name].astype(int).tolist() for name in ("step", "epoch", "env_steps", "episodes", "updates"))
    return [Step(*numbers) for numbers in zip(*counts, metrics.axes["wall_seconds"].tolist(), strict=True)]


def columns_of(metrics: Metrics) -> dict[str, list[float | None]]:
    """Return each metric's values; None where it was not logged."""
    return {
        name: [None if np.isnan(value) else float(value) for value in column] for name, column in metrics.values.items()
    }
