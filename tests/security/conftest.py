"""One API that asks for accounts, shared by the tests of a file."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from guarded_api import Guarded, guarded


@pytest.fixture(scope="module")
def api(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Guarded]:
    """Return an API that asks for accounts."""
    with guarded(tmp_path_factory.mktemp("guarded")) as api:
        yield api
