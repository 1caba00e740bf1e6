"""Runs in an MLflow tracking store: one experiment a task, one MLflow run a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from backend.store.states import RunState
from worker.exports.exported_run import ExportedRun
from worker.exports.extras import load_extra

EXTRA = "mlflow"
METRICS_AT_ONCE = 1000
"""What MLflow takes in one call; the same holds for the parameters."""
PARAMETERS_AT_ONCE = 100

STATUSES: Mapping[str, str] = {RunState.SUCCEEDED: "FINISHED", RunState.FAILED: "FAILED", RunState.CANCELLED: "KILLED"}
"""How MLflow calls a run's end; all others are still running."""


def export_to_mlflow(run: ExportedRun, uri: str) -> str:
    """Write a run to the tracking store at `uri` and return MLflow's id of it.

    A run that was exported before gets a second copy, marked with the same tag `sldr.run_id`.

    Raises:
        ExtraMissing: MLflow is not installed.
    """
    client = load_extra("mlflow", EXTRA).MlflowClient(tracking_uri=uri)
    entities = load_extra("mlflow.entities", EXTRA)
    row = run.row
    tags = {"sldr.run_id": row.id, "sldr.preset": row.preset, "sldr.phase": row.phase, "mlflow.runName": run.name}
    begun = row.started_at or row.created_at
    made = client.create_run(_experiment(client, row.task), int(1000 * begun.timestamp()), tags=tags)
    run_id = made.info.run_id
    parameters = [entities.Param(name, value) for name, value in run.settings.items()]
    for part in _parts(parameters, PARAMETERS_AT_ONCE):
        client.log_batch(run_id, params=part)
    metrics = [
        entities.Metric(name, value, int(1000 * at), step.env_steps)
        for step, at, values in run.points()
        for name, value in values.items()
    ]
    for part in _parts(metrics, METRICS_AT_ONCE):
        client.log_batch(run_id, metrics=part)
    if row.state in STATUSES:
        ended = row.ended_at or begun
        client.set_terminated(run_id, STATUSES[row.state], int(1000 * ended.timestamp()))
    return run_id


def _experiment(client: Any, task: str) -> str:
    known = client.get_experiment_by_name(task)
    return client.create_experiment(task) if known is None else known.experiment_id


def _parts(entries: Sequence[Any], most: int) -> Iterator[Sequence[Any]]:
    return (entries[start : start + most] for start in range(0, len(entries), most))
