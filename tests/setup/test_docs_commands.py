"""Every command, file and link that README and docs name exists, with its options."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

from worker.cli import COMMANDS, main

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
MAKEFILE = (ROOT / "Makefile").read_text()

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
SETTING = re.compile(r"^[A-Z_]+=\S*$")
"""A variable that is set for one command."""

PARTS = {"export": ("figure", "bundle", "study", "rerun", "tensorboard", "mlflow"), "zoo": ("add",)}
"""Commands with commands of their own."""


def texts(page: Path) -> Iterator[str]:
    """Yield every line that is typed and every word in code, without comments; code of programs is left out."""
    content = page.read_text()
    for language, block in FENCE.findall(content):
        if language in ("", "bash", "sh"):
            yield from block.replace("\\\n", " ").splitlines()
    yield from INLINE.findall(FENCE.sub("", content))


def commands(program: str) -> list[tuple[str, list[str]]]:
    """Return every command of a program with the page that shows it: the words after its name."""
    found: list[tuple[str, list[str]]] = []
    for page in PAGES:
        for text in texts(page):
            for part in re.split(r"&&|;|\|", text):
                words = _words(part)
                if words and words[0].removeprefix(".venv/bin/") == program and words[1:]:
                    found.append((page.name, words[1:]))
    return found


def _words(text: str) -> list[str]:
    try:
        words = shlex.split(text, comments=True)
    except ValueError:
        return []
    while words and SETTING.match(words[0]):
        words.pop(0)
    return words


@cache
def help_of(*words: str) -> str:
    """Return what a command says of itself."""
    printed = io.StringIO()
    with pytest.MonkeyPatch.context() as patch, contextlib.redirect_stdout(printed):
        patch.setenv("COLUMNS", "200")
        with pytest.raises(SystemExit) as ended:
            main([*words, "--help"])
    assert ended.value.code == 0, words
    return printed.getvalue()


@pytest.mark.parametrize(("page", "words"), commands("sldr"))
def test_a_command_of_sldr_has_these_options(page: str, words: list[str]) -> None:
    name, *rest = words
    if name == "export":  # `--rerun` and `--study` may be written with dashes
        rest = [word.lstrip("-") if word in ("--rerun", "--study") else word for word in rest]
    if name in ("--help", "--version", "COMMAND"):
        return
    assert name in COMMANDS, f"{page}: no command {name}"
    part = [word for word in rest if word in PARTS.get(name, ())][:1]
    known = set(re.findall(r"--[a-z][\w-]*", help_of(name) + help_of(name, *part)))
    asked = {word.split("=")[0] for word in rest if word.startswith("--")}
    assert asked <= known | {"--help"}, f"{page}: sldr {' '.join(words)}"


def test_every_target_of_make_exists() -> None:
    targets = set(re.findall(r"^([a-z0-9-]+):", MAKEFILE, re.MULTILINE))
    variables = set(re.findall(r"^([A-Z]+) \?=", MAKEFILE, re.MULTILINE)) | {"PYTHON"}
    shown = commands("make")
    assert shown
    for page, words in shown:
        for word in words:
            name, equals, _ = word.partition("=")
            assert name in (variables if equals else targets), f"{page}: make {' '.join(words)}"


def test_every_module_and_script_exists() -> None:
    shown = commands("python")
    assert shown
    for page, (first, *rest) in shown:
        there = find_spec(rest[0]) is not None if first == "-m" else (ROOT / first).exists()
        assert there, f"{page}: python {first} {' '.join(rest)}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_leads_somewhere(page: Path) -> None:
    for link in LINK.findall(FENCE.sub("", page.read_text())):
        if link.startswith(("http://", "https://")):
            continue
        file, _, heading = link.partition("#")
        target = (page.parent / file) if file else page
        assert target.exists(), link
        if heading:
            assert heading in headings(target), link


def headings(page: Path) -> set[str]:
    """Return the marks of a page's headings, as GitHub makes them."""
    titles = re.findall(r"^#+ (.*)$", FENCE.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def test_every_page_is_reached_from_the_readme() -> None:
    linked = set(LINK.findall((ROOT / "README.md").read_text()))
    assert {f"docs/{page.name}" for page in PAGES[1:]} <= {link.partition("#")[0] for link in linked}
