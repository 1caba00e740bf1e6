"""Every page, light and dark, wide and narrow: axe finds nothing that keeps people out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import signed_in
from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
"""Loaded from the developers' packages; the page itself never ships it."""
SOON_MS = 30_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
GRAVE = {"serious", "critical"}
SIZES = ((1280, 800), (390, 844))
"""Width and height of a laptop's window and of a telephone [px]."""


ALL_RULES = "{}"
CONTRAST = "{ runOnly: ['color-contrast'] }"
"""The one rule whose answer hangs on the colour scheme."""

FIND = """async () => {
    // What fades in, or changes its colour, is looked at when it is done.
    const fading = () => document.getAnimations().some(({ effect }) => effect.getComputedTiming().endTime < Infinity);
    const frame = () => new Promise(requestAnimationFrame);
    do { await frame(); await frame(); } while (fading());
    const { violations } = await axe.run(document, { resultTypes: ['violations'], ...OPTIONS });
    return violations.map(({ id, impact, nodes }) =>
        ({ id, impact, where: nodes.slice(0, 4).map(node => `${node.target}: ${node.failureSummary}`) }));
}"""
"""Violations, each with the places where it is."""

TOO_WIDE = "document.documentElement.scrollWidth > document.documentElement.clientWidth"
"""The whole page scrolls sideways, which no page should."""

PAGES = {
    "runs": ("/", "[data-run]"),
    "launch": ("/launch", "input[type=radio]"),
    "run": ("/runs/{run_id}", "figure canvas"),
    "studies": ("/studies", "main a[href^='/studies/']"),
    "new study": ("/studies/new", "main input"),
    "study": ("/studies/{study_id}", "main table, main [role=grid]"),
    "compare": ("/compare?statistic=seeds&tables=FetchSlide&pin=her", "figure canvas"),
    "best models": ("/compare?tab=best", "figure canvas"),
    "configs": ("/compare/configs?runs={run_id},{other_id}", "main table"),
    "queue": ("/queue", "main li"),
    "workers": ("/workers", "main h2, main h3"),
    "account": ("/account", "main table"),
    "accounts": ("/accounts", "main table"),
    "sign in": ("/sign-in", "main h1"),
    "welcome": ("/welcome#sldr_unknown", "main [role=alert]"),
    "settings": ("/settings", "main h2"),
}
"""Address of each page, and what is there once it has drawn itself."""


ON_TOP: dict[str, tuple[str, Callable[[Page], None], str]] = {
    "command palette": ("runs", lambda page: page.keyboard.press("Control+k"), "[role=listbox] [role=option]"),
    "shortcuts": ("runs", lambda page: page.keyboard.press("?"), "[role=dialog] kbd"),
    "help with a method": ("launch", lambda page: _press(page, "What her-sldr does"), "[role=dialog] p"),
    "filters": ("runs", lambda page: _press(page, "Filter"), "[role=dialog] [role=switch]"),
    "columns": ("runs", lambda page: _press(page, "Columns"), "[role=dialog] h3"),
}
"""What opens over a page: which page, how it is opened, and what is there then."""


def _press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).first.click(timeout=SOON_MS)


@pytest.fixture(scope="module")
def visitor(browser: Browser, filled_product: str) -> Iterator[Page]:
    """Return a tab with axe inside; all visits share it."""
    context = browser.new_context()
    context.add_cookies(signed_in.cookies())  # type: ignore[arg-type]
    context.add_init_script(path=str(AXE))
    yield context.new_page()
    context.close()


@pytest.fixture(scope="module")
def names(filled_product: str) -> dict[str, str]:
    """Return ids of things that are in the store."""

    def get(path: str) -> Any:
        return signed_in.get(filled_product, path)

    runs = get("/api/runs?state=succeeded&phase=manipulation")["runs"]
    [study] = get("/api/studies")["studies"]
    return {"run_id": runs[0]["id"], "other_id": runs[-1]["id"], "study_id": study["id"]}


@pytest.mark.parametrize("name", PAGES)
def test_nothing_keeps_people_out(filled_product: str, names: dict[str, str], visitor: Page, name: str) -> None:
    path, drawn = PAGES[name]
    visitor.emulate_media(color_scheme="light")
    visitor.goto(filled_product + path.format(**names))
    found: list[tuple[int, str, Any]] = []
    for width, height in SIZES:
        visitor.set_viewport_size({"width": width, "height": height})
        for scheme, options in (("light", ALL_RULES), ("dark", CONTRAST)):
            visitor.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
            visitor.locator(drawn).first.wait_for(timeout=SOON_MS)
            violations = visitor.evaluate(FIND.replace("OPTIONS", options))
            found += [(width, scheme, violation) for violation in violations if violation["impact"] in GRAVE]
        assert not visitor.evaluate(TOO_WIDE), f"{name} scrolls sideways at {width} px"
    assert found == []


@pytest.mark.parametrize("name", ON_TOP)
def test_nothing_that_opens_keeps_people_out(filled_product: str, visitor: Page, name: str) -> None:
    page, open_it, shown = ON_TOP[name]
    path, drawn = PAGES[page]
    width, height = SIZES[0]
    visitor.set_viewport_size({"width": width, "height": height})
    visitor.emulate_media(color_scheme="light")
    visitor.goto(filled_product + path)
    visitor.locator(drawn).first.wait_for(timeout=SOON_MS)
    open_it(visitor)
    visitor.locator(shown).first.wait_for(timeout=SOON_MS)
    found: list[tuple[str, Any]] = []
    for scheme, options in (("light", ALL_RULES), ("dark", CONTRAST)):
        visitor.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
        violations = visitor.evaluate(FIND.replace("OPTIONS", options))
        found += [(scheme, violation) for violation in violations if violation["impact"] in GRAVE]
    assert found == []
