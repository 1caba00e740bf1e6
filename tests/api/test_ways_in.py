"""The commands and scripts that the page offers, run against a service: they launch what the form would have."""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from live_api import Service

from backend.store.run_filter import RunFilter
from backend.store.runs import list_runs
from backend.store.studies.matrix import list_studies
from backend.store.studies.spec import spec_to_dict

TEXTS = Path(__file__).parents[2] / "web/src/testing/ways-in"
"""A vitest holds the page to these texts."""
SHOWN_SERVER = "http://127.0.0.1:8000"
ENDED_WITHIN_S = 120.0


def run_text(name: str, service: Service) -> None:
    """Run a text as a person would who has pasted it, but for the address."""
    text = (TEXTS / name).read_text().replace(SHOWN_SERVER, str(service.client.base_url).rstrip("/"))
    if name.endswith("-command.txt"):
        assert shlex.split(text)[0] == "sldr"
        text = text.replace("sldr", f"{shlex.quote(sys.executable)} -m worker.cli", 1)
        command = ["bash", "-c", text]
    else:
        command = [sys.executable, "-c", text]
    environment = {**os.environ, "SLDR_HOME": "/nonexistent", "SLDR_TOKEN": token(service)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=ENDED_WITHIN_S, check=False)
    assert done.returncode == 0, done.stderr


def token(service: Service) -> str:
    """Return what the service's own client shows to be let in."""
    return service.client.headers.get("Authorization", "").removeprefix("Bearer ")


def read(name: str) -> Any:
    return json.loads((TEXTS / name).read_text())


@pytest.mark.parametrize("name", ["launch-command.txt", "launch-script.txt"])
def test_a_pasted_launch_queues_what_the_form_shows(service: Service, name: str):
    planned = service.client.post("/api/launches/plan", json=read("launch.json")).json()["runs"]
    run_text(name, service)
    rows = list_runs(service.database, RunFilter(), 50).rows
    launched = [(row.phase, row.seed, row.config) for row in reversed(rows)]
    assert launched == [(run["phase"], run["seed"], run["config"]) for run in planned]
    assert len(launched) == 4


@pytest.mark.parametrize("name", ["study-command.txt", "study-script.txt"])
def test_a_pasted_study_is_the_one_that_was_put_together(service: Service, name: str):
    wanted = read("study.json")
    run_text(name, service)
    (study,) = list_studies(service.database, 10)
    assert study.name == wanted["name"]
    assert json.loads(json.dumps(spec_to_dict(study.spec))) == wanted["spec"]
