"""The API keeps to its own schema, whatever it is asked and whoever asks.

`make test` tries a few requests for each operation, `make fuzz` tens of thousands; both ask pytest for this file by its
name. It is not found by itself: reading the schema takes seconds in every process that looks for tests, and
pytest-xdist takes all operations for one test, as they share a name.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import schemathesis
from guarded_api import Guarded, guarded
from hypothesis import HealthCheck, Phase, seed, settings
from schemathesis.checks import (
    content_type_conformance,
    negative_data_rejection,
    not_a_server_error,
    response_schema_conformance,
    status_code_conformance,
)

from backend.api.app import create_app
from backend.store.access.roles import ROLES
from backend.store.launches import LaunchOrder, launch
from backend.store.settings import Settings, sqlite_url

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
    negative_data_rejection,
]

EXAMPLES = int(os.environ.get("SLDR_FUZZ_EXAMPLES", "2"))
"""Requests drawn at random for each operation; each is sent as nobody and as every role."""

PHASES = [Phase.explicit, Phase.generate] if EXAMPLES > 2 else [Phase.generate]
"""Explicit ones are what Schemathesis derives from each part of the schema, dozens for each operation."""

WALKS = max(1, EXAMPLES // 3)
"""Pairs of chains of requests made up for each role, in which a later one uses what an earlier one made. Only so many
are drawn from one seed: an answer is not the same twice, so a chain that began like an earlier one would go on
differently, which hypothesis takes for a mistake."""

STEPS = 12
"""Requests of a chain at most."""

NOBODY = "nobody"

NOWHERE = Path("/nonexistent")
"""The schema does not depend on where the data lies."""

schemathesis.serializer.alias("application/zip", "application/octet-stream")

described = schemathesis.openapi.from_dict(
    create_app(Settings(home=NOWHERE, database_url=sqlite_url(NOWHERE)), NOWHERE).openapi()
)

HEALTH_CHECKS = [HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large]


@pytest.fixture(scope="module")
def api(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Guarded]:
    """Return an API that holds a run."""
    with guarded(tmp_path_factory.mktemp("described")) as api:
        launch(api.database, LaunchOrder("FetchPush", "manipulation", "her-sldr", (0,), "smoke"))
        yield api


def credentials(api: Guarded, who: str) -> dict[str, str]:
    """Return the header with which somebody asks."""
    shown = {role: client.headers["authorization"] for role, client in api.programs.items()}
    return {} if who == NOBODY else {"Authorization": shown[who]}  # type: ignore[index]


@described.parametrize()
@settings(
    max_examples=EXAMPLES,
    deadline=None,
    database=None,
    derandomize=True,
    phases=PHASES,
    suppress_health_check=HEALTH_CHECKS,
)
def test_every_answer_is_as_the_schema_says(api: Guarded, case: schemathesis.Case):
    for who in (NOBODY, *ROLES):
        case.call_and_validate(base_url=api.address, checks=CHECKS, headers=credentials(api, who))


@pytest.mark.parametrize("role", ROLES)
def test_chains_of_requests_are_answered_as_the_schema_says(api: Guarded, role: str):
    class Walk(described.as_state_machine()):
        def get_call_kwargs(self, case: schemathesis.Case) -> dict[str, Any]:
            return {"base_url": api.address, "headers": credentials(api, role)}

        def validate_response(self, response: Any, case: schemathesis.Case, **kwargs: Any) -> None:
            case.validate_response(response, checks=CHECKS)

    for number in range(WALKS):
        seed(number)(Walk).run(
            settings=settings(
                max_examples=2,
                stateful_step_count=STEPS,
                deadline=None,
                database=None,
                phases=[Phase.generate],
                suppress_health_check=HEALTH_CHECKS,
            )
        )
