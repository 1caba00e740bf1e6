"""Files stay short, functions stay short, and names say what a thing is."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PYTHON_ROOMS = ("sldr_core", "backend", "worker", "tests")
WEB_SOURCES = ROOT / "web" / "src"

LONGEST_PYTHON_FILE = 400  # [lines]
LONGEST_WEB_FILE = 250  # [lines]
LONGEST_FUNCTION = 60  # [lines]
EMPTY_WORDS = {"utils", "util", "common", "manager", "handler", "handlers", "helper", "helpers", "misc"}
GENERATED = ".gen.ts"

PYTHON_FILES = sorted(path for room in PYTHON_ROOMS for path in (ROOT / room).rglob("*.py"))
WEB_FILES = sorted(
    path for suffix in ("*.ts", "*.tsx") for path in WEB_SOURCES.rglob(suffix) if not path.name.endswith(GENERATED)
)


def name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def line_count(path: Path) -> int:
    return len(path.read_text(encoding="utf-8").splitlines())


def words(path: Path) -> set[str]:
    return set(path.name.partition(".")[0].lower().replace("-", "_").split("_"))


def function_lengths(path: Path) -> dict[str, int]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    return {
        f"{name(path)}:{node.lineno} {node.name}": (node.end_lineno or node.lineno) - node.lineno + 1
        for node in functions
    }


@pytest.mark.parametrize(
    ("files", "longest"),
    [(PYTHON_FILES, LONGEST_PYTHON_FILE), (WEB_FILES, LONGEST_WEB_FILE)],
    ids=["python", "web"],
)
def test_files_are_short(files: list[Path], longest: int) -> None:
    assert {name(path): line_count(path) for path in files if line_count(path) > longest} == {}


def test_functions_are_short() -> None:
    # A migration lists tables, one after the other: splitting it would hide them.
    sources = [path for path in PYTHON_FILES if not {"tests", "migrations"} & set(path.relative_to(ROOT).parts)]

    lengths = {function: length for path in sources for function, length in function_lengths(path).items()}

    assert {function: length for function, length in lengths.items() if length > LONGEST_FUNCTION} == {}


def test_names_say_what_a_module_is() -> None:
    rooms = {parent for path in PYTHON_FILES + WEB_FILES for parent in path.parents if ROOT in parent.parents}

    assert sorted(name(path) for path in {*PYTHON_FILES, *WEB_FILES, *rooms} if words(path) & EMPTY_WORDS) == []
