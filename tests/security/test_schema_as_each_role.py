"""The API keeps to its own schema: a few made-up requests for each operation, in a process that reads the schema."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

REQUESTS = Path(__file__).with_name("made_up_requests.py")
FINE = 0
"""What pytest returns if it found tests and all passed."""


def test_every_answer_is_as_the_schema_says_whoever_asks() -> None:
    # The options of the whole suite keep Schemathesis from being loaded.
    command = [sys.executable, "-m", "pytest", "-q", "-o", "addopts=--strict-markers", str(REQUESTS)]

    done = subprocess.run(command, capture_output=True, text=True, check=False)

    assert done.returncode == FINE, done.stdout + done.stderr
