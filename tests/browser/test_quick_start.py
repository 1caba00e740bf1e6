"""docs/quick-start.md, followed word for word: its sentences are read from the page and done in a browser."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from playwright.sync_api import BrowserContext, Locator, Page, expect

pytestmark = [pytest.mark.browser, pytest.mark.timeout(900)]

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs/quick-start.md").read_text()

SOON_MS = 60_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
TRAINED_MS = 240_000
"""A smoke run has begun, and has numbers to show, by then [ms]."""

SLOW_PRESET, SWIFT_PRESET = "quick", "smoke"
"""What the page recommends, and what its table offers to whoever has no ten minutes."""

CHAPTERS = ("Launch", "Watch", "Compare")
"""What is done in the browser; `Start` is a command."""

ACTS = ("Choose ", "Press ", "Open ")
"""A sentence that begins so says what to do; any other says what is to be seen."""

BOLD = re.compile(r"\*\*(.+?)\*\*")
NAMED = re.compile(r"(\w+(?: models)?) \*\*(.+?)\*\*")
"""What kind of thing is named, and its name."""


class Named(NamedTuple):
    """A thing that a step names."""

    kind: str
    name: str
    is_used: bool
    """Whether the step says to use it; otherwise it has to be there."""


def chapter(title: str) -> str:
    """Return the text below a heading."""
    [text] = re.findall(rf"^## {title}\n(.*?)(?=^## |\Z)", TEXT, re.MULTILINE | re.DOTALL)
    return text


def steps(title: str) -> list[str]:
    """Return the numbered steps of a chapter."""
    return re.findall(r"^\d+\. (.*)$", chapter(title), re.MULTILINE)


def things(step: str) -> Iterator[Named]:
    """Yield what a step names, in its order."""
    named = NAMED.findall(step)
    assert [name for _, name in named] == BOLD.findall(step), f"say what kind of thing each bold name is: {step}"
    for sentence in re.split(r"(?<=[.:]) ", step):
        for kind, name in NAMED.findall(sentence):
            yield Named(kind, SWIFT_PRESET if name == SLOW_PRESET else name, sentence.startswith(ACTS))


def card_of(legend: str) -> Callable[[Page, str], Locator]:
    """Return how to find a card of a group of them."""
    return lambda page, name: page.get_by_role("group", name=legend).get_by_role("radio", name=name, exact=True)


def by_role(role: str) -> Callable[[Page, str], Locator]:
    """Return how to find something by its role for people who cannot see it, and its whole name."""
    return lambda page, name: page.get_by_role(role, name=name, exact=True).first  # type: ignore[arg-type]


KINDS: dict[str, Callable[[Page, str], Locator]] = {
    "link": by_role("link"),
    "button": by_role("button"),
    "tab": by_role("tab"),
    "curve": by_role("figure"),
    "panel": by_role("figure"),
    "choice": by_role("radio"),
    **{legend: card_of(legend) for legend in ("task", "phase", "method", "preset", "locomotion models")},
}
"""How each kind of thing is found on the page."""


@pytest.fixture
def context(new_context: Callable[..., BrowserContext]) -> BrowserContext:
    """Return a browser that has never been here: the printed address lets it in."""
    return new_context()


def test_every_step_can_be_done(printed_address: str, page: Page) -> None:
    page.goto(printed_address)
    for title in CHAPTERS:
        assert steps(title), f"the chapter {title} has no steps"
        for number, step in enumerate(steps(title), start=1):
            for thing in things(step):
                where = f"{title}, step {number}: {thing.kind} {thing.name}"
                found = KINDS[thing.kind](page, thing.name)
                _do(found, thing, where)


def _do(found: Locator, thing: Named, where: str) -> None:
    waits_for_training = thing.kind == "curve"
    if thing.kind in ("link", "button", "tab", "curve", "panel"):
        expect(found, where).to_be_visible(timeout=TRAINED_MS if waits_for_training else SOON_MS)
        if thing.is_used:
            expect(found, where).to_be_enabled(timeout=SOON_MS)
            found.click(timeout=SOON_MS)
        return
    expect(found, where).to_be_enabled(timeout=SOON_MS)
    if thing.is_used:
        found.check(force=True, timeout=SOON_MS)  # The card around it is what a pointer hits.
        expect(found, where).to_be_checked(timeout=SOON_MS)


def test_the_command_serves_the_whole_product() -> None:
    assert re.findall(r"^```\n(.*?)^```", chapter("Start"), re.MULTILINE | re.DOTALL) == ["make run\n"]
    recipe = subprocess.run(["make", "--dry-run", "run"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert re.search(r"sldr serve --host 127\.0\.0\.1 --port 8000$", recipe.strip())


def test_the_swift_preset_is_offered() -> None:
    assert re.findall(r"^\| `(\w+)`", TEXT, re.MULTILINE) == [SWIFT_PRESET, SLOW_PRESET]
