"""A process that gives way is nicer, alone and as a session."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from worker.priority import AUTOGROUP

TIMEOUT_S = 30
TELL = """import os
from worker.priority import give_way
give_way(7)
print(os.getpriority(os.PRIO_PROCESS, 0), os.getsid(0) == os.getpid())"""


def in_a_process(code: str, leads: bool) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=True,
        process_group=0 if leads else None,
    )
    return done.stdout.strip()


@pytest.mark.parametrize("leads", [False, True])
def test_it_is_nicer_and_leaves_its_session_where_it_can(leads: bool) -> None:
    assert in_a_process(TELL, leads) == f"7 {not leads}"


def test_it_can_give_way_further_with_all_its_threads_but_not_back() -> None:
    code = """import os, threading
from worker.priority import give_way
told = threading.Event()
other = threading.Thread(target=told.wait)
other.start()
for niceness in (3, 9, 5):
    give_way(niceness)
print([os.getpriority(os.PRIO_PROCESS, thread) for thread in (0, other.native_id)])
told.set()"""

    assert in_a_process(code, leads=False) == "[9, 9]"


@pytest.mark.skipif(not AUTOGROUP.exists(), reason="this system does not group processes by session")
def test_its_session_is_nicer_and_this_one_is_not() -> None:
    before = AUTOGROUP.read_text()

    told = in_a_process(f"{TELL}\nprint(open('{AUTOGROUP}').read())", leads=False)

    assert told.endswith("nice 7")
    assert Path(AUTOGROUP).read_text() == before
