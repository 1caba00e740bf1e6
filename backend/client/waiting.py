"""Waiting for runs to end."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from backend.client.errors import StillGoing
from backend.client.records.runs import Run

POLL_S = 2.0
"""Between two looks [s]."""

HALTED = ("failed", "cancelled", "paused")
"""A run that needs one of these starts only if a person has it tried again or resumes it."""


def wait_for_runs(
    find: Callable[[str], Run],
    run_ids: Sequence[str],
    timeout_s: float | None = None,
    on_change: Callable[[Run], None] | None = None,
    poll_s: float = POLL_S,
) -> list[Run]:
    """Wait until each of the runs has ended, or goes no further without a person; return them in the order given.

    Without a person none goes further that is paused or below its gate, or needs one that has failed, was cancelled or
    is paused.

    Args:
        find: returns the run with an id as it stands now.
        timeout_s: how long to wait at most; for ever if None [s].
        on_change: told of every run when it is first seen and when its state changes.

    Raises:
        StillGoing: they have not all ended in time.
    """
    give_up_at = None if timeout_s is None else time.monotonic() + timeout_s
    seen: dict[str, Run] = {}
    going = list(dict.fromkeys(run_ids))
    while True:
        for run_id in going:
            run = find(run_id)
            if on_change is not None and (run_id not in seen or seen[run_id].state != run.state):
                on_change(run)
            seen[run_id] = run
        going = [run_id for run_id in going if not goes_no_further(find, seen[run_id])]
        if not going:
            return [seen[run_id] for run_id in run_ids]
        if give_up_at is not None and time.monotonic() > give_up_at:
            raise StillGoing(f"After {timeout_s:g} s these runs have not ended: {', '.join(going)}.")
        time.sleep(poll_s)


def goes_no_further(find: Callable[[str], Run], run: Run) -> bool:
    """Tell whether a run has ended, or does nothing more until a person lets it go on."""
    if run.has_ended or run.state == "paused" or run.is_below_gate:
        return True
    needed = run.needs if run.state == "blocked" else []
    return any(find(needed_id).state in HALTED for needed_id in needed)
