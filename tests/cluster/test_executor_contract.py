"""What holds of an attempt wherever it runs: on this machine, or on a cluster's node."""

from __future__ import annotations

import os
import signal

import pytest
from cluster_cases import Behave, begin, process_of, wait_for_cycles, wait_for_end
from other_processes import is_running, wait_until

from backend.store.actions import Action, act_on
from backend.store.database import Database
from backend.store.metrics import read_metrics
from backend.store.outcomes import Lost
from backend.store.runs import get_run
from backend.store.settings import Settings
from backend.store.states import RunState
from worker.words import StopWord

STATE_AFTER: dict[StopWord, RunState] = {
    "cancel": RunState.CANCELLED,
    "pause": RunState.PAUSED,
    "shutdown": RunState.QUEUED,
}

WISHES: dict[StopWord, Action] = {"cancel": Action.CANCEL, "pause": Action.PAUSE}
"""What a person wants when a supervisor says these words."""


def test_an_attempt_comes_to_its_end_and_leaves_log_and_room(db: Database, settings: Settings, behave: Behave) -> None:
    executor = behave("counts")
    claimed, child = begin(db, executor)

    assert wait_for_end(child) == 0
    wait_until(executor.has_room)
    assert get_run(db, claimed.run_id).state is RunState.SUCCEEDED
    assert read_metrics(db, claimed.run_id).step == [1, 2, 3, 4, 5]
    log = (settings.run_directory(claimed.run_id) / "log.txt").read_text()
    assert f"Attempt 1 of run {claimed.run_id} begins" in log


@pytest.mark.parametrize("word", STATE_AFTER)
def test_an_attempt_obeys_a_word(db: Database, behave: Behave, word: StopWord) -> None:
    claimed, child = begin(db, behave("lasts"))
    wait_for_cycles(db, claimed.run_id, child)
    if word in WISHES:
        act_on(db, WISHES[word], [claimed.run_id])

    child.tell(word)

    assert wait_for_end(child) == 0
    assert get_run(db, claimed.run_id).state is STATE_AFTER[word]


def test_a_deaf_attempt_is_killed(db: Database, settings: Settings, behave: Behave) -> None:
    claimed, child = begin(db, behave("is-deaf"))
    wait_for_cycles(db, claimed.run_id, child)

    child.kill()

    assert wait_for_end(child) == -signal.SIGKILL
    assert not is_running(process_of(settings, claimed.run_id))


def test_an_attempt_that_somebody_killed_is_worth_another(db: Database, settings: Settings, behave: Behave) -> None:
    claimed, child = begin(db, behave("is-deaf"))
    wait_for_cycles(db, claimed.run_id, child)

    os.kill(process_of(settings, claimed.run_id), signal.SIGKILL)

    assert wait_for_end(child) == -signal.SIGKILL
    assert child.outcome() == Lost("Its process was killed by SIGKILL (the machine may be out of memory).")
