"""Nothing that is read is run: no shell, no pickle, weights only."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = [path for room in ("sldr_core", "backend", "worker") for path in sorted((ROOT / room).rglob("*.py"))]

NEVER = {"eval", "exec", "os.system", "os.popen", "pickle.load", "pickle.loads", "marshal.loads", "shelve.open"}
NEVER |= {"yaml.load", "joblib.load", "subprocess.getoutput", "cloudpickle.loads", "dill.loads"}

MUST_SAY = {"torch.load": ("weights_only", True), "np.load": ("allow_pickle", False)}
"""Functions that are harmless only with this argument."""


def dangers(source: str) -> list[str]:
    """Return the calls of a text that could run what they read."""
    found: list[str] = []
    for call in (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)):
        name = ast.unparse(call.func)
        said = {word.arg: word.value.value for word in call.keywords if isinstance(word.value, ast.Constant)}
        argument, value = MUST_SAY.get(name, (None, None))
        if name in NEVER or said.get("shell") is True or (argument is not None and said.get(argument) is not value):
            found.append(f"{call.lineno}: {name}")
    return found


def test_nothing_that_is_read_is_run() -> None:
    found = {str(path.relative_to(ROOT)): dangers(path.read_text()) for path in SOURCES}
    assert {name: calls for name, calls in found.items() if calls} == {}


@pytest.mark.parametrize(
    "source",
    [
        "torch.load(path)",
        "torch.load(path, weights_only=False)",
        "np.load(path)",
        "subprocess.run(words, shell=True)",
        "pickle.loads(content)",
        "eval(text)",
    ],
)
def test_a_dangerous_call_is_found(source: str) -> None:
    assert dangers(source)
