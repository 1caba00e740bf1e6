"""From choosing what to compare to a matrix of finished runs, by clicks and with everything real."""

from __future__ import annotations

import re
import time
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect
from signed_in import cookies, get

pytestmark = [pytest.mark.browser, pytest.mark.timeout(900)]

SOON_MS = 30_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
STILL_S = 120.0
"""Something has moved in a study by then, even on a busy machine [s]."""

METHODS = ("ddpg", "her")
"""Neither needs a locomotion run, so four trainings are all."""
SEEDS = (0, 1)


@pytest.fixture(scope="module")
def study_address(product: str, browser: Browser) -> str:
    """Launch a smoke study of two methods and two seeds through the page; return the address of its page."""
    page = browser.new_page()
    page.context.add_cookies(cookies())  # type: ignore[arg-type]
    page.goto(f"{product}/")
    page.get_by_role("link", name="Studies").click()
    page.get_by_role("link", name="New study").click()
    page.get_by_role("checkbox", name="her-sldr", exact=True).uncheck(timeout=SOON_MS)
    page.get_by_role("checkbox", name="ddpg", exact=True).check()
    page.get_by_role("radio", name="smoke", exact=True).check(force=True)
    page.get_by_role("textbox", name=re.compile("Seeds")).fill(", ".join(map(str, SEEDS)))
    page.get_by_role("textbox", name="Name").fill("Smoke")
    expect(page.get_by_role("region", name="What will run").get_by_text("2 new")).to_have_count(2, timeout=SOON_MS)
    page.get_by_role("button", name="Launch 4 runs").click(timeout=SOON_MS)
    page.wait_for_url(re.compile(r"/studies/[0-9a-f]{12}"), timeout=SOON_MS)
    address = page.url
    page.close()
    return address


@pytest.fixture(scope="module")
def finished_study(product: str, study_address: str) -> str:
    """Wait until every run of the study has succeeded; return the study's id."""
    study_id = study_address.rsplit("/", 1)[1]
    seen: dict[str, Any] = {}
    moved_at = time.monotonic()
    while seen.get("states") != {"succeeded": len(METHODS) * len(SEEDS)}:
        study = get(product, f"/api/studies/{study_id}")
        if (study["states"], study["progress"]) != (seen.get("states"), seen.get("progress")):
            seen, moved_at = study, time.monotonic()
        assert "failed" not in study["states"]
        assert time.monotonic() < moved_at + STILL_S, f"the study stands still at {study['states']}"
        time.sleep(0.25)
    return study_id


def test_a_study_is_watched_until_it_is_done(study_address: str, page: Page, finished_study: str) -> None:
    page.goto(study_address)
    expect(page.locator("header").get_by_text("100\u202f% trained")).to_be_visible(timeout=SOON_MS)
    for method in METHODS:
        cell = page.get_by_role("button", name=re.compile(f"^FetchPush, {method}:"))
        expect(cell.get_by_title("2 succeeded")).to_be_visible()
        expect(cell.get_by_text("2 of 2")).to_be_visible()


def test_a_cell_leads_to_its_runs(study_address: str, page: Page, finished_study: str) -> None:
    page.goto(study_address)
    page.get_by_role("button", name=re.compile("^FetchPush, her:")).click(timeout=SOON_MS)
    runs = page.get_by_role("region", name="Runs of FetchPush, her")
    expect(runs.get_by_role("link")).to_have_text([f"Seed {seed}" for seed in SEEDS])
    runs.get_by_role("link", name="Seed 1").click()
    expect(page.get_by_text(re.compile("manipulation · her · seed 1 · preset smoke"))).to_be_visible(timeout=SOON_MS)


def test_the_same_study_again_has_nothing_to_train(product: str, page: Page, finished_study: str) -> None:
    page.goto(f"{product}/studies/new?from={finished_study}")
    expect(page.get_by_role("button", name="Gather what exists")).to_be_enabled(timeout=SOON_MS)
    expect(page.get_by_text("Nothing has to be trained.")).to_be_visible()
