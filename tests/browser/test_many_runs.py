"""A thousand runs in a real browser: only those in view are drawn, all of them can be tagged at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing

import pytest
from many_runs import launch_many
from playwright.sync_api import Page, expect
from served_product import PAGE_AND_API, serving
from signed_in import get
from store_engines import SqliteStores

from backend.store.database import open_database

pytestmark = pytest.mark.browser

SOON_MS = 60_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
RUNS = 1000
MOST_DRAWN = 80
"""Rows in the page, however many there are."""


@pytest.fixture(scope="module")
def address(
    sqlite_stores: SqliteStores, tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]
) -> Iterator[str]:
    """Serve the page over a store of very many runs that nobody trains; return its address."""
    home = tmp_path_factory.mktemp("many")
    with sqlite_stores.fresh(home) as settings:
        with closing(open_database(settings)) as db:
            launch_many(db, RUNS)
        with serving(home, find_free_port(), PAGE_AND_API) as address:
            yield address


def test_a_thousand_runs_are_scrolled_selected_and_tagged(address: str, page: Page) -> None:
    page.goto(f"{address}/?sort=seed&order=up")
    rows = page.locator("tbody[data-run]")
    expect(rows.first).to_be_visible(timeout=SOON_MS)
    assert rows.count() < MOST_DRAWN
    frame = page.get_by_role("table", name="Runs").locator("..")
    frame.evaluate("frame => frame.scrollTo(0, frame.scrollHeight)")
    expect(page.locator(f"tr[aria-rowindex='{RUNS + 1}'] [data-line-box]")).to_be_visible(timeout=SOON_MS)
    assert rows.count() < MOST_DRAWN

    page.get_by_role("checkbox", name="Select all runs of this table").click()
    bar = page.get_by_role("toolbar", name="Selected runs")
    expect(bar.get_by_text("runs selected")).to_have_text("1\u202f000 runs selected", timeout=SOON_MS)
    bar.get_by_role("button", name="Tags").click()
    page.get_by_placeholder("Type, then Enter").fill("all of them")
    page.get_by_placeholder("Type, then Enter").press("Enter")
    page.get_by_role("button", name="Change the tags of").click()
    expect(page.get_by_text("The tags of 1\u202f000 runs are changed.")).to_be_visible(timeout=SOON_MS)
    assert get(address, "/api/tags") == {"tags": [{"tag": "all of them", "runs": RUNS}]}


def test_the_keyboard_walks_selects_and_opens(address: str, page: Page) -> None:
    page.goto(f"{address}/")
    box = page.locator("[data-line-box]").first
    expect(box).to_be_visible(timeout=SOON_MS)
    box.focus()
    page.keyboard.press("Space")
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Shift+ArrowDown")
    expect(page.get_by_text("3 runs selected")).to_be_visible(timeout=SOON_MS)
    page.keyboard.press("End")
    expect(page.locator(f"[data-line='{RUNS - 1}'] [data-line-box]")).to_be_focused(timeout=SOON_MS)
    page.keyboard.press("Enter")
    page.wait_for_url("**/runs/*", timeout=SOON_MS)
