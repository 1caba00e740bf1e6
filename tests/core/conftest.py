"""A task with short episodes, for trainings that end soon."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from small_training import SHORT_PUSH, know_short_push

from sldr_core.config import TASKS


@pytest.fixture(scope="module", autouse=True)
def short_push() -> Iterator[None]:
    """Make the short task known while tests of the library run."""
    know_short_push()
    yield
    del TASKS[SHORT_PUSH.name]
