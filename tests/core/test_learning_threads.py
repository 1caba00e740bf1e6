"""How many threads torch gives a learner while another thread acts: seen in a process that has computed nothing yet."""

from __future__ import annotations

import subprocess
import sys

BESIDE = """
import threading
import torch
from sldr_core.config import ComputeConfig
from sldr_core.training.compute import resolve_compute
from sldr_core.training.rollout import _acting_threads

resolve_compute(ComputeConfig(threads=4, device="cpu"), beside=True)
acts, is_over = threading.Event(), threading.Event()

def act():
    with _acting_threads():
        acts.set()
        is_over.wait()

acting = threading.Thread(target=act)
acting.start()
acts.wait()
beside = torch.get_num_threads()
is_over.set()
acting.join()
print(beside, torch.get_num_threads())
"""


def test_a_learner_keeps_its_threads_even_if_another_thread_acts_before_it_has_computed_anything() -> None:
    done = subprocess.run([sys.executable, "-c", BESIDE], capture_output=True, text=True, check=False)
    assert (done.stdout, done.returncode) == ("2 2\n", 0), done.stderr
