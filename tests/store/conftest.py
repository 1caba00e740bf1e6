"""Every test of the store runs on SQLite and on PostgreSQL."""

from __future__ import annotations

import pytest
from store_engines import ENGINES


@pytest.fixture(scope="module", params=ENGINES)
def engine(request: pytest.FixtureRequest) -> str:
    """Return the engine of the test's store."""
    return request.param
