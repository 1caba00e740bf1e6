"""One API that asks for accounts, shared by the tests of a file."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "api"))

from guarded_api import Guarded, guarded


@pytest.fixture(scope="module")
def api(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Guarded]:
    """Return an API that asks for accounts."""
    with guarded(tmp_path_factory.mktemp("guarded")) as api:
        yield api
