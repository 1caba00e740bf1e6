"""Holding a run and letting it go on, deleting it and having it back, by clicks and with everything real."""

from __future__ import annotations

from typing import Any

import httpx
import pytest
from other_processes import wait_until
from playwright.sync_api import Page, expect
from signed_in import credentials, get

pytestmark = pytest.mark.browser

SOON_MS = 30_000
"""The page shows what it has been asked for by then, even on a busy machine [ms]."""
TRAINED_MS = 120_000
"""A run of small cycles has started, paused or ended by then [ms]."""

ORDER = {
    "task": "FetchPush",
    "phase": "locomotion",
    "method": "her",
    "preset": "smoke",
    "seeds": [11],
    "overrides": {"loop": {"epochs": 25}},
}
"""Enough small cycles that a person can get in between, some seconds on a quiet machine."""


@pytest.fixture(scope="module")
def run_id(product: str) -> str:
    """Launch a run of small cycles; the tests here follow each other with it."""
    answer = httpx.post(f"{product}/api/launches", json=ORDER, headers=credentials(product), timeout=10.0)
    assert answer.status_code == 201
    return answer.json()["runs"][-1]["id"]


def wait_for_progress(product: str, run_id: str) -> None:
    """Wait until a run has trained a cycle."""
    wait_until(lambda: get(product, f"/api/runs/{run_id}")["progress"] is not None, TRAINED_MS / 1000)


def attempts_of(product: str, run_id: str) -> list[dict[str, Any]]:
    """Return a run's attempts."""
    return get(product, f"/api/runs/{run_id}/attempts")["attempts"]


def test_a_run_is_paused_and_goes_on_where_it_was(product: str, run_id: str, page: Page) -> None:
    page.goto(f"{product}/runs/{run_id}")
    badge = page.locator("header [data-state]").first
    expect(badge).to_have_text("running", timeout=SOON_MS)
    wait_for_progress(product, run_id)
    page.get_by_role("button", name="Pause", exact=True).click()
    expect(badge).to_have_text("paused", timeout=TRAINED_MS)
    page.get_by_role("button", name="Resume", exact=True).click()
    expect(badge).to_have_text("succeeded", timeout=TRAINED_MS)
    first, second = attempts_of(product, run_id)
    assert (first["outcome"], second["outcome"]) == ("paused", "succeeded")
    assert second["first_cycle"] > first["first_cycle"] == 1


def test_a_deleted_run_is_had_back(product: str, run_id: str, page: Page) -> None:
    page.goto(f"{product}/")
    row = page.locator(f"[data-run='{run_id}']")
    row.get_by_role("checkbox").check(timeout=SOON_MS)
    page.get_by_role("toolbar", name="Selected runs").get_by_role("button", name="Delete").click()
    expect(row).to_have_count(0, timeout=SOON_MS)
    page.get_by_role("button", name="Undo").click()
    expect(row).to_have_count(1, timeout=SOON_MS)
