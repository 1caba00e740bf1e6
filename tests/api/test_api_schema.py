"""The API keeps to its own schema, whatever it is asked."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, settings
from live_api import Service, serving_client
from schemathesis.checks import (
    content_type_conformance,
    negative_data_rejection,
    not_a_server_error,
    response_schema_conformance,
    status_code_conformance,
)

from backend.api.app import create_app
from backend.store.settings import Settings, sqlite_url

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
    negative_data_rejection,
]

EXAMPLES = 8
"""Requests made up for each operation."""


NOWHERE = Path("/nonexistent")
"""The schema does not depend on where the data lies."""

described = schemathesis.openapi.from_dict(
    create_app(Settings(home=NOWHERE, database_url=sqlite_url(NOWHERE)), NOWHERE).openapi()
)


@pytest.fixture(scope="module")
def described_service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """Return an API that holds a run."""
    home = tmp_path_factory.mktemp("described")
    app = create_app(Settings(home=home, database_url=sqlite_url(home)), home / "dist")
    with pytest.MonkeyPatch.context() as patch, serving_client(app) as client:
        # Drawing takes seconds and has tests of its own.
        for module in ("backend.api.routes.compare_exports", "backend.figures.bundle"):
            patch.setattr(f"{module}.draw_apart", lambda drawings: [b"drawn"] * len(drawings))
        service = Service(client=client, settings=app.state.service.settings, database=app.state.service.database)
        service.launch(method="her-sldr")
        yield service


@described.parametrize()
@settings(
    max_examples=EXAMPLES,
    deadline=None,
    database=None,
    derandomize=True,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large],
)
def test_every_answer_is_as_the_schema_says(described_service: Service, case: schemathesis.Case):
    client = described_service.client
    headers = {"Authorization": client.headers["Authorization"]}
    case.call_and_validate(base_url=str(client.base_url), checks=CHECKS, headers=headers)
