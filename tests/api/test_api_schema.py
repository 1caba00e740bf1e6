"""The API keeps to its own schema, whatever it is asked."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, settings
from live_api import Service, new_client, serving
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

FEW, MANY = 3, 40
"""Requests made up for each operation, in the usual run and in the slow one."""


NOWHERE = Path("/nonexistent")
"""The schema does not depend on where the data lies."""

described = schemathesis.openapi.from_dict(
    create_app(Settings(home=NOWHERE, database_url=sqlite_url(NOWHERE)), NOWHERE).openapi()
)


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Return where an API listens that holds a run."""
    home = tmp_path_factory.mktemp("described")
    app = create_app(Settings(home=home, database_url=sqlite_url(home)), home / "dist")
    with pytest.MonkeyPatch.context() as patch, serving(app) as address, new_client(address) as client:
        # Drawing takes seconds and has tests of its own.
        for module in ("backend.api.routes.compare_exports", "backend.figures.bundle"):
            patch.setattr(f"{module}.draw_apart", lambda drawings: [b"drawn"] * len(drawings))
        service = Service(client=client, settings=app.state.service.settings, database=app.state.service.database)
        service.launch(method="her-sldr")
        yield address


def made_up(requests: int) -> settings:
    """Return how so many requests are made up, the same in every run."""
    return settings(
        max_examples=requests,
        deadline=None,
        database=None,
        derandomize=True,
        phases=[Phase.explicit, Phase.generate],
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large],
    )


@described.parametrize()
@made_up(FEW)
def test_every_answer_is_as_the_schema_says(address: str, case: schemathesis.Case):
    case.call_and_validate(base_url=address, checks=CHECKS)


@pytest.mark.slow
@described.parametrize()
@made_up(MANY)
def test_every_answer_to_many_requests_is_as_the_schema_says(address: str, case: schemathesis.Case):
    case.call_and_validate(base_url=address, checks=CHECKS)
