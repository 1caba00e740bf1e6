"""The compare page over real numbers: look at them, come back to the same view, and take along what is drawn."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from signed_in import get

pytestmark = pytest.mark.browser

SOON_MS = 60_000
"""The page shows, and the server draws, what was asked for by then, even on a busy machine [ms]."""

TITLES = {"her": "HER-Sparse", "her-sldr": "HER-Sparse+SLDR"}


def drawn_numbers(product: str, task: str) -> dict[tuple[str, float], float]:
    """Return the centres that the page draws for a task, by method and env steps."""
    compared = get(product, "/api/compare?statistic=mean&x=env_steps")
    panel: dict[str, Any] = next(panel for panel in compared["panels"] if panel["task"] == task)
    return {
        (curve["group"], x): centre
        for curve in panel["curves"]
        for x, centre in zip(curve["x"], curve["centre"], strict=True)
    }


def saved(page: Page, name: str, directory: Path) -> str:
    """Export a format; return the file's text."""
    page.get_by_role("button", name="Export").click()
    with page.expect_download(timeout=SOON_MS) as download:
        page.get_by_role("link", name=name, exact=True).click()
    path = directory / download.value.suggested_filename
    download.value.save_as(path)
    page.keyboard.press("Escape")
    return path.read_text(encoding="utf-8")


def expect_the_chosen_view(page: Page) -> None:
    """Expect means over env steps, FetchPush as a table, and one method that stands out."""
    panel = page.get_by_role("figure", name="FetchSlide")
    expect(panel.locator("canvas")).to_be_visible(timeout=SOON_MS)
    expect(panel).to_contain_text("mean of")
    expect(panel.get_by_role("slider", name="FetchSlide: test success rate over env steps")).to_be_visible()
    expect(page.get_by_role("radio", name="Mean")).to_be_checked()
    expect(page.get_by_role("table", name="FetchPush: Test success rate")).to_be_visible()
    expect(page.get_by_role("button", name="HER-Sparse+SLDR")).to_have_attribute("aria-pressed", "true")


def test_a_comparison_is_looked_at_found_again_and_taken_along(filled_product: str, page: Page, tmp_path: Path) -> None:
    page.goto(f"{filled_product}/")
    page.get_by_role("link", name="Compare").click()
    expect(page.get_by_role("figure", name="FetchPush")).to_contain_text("median of", timeout=SOON_MS)
    page.get_by_text("Mean", exact=True).click()
    page.get_by_role("combobox", name="X axis").click()
    page.get_by_role("option", name="Env steps").click()
    page.get_by_role("button", name="FetchPush as a table").click()
    page.get_by_role("button", name="HER-Sparse+SLDR").click()
    expect_the_chosen_view(page)

    page.reload()
    expect_the_chosen_view(page)

    assert "<svg" in saved(page, "SVG", tmp_path)
    rows = [row for row in csv.DictReader(saved(page, "CSV", tmp_path).splitlines()) if row["task"] == "FetchPush"]
    exported = {(row["method"], float(row["env_steps"])): float(row["test/success_rate"]) for row in rows}
    assert exported == drawn_numbers(filled_product, "FetchPush")

    # What is read in the page's own table stands in the file.
    table = page.get_by_role("table", name="FetchPush: Test success rate")
    heads = table.locator("thead th").all_inner_texts()
    first = table.locator("tbody tr").first.locator("td").all_inner_texts()
    begin = min(x for _, x in exported)
    for method, title in TITLES.items():
        shown = float(re.sub(r"[^\d.]", "", first[heads.index(title)]))
        assert shown == pytest.approx(100 * exported[method, begin], abs=0.05)
