"""Every page, light and dark, wide and narrow: axe finds nothing that keeps people out."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
"""Loaded from the developers' packages; the page itself never ships it."""
SOON_MS = 30_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
GRAVE = {"serious", "critical"}
SIZES = ({"width": 1280, "height": 800}, {"width": 390, "height": 844})

FIND = """async () => {
    const { violations } = await axe.run(document, { resultTypes: ['violations'] });
    return violations.map(({ id, impact, help, nodes }) =>
        ({ id, impact, help, where: nodes.map(({ target }) => String(target)).slice(0, 5) }));
}"""
"""All rules of axe, each violation with the places where it is."""

WIDE = "document.documentElement.scrollWidth > document.documentElement.clientWidth"
"""The whole page scrolls sideways, which no page should."""

PAGES = {
    "runs": ("/", "[data-run]"),
    "launch": ("/launch", "input[type=radio]"),
    "run": ("/runs/{run_id}", "figure canvas"),
    "queue": ("/queue", "main li"),
    "workers": ("/workers", "main article, main section"),
}
"""Address of each page, and what is there once it has drawn itself."""


@pytest.fixture(scope="module", params=["light", "dark"])
def page_in_scheme(request: pytest.FixtureRequest, browser: Browser) -> Iterator[Page]:
    """Return a tab of a person who likes it light, or dark; all visits share it, with axe inside."""
    context = browser.new_context(color_scheme=request.param, reduced_motion="reduce")
    context.add_init_script(path=str(AXE))
    yield context.new_page()
    context.close()


@pytest.fixture(scope="module")
def run_id(filled_product: str) -> str:
    """Return a run that has ended."""
    runs: list[dict[str, Any]] = httpx.get(f"{filled_product}/api/runs?state=succeeded&method=her-sldr").json()["runs"]
    return runs[0]["id"]


@pytest.mark.parametrize("name", PAGES)
def test_nothing_keeps_people_out(filled_product: str, run_id: str, page_in_scheme: Page, name: str) -> None:
    path, drawn = PAGES[name]
    page_in_scheme.goto(filled_product + path.format(run_id=run_id))
    found: list[tuple[int, Any]] = []
    for size in SIZES:
        page_in_scheme.set_viewport_size(size)  # type: ignore[arg-type]
        page_in_scheme.locator(drawn).first.wait_for(timeout=SOON_MS)
        grave = [violation for violation in page_in_scheme.evaluate(FIND) if violation["impact"] in GRAVE]
        found += [(size["width"], violation) for violation in grave]
        assert not page_in_scheme.evaluate(WIDE), f"{name} scrolls sideways at {size['width']} px"
    assert found == []
