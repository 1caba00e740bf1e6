"""What docs/client.md shows works as it says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from operator import attrgetter
from pathlib import Path
from typing import Any

import pytest
from live_api import Service
from store_samples import SampleSize, fill_store

from backend.client import Client
from backend.webhooks.messages import sign

PAGE = (Path(__file__).parents[2] / "docs/client.md").read_text()
FIRST, SECOND, GENUINE = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
NOT_LISTED = {"close", "url", "runs", "studies", "comparisons"}


@pytest.fixture
def client(service: Service) -> Iterator[Client]:
    """Return a client of a service."""
    token = service.client.headers.get("Authorization", "").removeprefix("Bearer ")
    with Client(str(service.client.base_url), token or None) as client:
        yield client


def run(code: str, names: dict[str, Any]) -> dict[str, Any]:
    exec(compile(code, "docs/client.md", "exec"), names)
    return names


def test_the_table_names_what_there_is(client: Client):
    rows = re.findall(r"^\| `(client[.a-z]*)` \| (.*) \|$", PAGE, re.MULTILINE)
    assert len(rows) == 4
    for name, told in rows:
        part = attrgetter(name.partition(".")[2])(client) if "." in name else client
        known = {method for method in (*dir(part), *vars(part)) if not method.startswith("_")}
        assert set(re.findall(r"`(\w+)`", told)) <= known - NOT_LISTED, name


def test_the_examples_launch_read_and_draw(
    client: Client, service: Service, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    fill_store(service.database, SampleSize(tasks=("FetchSlide",), methods=("her",), seeds=1, epochs=4))
    # Nobody trains here: what is waited for is cancelled, and the curve is that of a finished run.
    monkeypatch.setattr(client.runs, "wait", client.runs.cancel)
    monkeypatch.setattr(client.studies, "wait", client.studies.get)
    finished = client.runs.find(task="FetchSlide")[0]
    read = client.runs.metrics
    monkeypatch.setattr(client.runs, "metrics", lambda run: read(finished))
    monkeypatch.setattr(client.runs, "download", lambda run, name, target: None)
    monkeypatch.setattr("backend.client.curves.Metrics.frame", lambda self: None)
    figure = client.comparisons.figure
    drawn: list[Path] = []
    monkeypatch.setattr(
        client.comparisons, "figure", lambda out, **asked: drawn.append(figure(tmp_path / "push.csv", **asked))
    )
    names = run(FIRST.replace("from backend.client import Client\n", ""), {"Client": lambda: client})
    assert len(names["success"]) == 4
    run(SECOND, names)
    assert drawn[0].is_file()


def test_a_genuine_message_is_known():
    is_genuine = run(GENUINE, {})["is_genuine"]
    body = b'{"event": "test"}'
    assert is_genuine("key", "17", body, sign("key", 17, body))
    assert not is_genuine("key", "18", body, sign("key", 17, body))
