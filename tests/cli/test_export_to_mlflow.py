"""A run in an MLflow store, read back through MLflow; MLflow is an extra, so this runs where it is installed."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest
from store_samples import SampleSize, fill_store

from backend.store.database import Database
from backend.store.metrics import read_metrics
from backend.store.runs import get_run
from worker.exports.exported_run import load_exported
from worker.exports.mlflow import export_to_mlflow


@pytest.mark.filterwarnings("default")
def test_mlflow_reads_back_settings_and_every_point(db: Database, tmp_path: Path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mlflow = pytest.importorskip("mlflow")
    [run_id] = fill_store(db, SampleSize(tasks=("FetchPush",), methods=("her",), seeds=1, epochs=3))
    uri = f"sqlite:///{tmp_path / 'mlflow.db'}"

    told_id = export_to_mlflow(load_exported(db, get_run(db, run_id)), uri)

    client = mlflow.MlflowClient(tracking_uri=uri)
    told = client.get_run(told_id)
    own = read_metrics(db, run_id)
    history = client.get_metric_history(told_id, "test/success_rate")
    assert (told.info.status, told.data.tags["sldr.run_id"]) == ("FINISHED", run_id)
    assert told.data.params["agent.gamma"] == "0.98"
    assert [(point.step, point.value) for point in history] == [
        *zip(own.env_steps, own.values["test/success_rate"], strict=True)
    ]
