"""MLflow in a Python environment of its own, which asks for other versions than this product, and answers questions."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
REQUIREMENTS = HERE / "mlflow-requirements.txt"
ENVIRONMENT = Path("build/bench-mlflow")
"""Where the environment is made; it stays there until the requirements change."""


@dataclass(frozen=True)
class MlflowAnswer:
    """Hold what MLflow answered and how long it took by its own clock."""

    seconds: float
    cpu_s: float
    told: Any


class MlflowProcess:
    """Ask a process that has MLflow open on a SQLite tracking store."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def ask(self, command: str, **arguments: Any) -> MlflowAnswer:
        """Have a function of `mlflow_peer.py` called, and return what came out.

        Raises:
            SystemExit: the process has ended; what it said stands above.
        """
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps({"command": command, "arguments": arguments}) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            raise SystemExit(f"MLflow's process ended while it was asked to '{command}'.")
        return MlflowAnswer(**json.loads(line))


@contextmanager
def open_mlflow(directory: Path) -> Iterator[MlflowProcess]:
    """Lend an MLflow with an empty tracking store in a directory."""
    python = _make_environment()
    command = [str(python), str(HERE / "mlflow_peer.py"), str(directory / "mlflow.db")]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield MlflowProcess(process)
        finally:
            assert process.stdin is not None
            process.stdin.close()
            process.wait()


def _make_environment() -> Path:
    """Make the environment if it is not there as the requirements want it; return its Python."""
    python, stamp = ENVIRONMENT / "bin" / "python", ENVIRONMENT / "made-from.txt"
    wanted = REQUIREMENTS.read_text()
    if not stamp.exists() or stamp.read_text() != wanted:
        print(f"Making an environment with MLflow in {ENVIRONMENT}", flush=True)
        subprocess.run([sys.executable, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)
        pip = [str(python), "-m", "pip", "--disable-pip-version-check", "--quiet"]
        subprocess.run([*pip, "install", "--no-deps", "--requirement", str(REQUIREMENTS)], check=True)
        stamp.write_text(wanted)
    return python.absolute()
