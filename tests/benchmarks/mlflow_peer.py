"""MLflow's side of a measurement: a tracking store in SQLite, asked line by line by `mlflow_process.py`.

It runs in an environment that has MLflow and nothing of this product. Each answer tells how long the question took.
"""

# pyright: reportMissingImports=false

from __future__ import annotations

import json
import logging
import math
import os
import random
import sys
import time
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

os.environ.update(MLFLOW_DISABLE_TELEMETRY="true", DO_NOT_TRACK="true")
logging.disable(logging.INFO)

from mlflow import MlflowClient  # noqa: E402
from mlflow.entities import Metric, RunStatus, ViewType  # noqa: E402
from mlflow.store.tracking.dbmodels import models  # noqa: E402

SUCCESS = "test/success_rate"
ROWS_AT_ONCE = 50_000
"""Rows of one insert while the store is filled."""


class Peer:
    """Answer questions; every public method is one."""

    def __init__(self, path: Path) -> None:
        self._client = MlflowClient(tracking_uri=f"sqlite:///{path}")
        self._experiment = self._client.create_experiment("bench", artifact_location=str(path.parent / "artifacts"))
        self._written = 0
        self._run: str | None = None

    def log_batches(self, batches: int, names: list[str]) -> int:
        """Log so many batches of one value a name, each at the next step; return the values logged."""
        if self._run is None:
            self._run = self._client.create_run(self._experiment).info.run_id
        for _ in range(batches):
            self._written += 1
            now = int(1000 * time.time())
            self._client.log_batch(
                self._run, [Metric(name, math.sin(self._written), now, self._written) for name in names]
            )
        return batches * len(names)

    def fill(self, runs: int, epochs: int, names: list[str], tasks: list[str], methods: list[str]) -> str:
        """Put finished runs straight into the tables, then read one of them through the API; return its id."""
        drawn = random.Random(0)
        tables: dict[Any, list[dict[str, Any]]] = {}
        run_id = ""
        for index in range(runs):
            run_id = uuid.UUID(int=drawn.getrandbits(128)).hex
            kind = index % (len(tasks) * len(methods))
            params = {"task": tasks[kind // len(methods)], "method": methods[kind % len(methods)], "seed": str(index)}
            for table, row in self._rows(run_id, index, params, epochs, names, drawn):
                tables.setdefault(table, []).append(row)
            if sum(map(len, tables.values())) > ROWS_AT_ONCE or index == runs - 1:
                self._insert(tables)
                tables = {}
        self._check(run_id, epochs, names)
        return run_id

    def first_page(self, limit: int) -> int:
        """Return how many runs the page of the best holds."""
        return len(self._search("", limit))

    def narrowed_page(self, limit: int, task: str, least: float) -> int:
        """Return how many runs of a task with this success the page of the best holds."""
        return len(self._search(f"params.task = '{task}' and metrics.`{SUCCESS}` >= {least}", limit))

    def curves(self, task: str, metric: str) -> dict[str, int]:
        """Read a metric's history for all runs of a task; return the points of each method."""
        found = self._search(f"params.task = '{task}'", 1000)
        methods = {run.info.run_id: run.data.params["method"] for run in found}
        points: dict[str, int] = {}
        for run_id, history in self._histories(list(methods), metric):
            points[methods[run_id]] = points.get(methods[run_id], 0) + len(history)
        return points

    def _histories(self, run_ids: list[str], metric: str) -> Iterator[tuple[str, list[Any]]]:
        """Read all runs' histories in one query, which the client has no method for but its store has."""
        by_run: dict[str, list[Any]] = {run_id: [] for run_id in run_ids}
        for point in self._store.get_metric_history_bulk(run_ids, metric, max_results=25_000):
            by_run[point.run_id].append(point)
        yield from by_run.items()

    @property
    def _store(self) -> Any:
        return self._client._tracking_client.store

    def _search(self, wanted: str, limit: int) -> list[Any]:
        order = [f"metrics.`{SUCCESS}` DESC"]
        return list(
            self._client.search_runs(
                [self._experiment], wanted, run_view_type=ViewType.ACTIVE_ONLY, max_results=limit, order_by=order
            )
        )

    def _rows(
        self, run_id: str, index: int, params: dict[str, str], epochs: int, names: list[str], drawn: random.Random
    ) -> Iterator[tuple[Any, dict[str, Any]]]:
        """Return the rows of one run, each with its table."""
        yield (
            models.SqlRun,
            {
                "run_uuid": run_id,
                "name": f"run-{index}",
                "source_type": "LOCAL",
                "user_id": "bench",
                "status": RunStatus.to_string(RunStatus.FINISHED),
                "start_time": index,
                "end_time": index + epochs,
                "lifecycle_stage": "active",
                "artifact_uri": f"artifacts/{run_id}",
                "experiment_id": int(self._experiment),
            },
        )
        for key, value in params.items():
            yield models.SqlParam, {"run_uuid": run_id, "key": key, "value": value}
        speed = drawn.uniform(0.02, 0.3)
        for name in names:
            row: dict[str, Any] = {"run_uuid": run_id, "key": name, "is_nan": False}
            for epoch in range(1, epochs + 1):
                noisy = 1.0 - math.exp(-speed * epoch) + drawn.gauss(0.0, 0.03)
                row = {**row, "value": min(1.0, max(0.0, noisy)), "timestamp": epoch, "step": epoch}
                yield models.SqlMetric, row
            yield models.SqlLatestMetric, row

    def _insert(self, tables: dict[Any, list[dict[str, Any]]]) -> None:
        with self._store.ManagedSessionMaker(read_only=False) as session:
            for table in (models.SqlRun, models.SqlParam, models.SqlMetric, models.SqlLatestMetric):
                session.execute(table.__table__.insert(), tables[table])

    def _check(self, run_id: str, epochs: int, names: list[str]) -> None:
        """Compare a run as the API reads it with what was put there."""
        read = self._client.get_run(run_id).data
        history = self._client.get_metric_history(run_id, SUCCESS)
        last = max(history, key=lambda point: point.step)
        if set(read.metrics) != set(names) or len(history) != epochs or read.metrics[SUCCESS] != last.value:
            raise SystemExit(f"MLflow does not read back what was put into its tables: {read.metrics}")


def main() -> None:
    """Answer one question a line until there are no more."""
    peer = Peer(Path(sys.argv[1]))
    for line in sys.stdin:
        question = json.loads(line)
        answer: Callable[..., Any] = getattr(peer, question["command"])
        begun, used = time.perf_counter(), time.process_time()
        told = answer(**question["arguments"])
        seconds, cpu_s = time.perf_counter() - begun, time.process_time() - used
        print(json.dumps({"seconds": seconds, "cpu_s": cpu_s, "told": told}), flush=True)


if __name__ == "__main__":
    main()
