"""The lines of a run's log, placed on the training's own time by the tests that they tell of."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from sldr_core.records import Step
from worker.recording.content import LogLine

MOST_LINES = 2_000
"""The last ones of a long log are kept: what matters is said at the end."""

_TEST = re.compile(r"\bepoch (\d+): test success\b")
"""What the recorder says after each test."""


def place_lines(lines: Iterable[str], steps: Sequence[Step]) -> list[LogLine]:
    """Give each line the control steps of the last test before it; 0 before the first."""
    ends = {step.epoch: step.env_steps for step in steps}
    placed: list[LogLine] = []
    at = 0
    for line in lines:
        told = _TEST.search(line)
        if told is not None:
            # A resumed training tells of an epoch again: it stands where it did.
            at = ends.get(int(told.group(1)), at)
        if line.strip():
            placed.append(LogLine(at, line.rstrip()))
    return placed[-MOST_LINES:]
