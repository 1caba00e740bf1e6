"""The browser that the other tests drive starts here, headless and with 3D."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page

pytestmark = pytest.mark.browser


def test_the_browser_shows_a_page(page: Page) -> None:
    page.set_content("<h1>FetchPush</h1>")

    assert page.get_by_role("heading").inner_text() == "FetchPush"


def test_the_browser_draws_in_3d(page: Page) -> None:
    assert page.evaluate("document.createElement('canvas').getContext('webgl2') !== null")
