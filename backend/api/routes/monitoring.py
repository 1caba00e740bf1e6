"""What a monitor asks: `/metrics`, in the text format of Prometheus."""

from __future__ import annotations

from collections.abc import Iterator

from fastapi import APIRouter
from fastapi.responses import Response
from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, generate_latest
from prometheus_client.core import GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

from backend.api.access.declarations import needs
from backend.api.dependencies import Registry, Store
from backend.api.errors import problem_responses
from backend.store.census import Census, take_census

router = APIRouter(tags=["health"])


@router.get(
    "/metrics",
    response_class=Response,
    responses={200: {"content": {"text/plain": {}}, "description": "Every metric, one a line."}} | problem_responses(),
)
@needs("viewer")
def get_metrics(store: Store, registry: Registry) -> Response:
    """Tell runs by state, workers, how long the queue waits, and how long requests take, for Prometheus."""
    now = CollectorRegistry()
    now.register(CensusCollector(take_census(store)))
    content = generate_latest(now) + generate_latest(registry)
    return Response(content, headers={"content-type": CONTENT_TYPE_LATEST})


class CensusCollector(Collector):
    """Tell a census as gauges."""

    def __init__(self, census: Census) -> None:
        self._census = census

    def collect(self) -> Iterator[Metric]:
        """Yield every gauge."""
        census = self._census
        runs = GaugeMetricFamily("sldr_runs", "Runs that are not deleted, by state.", labels=["state"])
        for state, count in census.runs.items():
            runs.add_metric([state.value], count)
        yield runs
        gauges = {
            "sldr_workers": ("Workers that are alive.", census.workers_alive),
            "sldr_workers_draining": ("Living workers that take no further run.", census.workers_draining),
            "sldr_slots": ("Runs that the living workers can train at once.", census.slots),
            "sldr_slots_busy": ("Runs that the living workers train.", census.busy),
            "sldr_queue_age_seconds": ("How long the longest waiting queued run has waited.", census.queue_age_s),
        }
        for name, (help_text, value) in gauges.items():
            yield GaugeMetricFamily(name, help_text, value=value)
